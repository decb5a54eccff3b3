// Points in tiles of a few vectors, lights in blocks: for a block at a vector one loop brings each light to a row of
// weighted basis functions, the next adds the rows, times colours, to sums held in registers. In one loop the chain of
// roots from a light to its rows would be what a core waits for.
#include <rigel/project_batch.h>

#include <algorithm>
#include <cassert>

#include "disk_batch_light.h"
#include "prepared_term.h"
#include "project_block.h"

#define HWY_DISABLED_TARGETS RIGEL_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "project_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_batch_kernels.h"
#include "project_lanes.h"
#include "sum_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

using detail::kLightBlock;
using detail::kTileVectors;
using detail::LightBlock;
using detail::PreparedKind;
using detail::PreparedLight;

/// A block of lights at a vector of points, without those that reach none of them.
template <int B>
struct Rows {
  int count = 0;
  SeenLanes seen[kLightBlock];
  Lane basis[kLightBlock][B * B];
  Rgb colour[kLightBlock];

  // What takes more than one look.
  struct Unsure {
    const PreparedLight* light;
    int row;
    Sight sight;
  };
  int unsureCount = 0;
  Unsure unsure[kLightBlock];
};

/// The way to the next light is begun before that to the one at hand is finished: the chain from a position to what is
/// seen is longer than a core looks ahead.
template <int B, PreparedKind Kind, bool WithFootprint>
HWY_NOINLINE void seeBlock(const LightBlock& block, const PointLanes& points, Rows<B>& rows) {
  int count = 0, unsureCount = 0;
  ApartLanes next = apartFrom(*block.light[0], points);
  for (int i = 0; i < block.count; ++i) {
    const ApartLanes apart = next;
    next = apartFrom(*block.light[i + 1], points);
    const PreparedLight& light = *block.light[i];
    const Sight sight = see<B, Kind, WithFootprint>(light, points, apart, rows.seen[count]);
    if (Kind != PreparedKind::sphere && sight.dark) continue;
    if (HWY_UNLIKELY(!all(sight.served && sight.small))) rows.unsure[unsureCount++] = {&light, count, sight};
    rows.colour[count++] = block.colour[i];
  }
  rows.count = count;
  rows.unsureCount = unsureCount;
}

template <int B>
HWY_NOINLINE void seeUnsure(const PointLanes& points, Rows<B>& rows) {
  for (int i = 0; i < rows.unsureCount; ++i) {
    const auto& [light, row, sight] = rows.unsure[i];
    seeLarge(sight.small, rows.seen[row]);
    if (!all(sight.served)) seeWithCare(*light, points, sight.served, rows.seen[row]);
  }
}

/// Where registers hold all sums, what is weighed is added at once.
template <int B>
HWY_NOINLINE void addWeighed(const Rows<B>& rows, Lane* sums) {
  hn::Vec<Lane::Tag> held[3 * B * B];
  HWY_UNROLL(27)
  for (int i = 0; i < 3 * B * B; ++i) held[i] = sums[i].v;
  for (int k = 0; k < rows.count; ++k) {
    const Rgb& colour = rows.colour[k];
    weighBasis<B>(rows.seen[k], [&](int i, Lane number) HWY_ATTR {
      held[3 * i] = hn::MulAdd(number.v, Lane(colour.r).v, held[3 * i]);
      held[3 * i + 1] = hn::MulAdd(number.v, Lane(colour.g).v, held[3 * i + 1]);
      held[3 * i + 2] = hn::MulAdd(number.v, Lane(colour.b).v, held[3 * i + 2]);
    });
  }
  HWY_UNROLL(27)
  for (int i = 0; i < 3 * B * B; ++i) sums[i].v = held[i];
}

template <int B>
HWY_NOINLINE void weighBases(Rows<B>& rows) {
  for (int k = 0; k < rows.count; ++k)
    weighBasis<B>(rows.seen[k], [&](int i, Lane number) HWY_ATTR { rows.basis[k][i] = number; });
}

template <int B>
HWY_NOINLINE void addRows(const Rows<B>& rows, Lane* sums) {
  addGroups<B * B>(rows.basis, rows.colour, rows.count, sums);
}

