// Local lights as the kernels of project_batch.h take them: in blocks of one kind, sorted once for all points of a
// call.
#pragma once

#include <rigel/prepared_lights.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace rigel::detail {

inline float heldShare(float share) noexcept { return share > 0 ? std::min(share, 1.0f) : 0.0f; }

/// Point, spot or sphere.
inline bool isLocal(const PreparedLight& light) noexcept {
  return light.kind == PreparedKind::sphere || light.kind == PreparedKind::point || light.kind == PreparedKind::spot;
}

/// Kinds of which each has a kernel of its own. Spheres and points light all points, windowed points those in range; a
/// spot may have a window or none.
enum class BlockKind { sphere, point, windowedPoint, spot };

/// An Rgb that begins with no value: blocks of lights are made for every tile, and hold few lights or many.
/// Of four numbers it is moved as one vector.
struct alignas(16) RawRgb {
  float r, g, b, unused;

  RawRgb() = default;
  RawRgb(Rgb c) noexcept : r(c.r), g(c.g), b(c.b), unused(0) {}
  operator Rgb() const noexcept { return {r, g, b}; }
};

/// Lights of one kind, and their colours times shares.
struct LightBlock {
  int count;
  bool shared;                        // not all of `shares` null
  const PreparedLight* const* light;  // one more, any, behind the last
  const RawRgb* colour;
  const float* const* shares;  // of PointShares
};

/// So many uses are sorted at once.
inline constexpr std::size_t kSortedUses = 128;

/// The local lights among some uses.
class SortedLights {
 public:
  /// `uses`: at most kSortedUses. `rows`: of PointShares, one a use, or nullptr.
  void set(const PreparedLights& lights, std::span<const LightUse> uses, const float* const* rows) noexcept {
    for (Kind& kind : kinds_) kind.count = 0;
    for (std::size_t u = 0; u < uses.size(); ++u) {
      const PreparedLight& light = lights[uses[u].light];
      const float share = heldShare(uses[u].share);
      if (!(share > 0) || !isLocal(light)) continue;
      Kind& kind = kinds_[static_cast<std::size_t>(blockKindOf(light))];
      const std::size_t at = kind.count++;
      kind.light[at] = &light;
      kind.colour[at] = light.colour * share;
      kind.shares[at] = rows == nullptr ? nullptr : rows[u];
    }
    for (Kind& kind : kinds_)
      if (kind.count > 0) kind.light[kind.count] = kind.light[kind.count - 1];
  }

  /// `f(block)` for each block of at most `size` lights.
  template <class F>
  void visit(BlockKind which, std::size_t size, const F& f) const {
    const Kind& kind = kinds_[static_cast<std::size_t>(which)];
    for (std::size_t begin = 0; begin < kind.count; begin += size) {
      const std::size_t count = std::min(size, kind.count - begin);
      const auto* shares = kind.shares + begin;
      const bool shared = std::any_of(shares, shares + count, [](const float* row) { return row != nullptr; });
      f(LightBlock{static_cast<int>(count), shared, kind.light + begin, kind.colour + begin, shares});
    }
  }

 private:
  struct Kind {
    std::size_t count;
    const PreparedLight* light[kSortedUses + 1];
    RawRgb colour[kSortedUses];
    const float* shares[kSortedUses];
  };

  static BlockKind blockKindOf(const PreparedLight& light) noexcept {
    if (light.kind == PreparedKind::sphere) return BlockKind::sphere;
    if (light.kind == PreparedKind::spot) return BlockKind::spot;
    return light.inverseRangeSquare > 0 ? BlockKind::windowedPoint : BlockKind::point;
  }

  Kind kinds_[4];
};

}  // namespace rigel::detail
