// Value and derivative of many lights' SH at many points. As project_batch.cpp, in three loops: what weighs a light's
// bands at a vector of points; the numbers of slope_terms.h; their sums. What the gradient makes of the sums is found
// once a vector of points.
#include <rigel/project_batch.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "careful_slopes.h"
#include "light_blocks.h"
#include "prepared_term.h"
#include "project_block.h"
#include "slope_terms.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "project_batch_gradient.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "slope_lanes.h"
#include "sum_lanes.h"
#include "tile_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

using detail::BlockKind;
using detail::kSlopeBlock;
using detail::LightBlock;
using detail::PreparedKind;
using detail::PreparedLight;
using detail::RawRgb;
using detail::SlopeNumbers;
using detail::SortedLights;

template <int B>
constexpr int kValues = 3 * B* B;
template <int B>
constexpr int kNumbers = SlopeNumbers<B>::kAll;

/// A block of lights at a vector of points, without those that reach none of them.
template <int B>
struct SlopeRows {
  int count = 0;
  bool excess = false;  // X is not 0 everywhere
  SeenLanes seen[kSlopeBlock];
  BandWeights<B> weights[kSlopeBlock];
  Lane numbers[kSlopeBlock][kNumbers<B>];
  bool withExcess[kSlopeBlock];
  RawRgb colours[kSlopeBlock];

  // Where a cone's slope counts: the value's numbers for `axial` in place of e, and colours times the axis, backwards.
  int axialCount = 0;
  SeenLanes axialSeen[kSlopeBlock];
  Lane axialNumbers[kSlopeBlock][B * B];
  RawRgb axialColours[3][kSlopeBlock];
};

/// The lanes that float does not serve, one by one in double.
template <int B>
HWY_NOINLINE void weighWithCare(const PreparedLight& light, const PointLanes& points, Lane isServed, SeenLanes& seen,
                                BandWeights<B>& weights, SeenLanes& axial) {
  seeWithCare(light, points, isServed, seen);
  BandWeights<B> careful;
  weighValue<B>(seen, careful);
  constexpr std::size_t kCount = Lane::kCount;
  float x[kCount], y[kCount], z[kCount], served[kCount], plus[B][kCount], excess[B][kCount], e[kCount], band0[kCount];
  points.x.store(x), points.y.store(y), points.z.store(z), isServed.store(served);
  axial.e.store(e), axial.band0.store(band0);
  for (int l = 0; l < B; ++l) {
    weights.value[l] = careful.value[l];
    weights.plus[l].store(plus[l]);
    weights.excess[l].store(excess[l]);
  }
  for (std::size_t k = 0; k < kCount; ++k) {
    if (served[k] != 0) continue;
    if (repeats(k, x, y, z)) {
      for (int l = 0; l < B; ++l) plus[l][k] = plus[l][k - 1], excess[l][k] = excess[l][k - 1];
      e[k] = e[k - 1], band0[k] = band0[k - 1];
      continue;
    }
    const detail::CarefulSlopes<B> one = detail::carefulSlopes<B>(light, {x[k], y[k], z[k]});
    for (int l = 0; l < B; ++l) plus[l][k] = one.plus[l], excess[l][k] = one.excess[l];
    e[k] = one.axial, band0[k] = one.axialBand0;
  }
  for (int l = 0; l < B; ++l) {
    weights.plus[l] = Lane::load(plus[l]);
    weights.excess[l] = Lane::load(excess[l]);
  }
  axial = seen;
  axial.e = Lane::load(e);
  axial.band0 = Lane::load(band0);
}

template <int B>
void addAxial(const PreparedLight& light, Rgb colour, const SeenLanes& axial, SlopeRows<B>& rows) {
  const int k = rows.axialCount++;
  rows.axialSeen[k] = axial;
  for (int axis = 0; axis < 3; ++axis) rows.axialColours[axis][k] = colour * -light.axis[axis];
}