/// The points of a tile, the last of them repeated to full vectors.
struct Tile {
  alignas(64) float x[kTileVectors * Lane::kCount], y[kTileVectors * Lane::kCount], z[kTileVectors * Lane::kCount],
      footprint[kTileVectors * Lane::kCount];
  std::size_t count = 0;
  int vectors = 0;

  Tile(const Vec3Rows& points, std::span<const float> footprints, std::size_t first) {
    count = std::min(points.size() - first, kTileVectors * Lane::kCount);
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
    return {Lane::load(x + at), Lane::load(y + at), Lane::load(z + at), Lane::load(footprint + at)};
  }
  Vec3Rows rows() const { return {{x, padded()}, {y, padded()}, {z, padded()}}; }
  std::size_t padded() const { return static_cast<std::size_t>(vectors) * Lane::kCount; }

 private:
  void fill(const float* from, float* to) const {
    std::copy_n(from, count, to);
    std::fill_n(to + count, padded() - count, from[count - 1]);
  }
};

template <int B>
constexpr int kRows = 3 * B* B;

template <int B, PreparedKind Kind, bool WithFootprint>
void addBlock(LightBlock& block, const Tile& tile, Rows<B>& rows, Lane* sums) {
  block.light[block.count] = block.light[block.count - 1];
  for (int v = 0; v < tile.vectors; ++v, sums += kRows<B>) {
    const PointLanes points = tile.points(v);
    seeBlock<B, Kind, WithFootprint>(block, points, rows);
    seeUnsure<B>(points, rows);
    if constexpr (B * B <= kSumGroup) {
      addWeighed<B>(rows, sums);
    } else {
      weighBases<B>(rows);
      addRows<B>(rows, sums);
    }
  }
  block.count = 0;
}

template <int B, bool WithFootprint>
HWY_NOINLINE void sumLocalLights(const PreparedLights& lights, std::span<const LightUse> uses, const Tile& tile,
                                 Lane* sums) {
  Rows<B> rows;
  LightBlock spheres, points, spots;
  for (const LightUse& use : uses) {
    const PreparedLight& light = lights[use.light];
    const float share = detail::heldShare(use.share);
    const auto add = [&]<PreparedKind Kind>(LightBlock& block, std::integral_constant<PreparedKind, Kind>) {
      block.light[block.count] = &light;
      block.colour[block.count] = light.colour * share;
      if (++block.count == kLightBlock) addBlock<B, Kind, WithFootprint>(block, tile, rows, sums);
    };
    if (light.kind == PreparedKind::sphere) add(spheres, std::integral_constant<PreparedKind, PreparedKind::sphere>());
    if (light.kind == PreparedKind::point) add(points, std::integral_constant<PreparedKind, PreparedKind::point>());
    if (light.kind == PreparedKind::spot) add(spots, std::integral_constant<PreparedKind, PreparedKind::spot>());
  }
  if (spheres.count > 0) addBlock<B, PreparedKind::sphere, WithFootprint>(spheres, tile, rows, sums);
  if (points.count > 0) addBlock<B, PreparedKind::point, WithFootprint>(points, tile, rows, sums);
  if (spots.count > 0) addBlock<B, PreparedKind::spot, WithFootprint>(spots, tile, rows, sums);
}

/// A disk's SH per unit radiance; in scalars at points whose footprint is larger than the disk.
template <int B>
void diskSh(const PreparedLight& light, const Tile& tile, float* sh) {
  const DiskLight disk{light.position, light.axis, light.radius, {1, 1, 1}, light.twoSided};
  projectDiskPoints(DiskBatchLight(disk), tile.rows(), B, 6, sh);
  for (std::size_t k = 0; k < tile.padded(); ++k) {
    if (!(tile.footprint[k] > light.radius)) continue;
    const RadianceSH<B> one = project<B>(disk, {tile.x[k], tile.y[k], tile.z[k]}, tile.footprint[k]);
    for (int i = 0; i < B * B; ++i) sh[i * tile.padded() + k] = one[i].r;
  }
}

