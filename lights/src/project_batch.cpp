// Points in tiles of a few vectors, lights in blocks: for a block at a vector one loop brings each light to a row of
// weighted basis functions, the next adds the rows, times colours, to sums held in registers. In one loop the chain of
// roots from a light to its rows would be what a core waits for.
#include <rigel/project_batch.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "disk_batch_light.h"
#include "light_blocks.h"
#include "prepared_term.h"
#include "project_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "project_batch.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_batch_kernels.h"
#include "project_lanes.h"
#include "sum_lanes.h"
#include "tile_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

using detail::BlockKind;
using detail::kLightBlock;
using detail::kTileVectors;
using detail::LightBlock;
using detail::PreparedKind;
using detail::PreparedLight;
using detail::RawRgb;
using detail::SortedLights;

/// A block of lights at a vector of points, without those that reach none of them.
template <int B>
struct Rows {
  int count = 0;
  SeenLanes seen[kLightBlock];
  Lane basis[kLightBlock][B * B];
  const RawRgb* colour = nullptr;
  const float* const* shares = nullptr;

  // Of those that are left where some reach no point.
  RawRgb colours[kLightBlock];
  const float* ownShares[kLightBlock];

  // What takes more than one look.
  struct Unsure {
    const PreparedLight* light;
    int row;
    Lane isServed, isSmall, s2;
  };
  int unsureCount = 0;
  Unsure unsure[kLightBlock];
};

template <int B, BlockKind Kind, bool WithFootprint>
HWY_INLINE typename Rows<B>::Unsure unsureOf(const PreparedLight& light, const PointLanes& points, Lane square, Lane s2,
                                             int row) {
  return {&light, row, oneWhere(isServed<WithFootprint>(light, points, square, s2)),
          oneWhere(isSmall<kTiny<Kind, WithFootprint>>(s2)), s2};
}

/// Lines of LinesAhead, a few a light and vector.
class Fetch {
 public:
  Fetch(LinesAhead ahead, std::size_t lights, std::size_t points)
      : next_(ahead.data()), end_(ahead.data() + ahead.size()) {
    const std::size_t steps = std::max<std::size_t>(lights * ((points + Lane::kCount - 1) / Lane::kCount), 1);
    lines_ = static_cast<std::ptrdiff_t>((ahead.size() + steps - 1) / steps);
  }
  HWY_INLINE void step() {
    if (HWY_LIKELY(next_ == end_)) return;
    for (const void* const* stop = next_ + std::min(lines_, end_ - next_); next_ != stop; ++next_)
      hwy::Prefetch(static_cast<const char*>(*next_));
  }

 private:
  const void* const* next_;
  const void* const* end_;
  std::ptrdiff_t lines_;
};

/// Leaves out the lights that reach no point; `kept`: the others.
template <int B>
HWY_NOINLINE void leaveOutDark(const LightBlock& block, const std::uint8_t* kept, Rows<B>& rows) {
  for (int k = 0; k < rows.count; ++k) {
    rows.colours[k] = block.colour[kept[k]];
    rows.ownShares[k] = block.shares[kept[k]];
  }
  rows.colour = rows.colours;
  rows.shares = rows.ownShares;
}

/// The way to the next light is begun before that to the one at hand is finished: the chain from a position to what is
/// seen is longer than a core looks ahead.
template <int B, BlockKind Kind, bool WithFootprint>
HWY_NOINLINE void seeBlock(const LightBlock& block, const PointLanes& points, Fetch& ahead, Rows<B>& rows) {
  int count = 0, unsureCount = 0;
  std::uint8_t kept[kLightBlock];
  Fetch fetch = ahead;
  ApartLanes next = apartFrom(*block.light[0], points);
  for (int i = 0; i < block.count; ++i) {
    const ApartLanes apart = next;
    next = apartFrom(*block.light[i + 1], points);
    fetch.step();
    const PreparedLight& light = *block.light[i];
    const Sight sight = see<Kind, WithFootprint>(light, points, apart, rows.seen[count], nullptr);
    if (!kBoundless<Kind> && sight.dark) continue;
    if (HWY_UNLIKELY(!sight.easy))
      rows.unsure[unsureCount++] = unsureOf<B, Kind, WithFootprint>(light, points, apart.square, sight.s2, count);
    if constexpr (!kBoundless<Kind>) kept[count] = static_cast<std::uint8_t>(i);
    ++count;
  }
  ahead = fetch;
  rows.count = count;
  rows.unsureCount = unsureCount;
  rows.colour = block.colour;
  rows.shares = block.shares;
  if (!kBoundless<Kind> && count < block.count) leaveOutDark(block, kept, rows);
}

