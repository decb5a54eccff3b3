#include "crowd_cells.h"

#include <algorithm>
#include <cmath>

#include "weights.h"

namespace rigel::crowd {
namespace {

// To both sides of a face, in sizes of a cell: what drives at 8 m/s through a grid of 8 m takes a sixteenth of a second
// from one cell to the next. As narrow as that, for within it two selections are projected.
constexpr float kBand = 1.0f / 32;
// Largest radius in sizes of a cell; from the share kLarge of it on the next level fades in.
constexpr float kLargest = 0.25f, kLarge = 0.8f;
// Height of a cell in sizes: most of what has to be lit stands on floors, and flat cells have smaller balls.
constexpr float kHeight = 0.5f;
// Cells from the origin, so that their numbers are exact in float.
constexpr float kFarthest = 4194304;

/// The two cells at most that a coordinate is in.
struct Span {
  int count = 1;
  std::int32_t at[2];
  float share[2] = {1, 0};
};

Span spanOf(float p, float size) noexcept {
  const float u = p / size + 0.5f, below = std::floor(u), inside = u - below;
  Span span;
  span.at[0] = static_cast<std::int32_t>(below);
  const bool low = inside < kBand;
  const bool high = inside > 1 - kBand;
  if (!low && !high) return span;
  span.at[1] = span.at[0] + (low ? -1 : 1);
  const float past = (low ? inside : 1 - inside) / kBand;  // 0 at the face, 1 where the band ends
  span.share[0] = smoothstep(0.5f + 0.5f * past);
  span.share[1] = 1 - span.share[0];
  span.count = span.share[1] > 0 ? 2 : 1;
  return span;
}

int addLevel(Vec3 centre, float size, const Cell& like, float share, CellShare* out) noexcept {
  const Span x = spanOf(centre.x, size), y = spanOf(centre.y, kHeight * size), z = spanOf(centre.z, size);
  int count = 0;
  for (int i = 0; i < x.count; ++i)
    for (int j = 0; j < y.count; ++j)
      for (int k = 0; k < z.count; ++k)
        out[count++] = {{x.at[i], y.at[j], z.at[k], like.level, like.groups},
                        share * (x.share[i] * y.share[j] * z.share[k])};
  return count;
}

/// Bits of v spread to every third place.
std::uint64_t spread(std::uint64_t v) noexcept {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  return (v | v << 2) & 0x1249249249249249;
}

/// Of so many cells along each axis.
CellBall ballOf(const Cell& cell, int cells, float size) noexcept {
  constexpr float kSlack = 1 + 1e-5f;  // what float leaves of places
  constexpr float kCorner = 1.5f;      // of a box of sides 2, 1, 2
  static_assert(kCorner * kCorner == 2 + kHeight * kHeight);
  const float s = std::ldexp(size, cell.level), side = static_cast<float>(cells);
  const auto middle = [&](std::int32_t i) { return static_cast<float>(i) * (side * s); };
  return {{middle(cell.x), middle(cell.y) * kHeight, middle(cell.z)},
          s * (kCorner * (0.5f * side + kBand) + kLargest) * kSlack};
}

}  // namespace

int cellsOf(Vec3 centre, float radius, float size, std::uint32_t groups, CellShare* out) noexcept {
  const float far = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
  Cell cell;
  cell.groups = groups;
  while (!(radius <= kLargest * size) || !(far <= kFarthest * kHeight * size)) {
    size *= 2;
    ++cell.level;
  }
  const float above = smoothstep((radius / (kLargest * size) - kLarge) / (1 - kLarge));
  int count = above < 1 ? addLevel(centre, size, cell, 1 - above, out) : 0;
  if (!(above > 0)) return count;
  ++cell.level;
  return count + addLevel(centre, 2 * size, cell, above, out + count);
}

CellBall ballOf(const Cell& cell, float size) noexcept { return ballOf(cell, 1, size); }

Cell regionOf(const Cell& cell) noexcept {
  static_assert(kRegionSide % 2 == 1);  // a cell is in its middle
  const auto part = [](std::int32_t i) {
    const std::int32_t from = i + kRegionSide / 2;
    return from / kRegionSide - (from % kRegionSide < 0 ? 1 : 0);
  };
  return {part(cell.x), part(cell.y), part(cell.z), cell.level, cell.groups};
}

CellBall ballOfRegion(const Cell& region, float size) noexcept { return ballOf(region, kRegionSide, size); }

std::uint64_t placeKey(Vec3 p, float size) noexcept {
  // Eight parts of a cell along each axis, so that those who stand together in one share a block.
  constexpr float kParts = 8, kHalf = 1048576;
  static_assert(kParts * kParts * kParts == 1 << kPlaceBits);
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return ~std::uint64_t{0};
  const auto part = [](float v) {
    return static_cast<std::uint64_t>(std::clamp(std::floor((v + 0.5f) * kParts) + kHalf, 0.0f, 2 * kHalf - 1));
  };
  return spread(part(p.x / size)) | spread(part(p.y / (kHeight * size))) << 1 | spread(part(p.z / size)) << 2;
}

}  // namespace rigel::crowd
