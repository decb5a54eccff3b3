// Points as the kernels of project_batch.h go through them, and sums on their way out. Included once per Highway
// target, after <hwy/highway.h>.
#if defined(RIGEL_TILE_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_TILE_LANES_H
#undef RIGEL_TILE_LANES_H
#else
#define RIGEL_TILE_LANES_H
#endif

#include "project_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// The points of a tile, the last of them repeated to full vectors.
struct Tile {
  alignas(64) float x[detail::kTileVectors * Lane::kCount], y[detail::kTileVectors * Lane::kCount],
      z[detail::kTileVectors * Lane::kCount], footprint[detail::kTileVectors * Lane::kCount];
  std::size_t first = 0, count = 0;
  int vectors = 0;

  Tile(const Vec3Rows& points, std::span<const float> footprints, std::size_t begin) : first(begin) {
    count = std::min(points.size() - first, detail::kTileVectors * Lane::kCount);
    vectors = static_cast<int>((count + Lane::kCount - 1) / Lane::kCount);
    fill(points.x.data() + first, x);
    fill(points.y.data() + first, y);
    fill(points.z.data() + first, z);
    if (footprints.empty())
      std::ranges::fill(footprint, 0.0f);
    else
      fill(footprints.data() + first, footprint);
  }
  PointLanes points(int v) const {
    const std::size_t at = static_cast<std::size_t>(v) * Lane::kCount;
    const Lane patch = Lane::load(footprint + at);
    return {Lane::load(x + at), Lane::load(y + at), Lane::load(z + at), patch, patch * patch};
  }
  Vec3Rows rows() const { return {{x, padded()}, {y, padded()}, {z, padded()}}; }
  /// Where the shares of a vector begin in a row.
  std::size_t shareAt(int v, std::size_t period) const {
    return (first + static_cast<std::size_t>(v) * Lane::kCount) % period;
  }
  std::size_t padded() const { return static_cast<std::size_t>(vectors) * Lane::kCount; }

 private:
  void fill(const float* from, float* to) const {
    std::copy_n(from, count, to);
    std::fill_n(to + count, padded() - count, from[count - 1]);
  }
};

/// `Rows` rows of `count` numbers, `of(row, v)` those of vector v.
template <std::size_t Rows, class Of>
HWY_INLINE void storeRows(std::size_t count, float* out, std::size_t stride, const Of& of) {
  const std::size_t whole = count / Lane::kCount, rest = count % Lane::kCount;
  for (std::size_t row = 0; row < Rows; ++row, out += stride) {
    for (std::size_t v = 0; v < whole; ++v) of(row, v).store(out + v * Lane::kCount);
    if (rest == 0) continue;
    float last[Lane::kCount];
    of(row, whole).store(last);
    std::copy_n(last, rest, out + whole * Lane::kCount);
  }
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