template <int B>
HWY_NOINLINE void seeUnsure(const PointLanes& points, Rows<B>& rows) {
  for (int i = 0; i < rows.unsureCount; ++i) {
    const auto& unsure = rows.unsure[i];
    seeLarge(unsure.s2, unsure.isSmall, rows.seen[unsure.row]);
    if (!all(unsure.isServed > Lane(0.0f))) seeWithCare(*unsure.light, points, unsure.isServed, rows.seen[unsure.row]);
  }
}

/// For points that take all of a light.
alignas(64) constexpr std::array<float, hn::MaxLanes(Lane::Tag())> kWhole = [] {
  std::array<float, hn::MaxLanes(Lane::Tag())> whole{};
  whole.fill(1);
  return whole;
}();
/// Volatile: who knows that they are ones branches on whether a light has shares, and is wrong too often.
const float* const volatile kWholeRow = kWhole.data();

/// What points see of a light, times their shares in it; `at`: where these begin in a row; `whole`: kWholeRow.
template <bool Shared, int B>
HWY_INLINE SeenLanes sharedSeen(const Rows<B>& rows, int k, std::size_t at, const float* whole) {
  SeenLanes seen = rows.seen[k];
  if constexpr (Shared) {
    const float* row = rows.shares[k];
    const Lane share = Lane::load(row == nullptr ? whole : row + at);
    seen.e *= share;
    seen.band0 *= share;
  }
  return seen;
}

/// Where registers hold all sums, what is weighed is added at once.
template <int B, bool Shared>
HWY_NOINLINE void addWeighed(const Rows<B>& rows, std::size_t at, Lane* sums) {
  hn::Vec<Lane::Tag> held[3 * B * B];
  HWY_UNROLL(27)
  for (int i = 0; i < 3 * B * B; ++i) held[i] = sums[i].v;
  const float* const whole = kWholeRow;
  for (int k = 0; k < rows.count; ++k) {
    const RawRgb& colour = rows.colour[k];
    weighBasis<B>(sharedSeen<Shared>(rows, k, at, whole), [&](int i, Lane number) HWY_ATTR {
      held[3 * i] = hn::MulAdd(number.v, Lane(colour.r).v, held[3 * i]);
      held[3 * i + 1] = hn::MulAdd(number.v, Lane(colour.g).v, held[3 * i + 1]);
      held[3 * i + 2] = hn::MulAdd(number.v, Lane(colour.b).v, held[3 * i + 2]);
    });
  }
  HWY_UNROLL(27)
  for (int i = 0; i < 3 * B * B; ++i) sums[i].v = held[i];
}

template <int B, bool Shared>
HWY_NOINLINE void weighBases(Rows<B>& rows, std::size_t at) {
  const float* const whole = kWholeRow;
  for (int k = 0; k < rows.count; ++k)
    weighBasis<B>(sharedSeen<Shared>(rows, k, at, whole),
                  [&](int i, Lane number) HWY_ATTR { rows.basis[k][i] = number; });
}

template <int B>
HWY_NOINLINE void addRows(const Rows<B>& rows, Lane* sums) {
  addGroups<B * B>(rows.basis, rows.colour, rows.count, sums);
}