template <int B>
HWY_NOINLINE void addDisks(const PreparedLights& lights, std::span<const LightUse> uses, const Tile& tile, Lane* sums) {
  float sh[B * B * kTileVectors * Lane::kCount];
  for (const LightUse& use : uses) {
    const PreparedLight& light = lights[use.light];
    const float share = detail::heldShare(use.share);
    if (light.kind != PreparedKind::disk || !(share > 0)) continue;
    diskSh<B>(light, tile, sh);
    for (int v = 0; v < tile.vectors; ++v)
      for (int i = 0; i < B * B; ++i) {
        const Lane computed = Lane::load(sh + i * tile.padded() + static_cast<std::size_t>(v) * Lane::kCount);
        // Distances that overflow leave no number; nothing is as much as 8.
        const Lane unit = select(abs(computed) < Lane(8.0f), computed, Lane(0.0f));
        for (int c = 0; c < 3; ++c) {
          Lane& sum = sums[v * kRows<B> + 3 * i + c];
          sum = mulAdd(unit, Lane(light.colour[c] * share), sum);
        }
      }
  }
}

/// Scaled, and with the light that is the same everywhere.
template <int B>
HWY_NOINLINE void finish(const RadianceSH<B>& everywhere, int vectors, Lane* sums) {
  constexpr std::array<float, B* B> kScale = detail::shScale<B>();
  for (int i = 0; i < B * B; ++i)
    for (int c = 0; c < 3; ++c) {
      const Lane scale(kScale[static_cast<std::size_t>(i)]), constant(everywhere[i][c]);
      for (int v = 0; v < vectors; ++v) {
        Lane& sum = sums[v * kRows<B> + 3 * i + c];
        sum = mulAdd(sum, scale, constant);
      }
    }
}

template <int B>
HWY_NOINLINE void storeRows(const Lane* sums, std::size_t count, float* out, std::size_t stride) {
  const std::size_t whole = count / Lane::kCount, rest = count % Lane::kCount;
  for (int row = 0; row < kRows<B>; ++row, out += stride) {
    for (std::size_t v = 0; v < whole; ++v) sums[v * kRows<B> + row].store(out + v * Lane::kCount);
    if (rest == 0) continue;
    float last[Lane::kCount];
    sums[whole * kRows<B> + row].store(last);
    std::copy_n(last, rest, out + whole * Lane::kCount);
  }
}

template <int B>
void projectPoints(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                   std::span<const float> footprints, float* out) {
  RadianceSH<B> everywhere;
  if (lights.anyDirectional()) everywhere = detail::directionalSh<B>(lights, uses);
  Lane sums[kTileVectors * kRows<B>];
  for (std::size_t at = 0; at < points.size(); at += kTileVectors * Lane::kCount) {
    const Tile tile(points, footprints, at);
    std::fill_n(sums, tile.vectors * kRows<B>, Lane(0.0f));
    if (footprints.empty())
      sumLocalLights<B, false>(lights, uses, tile, sums);
    else
      sumLocalLights<B, true>(lights, uses, tile, sums);
    finish<B>(everywhere, tile.vectors, sums);
    if (lights.anyDisk()) addDisks<B>(lights, uses, tile, sums);
    storeRows<B>(sums, tile.count, out + at, points.size());
  }
}

}  // namespace

void projectLights(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                   std::span<const float> footprints, int bands, float* sums) {
  if (bands == 2) return projectPoints<2>(lights, uses, points, footprints, sums);
  if (bands == 3) return projectPoints<3>(lights, uses, points, footprints, sums);
  if (bands == 4) return projectPoints<4>(lights, uses, points, footprints, sums);
  return projectPoints<5>(lights, uses, points, footprints, sums);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(projectLights);

template <int B>
void projectBatch(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                  std::span<const float> footprints, std::span<float> sums) noexcept {
  assert(points.y.size() == points.size() && points.z.size() == points.size());
  assert(footprints.empty() || footprints.size() == points.size());
  assert(sums.size() == 3 * B * B * points.size());
  HWY_DYNAMIC_DISPATCH(projectLights)(lights, uses, points, footprints, B, sums.data());
}

#define RIGEL_INSTANTIATE(B)                                                                       \
  template void projectBatch<B>(const PreparedLights&, std::span<const LightUse>, const Vec3Rows&, \
                                std::span<const float>, std::span<float>) noexcept;
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
#endif