template <int B, BlockKind Kind>
HWY_NOINLINE void weighBlock(const LightBlock& block, const PointLanes& points, SlopeRows<B>& rows) {
  int count = 0;
  rows.axialCount = 0;
  rows.excess = false;
  ApartLanes next = apartFrom(*block.light[0], points);
  for (int i = 0; i < block.count; ++i) {
    const ApartLanes apart = next;
    next = apartFrom(*block.light[i + 1], points);
    const PreparedLight& light = *block.light[i];
    SeenLanes& seen = rows.seen[count];
    BandWeights<B>& weights = rows.weights[count];
    SlopeLanes slope;
    const Sight sight = see<Kind, false>(light, points, apart, seen, &slope);
    if (!kBoundless<Kind> && sight.dark) continue;
    if (HWY_UNLIKELY(!sight.easy)) seeLarge(sight.s2, oneWhere(isSmall<kTiny<Kind, false>>(sight.s2)), seen);
    weighValue<B>(seen, weights);
    weighPlus<B>(seen, slope, weights);
    constexpr bool modulated = !kBoundless<Kind>;
    if constexpr (modulated) weighModulation<B>(seen, slope, weights);
    bool withExcess = modulated;
    bool withAxial = Kind == BlockKind::spot && !all(slope.axial <= Lane(0.0f));
    const auto served = [&]() HWY_ATTR { return isServed<false>(light, points, apart.square, sight.s2); };
    if (HWY_UNLIKELY(!sight.easy && !all(served()))) {
      if (!modulated) std::fill_n(weights.excess, B, Lane(0.0f));
      weights.excess[0] = Lane(0.0f);
      SeenLanes axial = seen;
      axial.e = slope.axial;
      axial.band0 = quotient(slope.axial, Lane(1.0f) + seen.c);
      weighWithCare<B>(light, points, oneWhere(served()), seen, weights, axial);
      if (Kind == BlockKind::spot) addAxial<B>(light, block.colour[i], axial, rows);
      withExcess = true;
    } else if (withAxial) {
      SeenLanes axial = seen;
      axial.e = slope.axial;
      axial.band0 = quotient(slope.axial, Lane(1.0f) + seen.c);
      addAxial<B>(light, block.colour[i], axial, rows);
    }
    rows.withExcess[count] = withExcess;
    rows.excess = rows.excess || withExcess;
    rows.colours[count++] = block.colour[i];
  }
  rows.count = count;
}

template <int B>
HWY_NOINLINE void numberBlock(SlopeRows<B>& rows) {
  for (int k = 0; k < rows.count; ++k)
    weighSlopes<B>(rows.seen[k], rows.weights[k], [&](int i, Lane x) HWY_ATTR { rows.numbers[k][i] = x; });
}

template <int B>
HWY_NOINLINE void numberExcess(SlopeRows<B>& rows) {
  for (int k = 0; k < rows.count; ++k) {
    Lane* numbers = rows.numbers[k] + SlopeNumbers<B>::kExcess;
    if (rows.withExcess[k])
      weighExcess<B>(rows.seen[k], rows.weights[k], [&](int i, Lane x) HWY_ATTR { numbers[i] = x; });
    else
      std::fill_n(numbers, (B - 1) * (B - 1), Lane(0.0f));
  }
}

/// Where registers hold the sums of a part, what is weighed is added at once.
template <int B, int Part>
HWY_NOINLINE void addPart(const SlopeRows<B>& rows, Lane* sums) {
  using Numbers = SlopePart<B, Part>;
  constexpr int kSums = 3 * Numbers::kCount;
  hn::Vec<Lane::Tag> held[kSums];
  sums += 3 * Numbers::kFirst;
  HWY_UNROLL(27)
  for (int i = 0; i < kSums; ++i) held[i] = sums[i].v;
  for (int k = 0; k < rows.count; ++k) {
    const RawRgb& colour = rows.colours[k];
    weighPart<B, Part>(rows.seen[k], rows.weights[k], [&](int i, Lane number) HWY_ATTR {
      held[3 * i] = hn::MulAdd(number.v, Lane(colour.r).v, held[3 * i]);
      held[3 * i + 1] = hn::MulAdd(number.v, Lane(colour.g).v, held[3 * i + 1]);
      held[3 * i + 2] = hn::MulAdd(number.v, Lane(colour.b).v, held[3 * i + 2]);
    });
  }
  HWY_UNROLL(27)
  for (int i = 0; i < kSums; ++i) sums[i].v = held[i];
}

template <int B>
HWY_NOINLINE void addNumbered(const SlopeRows<B>& rows, Lane* sums) {
  addGroups<kNumbers<B>, SlopeNumbers<B>::kExcess>(rows.numbers, rows.colours, rows.count, sums);
}