template <int B, bool Shared>
HWY_INLINE void addSeen(Rows<B>& rows, std::size_t at, Lane* sums) {
  if constexpr (B * B <= kSumGroup) {
    addWeighed<B, Shared>(rows, at, sums);
  } else {
    weighBases<B, Shared>(rows, at);
    addRows<B>(rows, sums);
  }
}

template <int B>
constexpr int kRows = 3 * B* B;

template <int B, BlockKind Kind, bool WithFootprint>
void addBlocks(const SortedLights& lights, const Tile& tile, std::size_t period, Fetch& ahead, Rows<B>& rows,
               Lane* sums) {
  lights.visit(Kind, kLightBlock, [&](const LightBlock& block) {
    for (int v = 0; v < tile.vectors; ++v) {
      const PointLanes points = tile.points(v);
      seeBlock<B, Kind, WithFootprint>(block, points, ahead, rows);
      seeUnsure<B>(points, rows);
      if (block.shared)
        addSeen<B, true>(rows, tile.shareAt(v, period), sums + v * kRows<B>);
      else
        addSeen<B, false>(rows, 0, sums + v * kRows<B>);
    }
  });
}

template <int B, bool WithFootprint>
HWY_NOINLINE void addLocalLights(const SortedLights& lights, const Tile& tile, std::size_t period, Fetch& ahead,
                                 Lane* sums) {
  Rows<B> rows;
  addBlocks<B, BlockKind::sphere, WithFootprint>(lights, tile, period, ahead, rows, sums);
  addBlocks<B, BlockKind::point, WithFootprint>(lights, tile, period, ahead, rows, sums);
  addBlocks<B, BlockKind::windowedPoint, WithFootprint>(lights, tile, period, ahead, rows, sums);
  addBlocks<B, BlockKind::spot, WithFootprint>(lights, tile, period, ahead, rows, sums);
}

/// What the points of a vector take of a light.
HWY_INLINE Lane shareOf(const PointShares& shares, std::size_t use, const Tile& tile, int v) {
  const float* row = detail::shareRow(shares, use);
  return row == nullptr ? Lane(1.0f) : Lane::load(row + tile.shareAt(v, shares.period));
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
HWY_NOINLINE void addDisks(const PreparedLights& lights, std::span<const LightUse> uses, const PointShares& shares,
                           const Tile& tile, Lane* sums) {
  constexpr std::array<float, B* B> kScale = detail::shScale<B>();
  float sh[B * B * kTileVectors * Lane::kCount];
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const PreparedLight& light = lights[uses[u].light];
    const float share = detail::heldShare(uses[u].share);
    if (light.kind != PreparedKind::disk || !(share > 0)) continue;
    diskSh<B>(light, tile, sh);
    for (int v = 0; v < tile.vectors; ++v) {
      const Lane own = shareOf(shares, u, tile, v);
      for (int i = 0; i < B * B; ++i) {
        const Lane computed = Lane::load(sh + i * tile.padded() + static_cast<std::size_t>(v) * Lane::kCount);
        // Distances that overflow leave no number; nothing is as much as 8.
        const Lane unit = own * select(abs(computed) < Lane(8.0f), computed, Lane(0.0f));
        for (int c = 0; c < 3; ++c) {
          Lane& sum = sums[v * kRows<B> + 3 * i + c];
          sum = mulAdd(unit, Lane(light.colour[c] * share / kScale[static_cast<std::size_t>(i)]), sum);
        }
      }
    }
  }
}

/// Directional lights of which points have shares of their own.
template <int B>
HWY_NOINLINE void addSharedDirectional(const PreparedLights& lights, std::span<const LightUse> uses,
                                       const PointShares& shares, const Tile& tile, Lane* sums) {
  for (std::size_t u = 0; u < shares.rows.size(); ++u) {
    const PreparedLight& light = lights[uses[u].light];
    if (light.kind != PreparedKind::directional || shares.rows[u] == nullptr) continue;
    const RadianceSH<B> sh = detail::directionalSh<B>(light, uses[u].share);
    constexpr std::array<float, B* B> kScale = detail::shScale<B>();
    for (int v = 0; v < tile.vectors; ++v) {
      const Lane own = shareOf(shares, u, tile, v);
      for (int i = 0; i < kRows<B>; ++i) {
        Lane& sum = sums[v * kRows<B> + i];
        sum = mulAdd(own, Lane(sh.data()[i] / kScale[static_cast<std::size_t>(i / 3)]), sum);
      }
    }
  }
}

