// A ball, its field, and where slopes do: what light_tree_select.cpp and light_tree_distant.cpp ask of one light or
// cluster, and how they get to it.
#pragma once

#include <rigel/wrap.h>

#include "light_tree_state.h"
#include "weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace rigel {

/// G of light_tree.h; for t < 1.
inline float growthOf(float t) noexcept { return (3 - 2 * t) / ((1 - t) * (1 - t)); }

/// Irradiance of a light of power 1 at distance 1, over the normals.
struct UnitField {
  float rms, peak, mean;
};

inline UnitField unitField(float wrap) noexcept {
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  const double e0 = 0.25 * f[0], e1 = 0.75 * f[1], e2 = 1.25 * f[2];
  return {static_cast<float>(std::sqrt(e0 * e0 + e1 * e1 / 3 + e2 * e2 / 5)), static_cast<float>(e0 + e1 + e2),
          static_cast<float>(e0)};
}

class BallQuery {
 public:
  /// Of what `from` has left; null: of all lights.
  BallQuery(const detail::LightTreeState& state, const LightQuery& query, const LightCut* from) noexcept
      : s_(state), q_(query), from_(from), field_(unitField(query.wrap)), b_(std::max(0.0f, query.radius)) {}

 protected:
  /// A node that is looked at, or one whose lights are.
  struct Entry {
    std::size_t node;
    float weight;
    float dark;  // least of the ancestors' shares of u
  };

  /// A light or cluster from the ball.
  struct View {
    Vec3 between;
    float distance;  // between the centres
    float least;     // from the ball; 0 where the centre is within
  };

  View view(Vec3 place) const noexcept {
    const Vec3 between = q_.centre - place;
    const float distance = length(between);
    return {between, distance, std::max(0.0f, distance - b_)};
  }

  template <class Place>
  View viewOf(const Place& place) const noexcept {
    return view({place.x, place.y, place.z});
  }

  template <bool Dimmed>
  DimmingRange dimmed(std::size_t at, const TreeNode& node, const View& v) const noexcept {
    if constexpr (Dimmed)
      return dimming(s_.nodeModulation[at - s_.firstDimmedNode], v.between, v.distance, node.reach + b_);
    return {};
  }

  template <bool Dimmed>
  DimmingRange dimmed(std::size_t slot, const TreeLight& light, const View& v, float reach) const noexcept {
    if constexpr (Dimmed)
      return dimming(s_.lightModulation[slot - s_.firstDimmedLight], v.between, v.distance, light.reach + reach);
    return {};
  }

  /// f(tree, whether its lights are dimmed) for the trees of the groups.
  template <class F>
  void forEachTree(F&& f) const {
    for (const Tree& tree : s_.trees) {
      if ((tree.groups & q_.groups) == 0) continue;
      if (tree.dimmed())
        f(tree, std::true_type{});
      else
        f(tree, std::false_type{});
    }
  }

  std::uint32_t numberOf(const Tree& tree) const noexcept {
    return static_cast<std::uint32_t>(&tree - s_.trees.data());
  }
  std::uint32_t useOf(std::size_t node) const noexcept { return static_cast<std::uint32_t>(s_.slotOf.size() + node); }

  /// Walks the tree, or what is left of it: `cluster(node index, node, entry)` returns how much of a cluster stays
  /// closed, `light(slot, entry)` gets the lights of opened leaves.
  template <class Cluster, class Light>
  void walk(const Tree& tree, Cluster&& cluster, Light&& light) {
    if (from_ == nullptr) return walkFrom(tree, {1, 1, 1}, cluster, light);
    for (const LightCut::Part& part :
         std::ranges::equal_range(from_->open, numberOf(tree), {}, &LightCut::Part::tree)) {
      const Entry entry{part.at & ~kLightPart, part.weight, 1};
      if ((part.at & kLightPart) == 0)
        walkFrom(tree, entry, cluster, light);
      else
        walkLight(entry.node, entry, light);
    }
  }

  /// The distance at which a light counts among those that slopes may stand for.
  float slopeDistance(float distance, float reach) const noexcept {
    return std::max({distance, kSlopeReach * (reach + b_), 1e-15f});
  }

  /// N (S G/d^2 with S = b^2), per P/d^2, of the slopes of one light; d > reach + b.
  float slopeError(float distance, float reach) const noexcept {
    const float inverse = 1 / distance;
    return field_.rms * b_ * b_ * inverse * inverse * growthOf((reach + b_) * inverse);
  }

  bool allowsSlopes(float distance, float reach) const noexcept { return distance > kSlopeReach * (reach + b_); }

  /// Share that goes to every sample, because slopes do not follow it there: all of it where the error is beyond the
  /// limit.
  float nearShare(float error, float limit, float distance, float reach) const noexcept {
    return nearShare(error, limit, distance, reach, b_, kSlopesDo);
  }
  static float nearShare(float error, float limit, float distance, float reach, float ball, float slopesDo) noexcept {
    // The usual case, without a division.
    const float enough = kSlopeReach * (reach + ball);
    if (error <= slopesDo * limit && distance >= (1 + kSlopeBand) * enough) return 0;
    if (!(limit > 0)) return 1;
    const float wrong = smoothstep((error / limit - slopesDo) / (1 - slopesDo));
    const float close = enough > 0 ? 1 - smoothstep((distance / enough - 1) / kSlopeBand) : 0;
    return std::max(wrong, close);
  }

  /// tau of a budget [W/m2] for lights of which the u sum to `sum`. No more than keeps expansions where they converge.
  static float tauOf(double budget, double sum) noexcept {
    constexpr double kLargest = 0.2;
    return budget > 0 ? static_cast<float>(std::min(kLargest, budget / std::max(sum, 1e-30))) : 0;
  }

  static constexpr std::uint32_t kLightPart = 0x80000000u;  // of LightCut::Part::at: a light's slot, not a node

  const detail::LightTreeState& s_;
  const LightQuery& q_;
  const LightCut* from_;
  UnitField field_;
  float b_;
  int visited_ = 0;

 private:
  template <class Cluster, class Light>
  void walkFrom(const Tree& tree, const Entry& start, Cluster&& cluster, Light&& light) {
    Entry stack[64];
    int count = 0;
    stack[count++] = start;
    while (count > 0) {
      Entry entry = stack[--count];
      const std::size_t at = tree.firstNode + entry.node;
      ++visited_;
      if (!(s_.nodes[at].power > 0)) continue;
      const float closed = cluster(at, s_.nodes[at], entry);
      if (!(closed < 1)) continue;
      entry.weight *= 1 - closed;
      if (entry.node < tree.leaves()) {
        stack[count++] = {2 * entry.node, entry.weight, entry.dark};
        stack[count++] = {2 * entry.node + 1, entry.weight, entry.dark};
        continue;
      }
      const std::size_t end = tree.leafStart(entry.node - tree.leaves() + 1);
      for (std::size_t slot = tree.leafStart(entry.node - tree.leaves()); slot < end; ++slot)
        walkLight(slot, entry, light);
    }
  }

  template <class Light>
  void walkLight(std::size_t slot, const Entry& entry, Light&& light) {
    ++visited_;
    if (s_.lights[slot].power > 0) light(slot, entry);
  }

  // Slopes are enough from this many radii on, and comfortably so at this share more.
  static constexpr float kSlopeReach = 3;
  static constexpr float kSlopeBand = 0.25f;
  // They begin to give way at this share of the error allowed.
  static constexpr float kSlopesDo = 0.8f;
};

}  // namespace rigel