template <int B>
void addOrdinary(SlopeRows<B>& rows, Lane* sums) {
  if constexpr (B <= 3 && kSumGroup >= 9) {
    addPart<B, 0>(rows, sums);
    addPart<B, 1>(rows, sums);
    if constexpr (B == 3) addPart<B, 2>(rows, sums);
  } else {
    numberBlock<B>(rows);
    addNumbered<B>(rows, sums);
  }
}

template <int B>
HWY_NOINLINE void addExcess(const SlopeRows<B>& rows, Lane* sums) {
  addGroups<kNumbers<B>, kNumbers<B>, SlopeNumbers<B>::kExcess>(rows.numbers, rows.colours, rows.count, sums);
}

template <int B>
HWY_NOINLINE void addAxials(SlopeRows<B>& rows, Lane* sums) {
  for (int k = 0; k < rows.axialCount; ++k)
    weighBasis<B>(rows.axialSeen[k], [&](int i, Lane x) HWY_ATTR { rows.axialNumbers[k][i] = x; });
  for (int axis = 0; axis < 3; ++axis)
    addGroups<B * B>(rows.axialNumbers, rows.axialColours[axis], rows.axialCount, sums + axis * kValues<B>);
}

/// What is summed at a vector of points.
template <int B>
struct SlopeSums {
  Lane numbers[3 * kNumbers<B>];
  Lane axial[3 * kValues<B>];
  bool anyExcess = false, anyAxial = false;
};

template <int B, BlockKind Kind>
void addBlocks(const SortedLights& lights, const PointLanes& points, SlopeRows<B>& rows, SlopeSums<B>& sums) {
  lights.visit(Kind, kSlopeBlock, [&](const LightBlock& block) {
    weighBlock<B, Kind>(block, points, rows);
    addOrdinary<B>(rows, sums.numbers);
    if (rows.excess) {
      numberExcess<B>(rows);
      addExcess<B>(rows, sums.numbers);
      sums.anyExcess = true;
    }
    if (rows.axialCount > 0) {
      if (!sums.anyAxial) std::fill_n(sums.axial, 3 * kValues<B>, Lane(0.0f));
      addAxials<B>(rows, sums.axial);
      sums.anyAxial = true;
    }
  });
}

template <int B>
HWY_NOINLINE void addLocalSlopes(const SortedLights& lights, const PointLanes& points, SlopeSums<B>& sums) {
  SlopeRows<B> rows;
  addBlocks<B, BlockKind::sphere>(lights, points, rows, sums);
  addBlocks<B, BlockKind::point>(lights, points, rows, sums);
  addBlocks<B, BlockKind::windowedPoint>(lights, points, rows, sums);
  addBlocks<B, BlockKind::spot>(lights, points, rows, sums);
}

/// What `terms` make of sums, added to the rows of the derivatives.
template <int B>
HWY_NOINLINE void addTerms(const detail::SlopeTerms<B>& terms, const Lane* numbers, Lane* slopes) {
  for (std::size_t output = 0; output < 3 * B * B; ++output, slopes += 3) {
    Lane r = slopes[0], g = slopes[1], b = slopes[2];
    for (std::size_t t = terms.begin[output]; t < terms.begin[output + 1]; ++t) {
      const Lane scale(terms.term[t].scale);
      const Lane* from = numbers + 3 * terms.term[t].number;
      r = mulAdd(scale, from[0], r);
      g = mulAdd(scale, from[1], g);
      b = mulAdd(scale, from[2], b);
    }
    slopes[0] = r;
    slopes[1] = g;
    slopes[2] = b;
  }
}

/// From sums to the value's rows and those of its derivative by x, y and z.
template <int B>
HWY_NOINLINE void finishSlopes(const RadianceSH<B>& everywhere, const SlopeSums<B>& sums, Lane* out) {
  static constexpr std::array<float, B* B> kScale = detail::shScale<B>();
  static constexpr detail::SlopeTerms<B> kOfPlus = detail::slopeTerms<B>(false),
                                         kOfExcess = detail::slopeTerms<B>(true);
  for (int i = 0; i < kValues<B>; ++i)
    out[i] = mulAdd(sums.numbers[i], Lane(kScale[static_cast<std::size_t>(i / 3)]), Lane(everywhere.data()[i]));
  Lane* slopes = out + kValues<B>;
  if (sums.anyAxial) {
    for (int i = 0; i < 3 * kValues<B>; ++i)
      slopes[i] = sums.axial[i] * Lane(kScale[static_cast<std::size_t>(i / 3 % (B * B))]);
  } else {
    std::fill_n(slopes, 3 * kValues<B>, Lane(0.0f));
  }
  addTerms<B>(kOfPlus, sums.numbers, slopes);
  if (sums.anyExcess) addTerms<B>(kOfExcess, sums.numbers, slopes);
}