/// Scaled, and with the light that is the same everywhere.
template <int B>
HWY_NOINLINE void storeSums(const RadianceSH<B>& everywhere, const Lane* sums, std::size_t count, float* out,
                            std::size_t stride) {
  static constexpr std::array<float, B* B> kScale = detail::shScale<B>();
  storeRows<kRows<B>>(count, out, stride, [&](std::size_t row, std::size_t v) HWY_ATTR {
    return mulAdd(sums[v * kRows<B> + row], Lane(kScale[row / 3]), Lane(everywhere.data()[row]));
  });
}

template <int B>
void projectPoints(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                   std::span<const float> footprints, const PointShares& shares, LinesAhead ahead, float* out) {
  RadianceSH<B> everywhere;
  if (lights.anyDirectional()) everywhere = detail::directionalSh<B>(lights, uses, shares);
  Lane sums[kTileVectors * kRows<B>];
  Fetch fetch(ahead, uses.size(), points.size());
  SortedLights sorted;
  std::size_t begin = uses.size();  // of what is sorted
  for (std::size_t at = 0; at < points.size(); at += kTileVectors * Lane::kCount) {
    const Tile tile(points, footprints, at);
    std::fill_n(sums, tile.vectors * kRows<B>, Lane(0.0f));
    for (std::size_t first = 0; first < uses.size(); first += detail::kSortedUses) {
      if (first != std::exchange(begin, first))
        sorted.set(lights, uses.subspan(first, std::min(detail::kSortedUses, uses.size() - first)),
                   shares.rows.empty() ? nullptr : shares.rows.data() + first);
      if (footprints.empty())
        addLocalLights<B, false>(sorted, tile, shares.period, fetch, sums);
      else
        addLocalLights<B, true>(sorted, tile, shares.period, fetch, sums);
    }
    if (lights.anyDisk()) addDisks<B>(lights, uses, shares, tile, sums);
    if (lights.anyDirectional()) addSharedDirectional<B>(lights, uses, shares, tile, sums);
    storeSums<B>(everywhere, sums, tile.count, out + at, points.size());
  }
}

}  // namespace

void projectLights(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                   std::span<const float> footprints, const PointShares& shares, LinesAhead ahead, int bands,
                   float* sums) {
  if (bands == 2) return projectPoints<2>(lights, uses, points, footprints, shares, ahead, sums);
  if (bands == 3) return projectPoints<3>(lights, uses, points, footprints, shares, ahead, sums);
  if (bands == 4) return projectPoints<4>(lights, uses, points, footprints, shares, ahead, sums);
  return projectPoints<5>(lights, uses, points, footprints, shares, ahead, sums);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(projectLights);

template <int B>
void projectBatch(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                  std::span<const float> footprints, std::span<float> sums, const PointShares& shares,
                  LinesAhead ahead) noexcept {
  assert(points.y.size() == points.size() && points.z.size() == points.size());
  assert(footprints.empty() || footprints.size() == points.size());
  assert(sums.size() == 3 * B * B * points.size());
  assert(shares.rows.empty() || (shares.rows.size() == uses.size() && shares.period > 0));
  HWY_DYNAMIC_DISPATCH(projectLights)(lights, uses, points, footprints, shares, ahead, B, sums.data());
}

#define RIGEL_INSTANTIATE(B)                                                                       \
  template void projectBatch<B>(const PreparedLights&, std::span<const LightUse>, const Vec3Rows&, \
                                std::span<const float>, std::span<float>, const PointShares&, LinesAhead) noexcept;
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
#endif