/// Disks, point by point.
template <int B>
HWY_NOINLINE void addDiskSlopes(const PreparedLights& lights, std::span<const LightUse> uses, const Tile& tile, int v,
                                Lane* out) {
  for (const LightUse& use : uses) {
    const PreparedLight& light = lights[use.light];
    const float share = detail::heldShare(use.share);
    if (light.kind != PreparedKind::disk || !(share > 0)) continue;
    const DiskLight disk{light.position, light.axis, light.radius, light.colour, light.twoSided};
    float one[4 * kValues<B>][Lane::kCount] = {};
    const std::size_t begin = static_cast<std::size_t>(v) * Lane::kCount;
    for (std::size_t k = 0; k < Lane::kCount && begin + k < tile.count; ++k) {
      const std::size_t at = begin + k;
      const ProjectionWithGradient<B> both = projectWithGradient<B>(disk, {tile.x[at], tile.y[at], tile.z[at]});
      for (int i = 0; i < kValues<B>; ++i) {
        one[i][k] = both.value.data()[i];
        for (int axis = 0; axis < 3; ++axis) one[(1 + axis) * kValues<B> + i][k] = both.gradient.d[axis].data()[i];
      }
    }
    for (int i = 0; i < 4 * kValues<B>; ++i) out[i] = mulAdd(Lane(share), Lane::load(one[i]), out[i]);
  }
}

template <int B>
void projectSlopes(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points, float* out) {
  RadianceSH<B> everywhere;
  if (lights.anyDirectional()) everywhere = detail::directionalSh<B>(lights, uses, {});
  SlopeSums<B> sums;
  Lane rows[4 * kValues<B>];
  SortedLights sorted;
  std::size_t begin = uses.size();  // of what is sorted
  for (std::size_t at = 0; at < points.size(); at += detail::kTileVectors * Lane::kCount) {
    const Tile tile(points, {}, at);
    for (int v = 0; v < tile.vectors; ++v) {
      std::fill_n(sums.numbers, 3 * kNumbers<B>, Lane(0.0f));
      sums.anyExcess = sums.anyAxial = false;
      for (std::size_t first = 0; first < uses.size(); first += detail::kSortedUses) {
        if (first != std::exchange(begin, first))
          sorted.set(lights, uses.subspan(first, std::min(detail::kSortedUses, uses.size() - first)), nullptr);
        addLocalSlopes<B>(sorted, tile.points(v), sums);
      }
      finishSlopes<B>(everywhere, sums, rows);
      if (lights.anyDisk()) addDiskSlopes<B>(lights, uses, tile, v, rows);
      const std::size_t firstPoint = static_cast<std::size_t>(v) * Lane::kCount;
      storeRows<4 * kValues<B>>(std::min(Lane::kCount, tile.count - firstPoint), out + at + firstPoint, points.size(),
                                [&](std::size_t row, std::size_t) HWY_ATTR { return rows[row]; });
    }
  }
}

}  // namespace

void projectLightSlopes(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points, int bands,
                        float* sums) {
  if (bands == 2) return projectSlopes<2>(lights, uses, points, sums);
  if (bands == 3) return projectSlopes<3>(lights, uses, points, sums);
  if (bands == 4) return projectSlopes<4>(lights, uses, points, sums);
  return projectSlopes<5>(lights, uses, points, sums);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(projectLightSlopes);

template <int B>
void projectBatchWithGradient(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                              std::span<float> sums) noexcept {
  assert(points.y.size() == points.size() && points.z.size() == points.size());
  assert(sums.size() == 12 * B * B * points.size());
  HWY_DYNAMIC_DISPATCH(projectLightSlopes)(lights, uses, points, B, sums.data());
}

#define RIGEL_INSTANTIATE(B)                                                                                   \
  template void projectBatchWithGradient<B>(const PreparedLights&, std::span<const LightUse>, const Vec3Rows&, \
                                            std::span<float>) noexcept;
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
#endif
