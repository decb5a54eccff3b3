// What a light's SH and their derivative by the point are sums of (slope_terms.h), at a vector of points. Included once
// per Highway target, after <hwy/highway.h>.
#if defined(RIGEL_SLOPE_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_SLOPE_LANES_H
#undef RIGEL_SLOPE_LANES_H
#else
#define RIGEL_SLOPE_LANES_H
#endif

#include "lane_polynomials.h"
#include "project_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// By band: of the value, without 2 and the basis' constants and k_l's (shScale); of G+ and of X, without 2 and the
/// basis' constants.
template <int B>
struct BandWeights {
  Lane value[B], plus[B], excess[B];
};

template <int B>
HWY_INLINE void weighValue(const SeenLanes& seen, BandWeights<B>& weights) {
  const Lane c = seen.c, e = seen.e;
  weights.value[0] = seen.band0;
  weights.value[1] = e;
  if constexpr (B > 2) weights.value[2] = e * c;
  if constexpr (B > 3) weights.value[3] = e * mulSub(Lane(5.0f), c * c, Lane(1.0f));
  if constexpr (B > 4) weights.value[4] = e * c * mulSub(Lane(7.0f), c * c, Lane(3.0f));
}

/// G+_l = e/d (P_l(c)/c + l h_l) outside of a sphere, zonal.h.
template <int B>
HWY_INLINE void weighPlus(const SeenLanes& seen, const SlopeLanes& slope, BandWeights<B>& weights) {
  const Lane c = seen.c, c2 = c * c, perDistance = seen.e * slope.inverse;
  const Lane perCosine = quotient(perDistance, c);
  weights.plus[0] = perCosine;
  weights.plus[1] = Lane(1.5f) * perDistance;
  if constexpr (B > 2) weights.plus[2] = perCosine * mulAdd(Lane(2.5f), c2, Lane(-0.5f));
  if constexpr (B > 3) weights.plus[3] = perDistance * mulAdd(Lane(4.375f), c2, Lane(-1.875f));
  if constexpr (B > 4) weights.plus[4] = perCosine * mulAdd(c2, mulAdd(Lane(7.875f), c2, Lane(-5.25f)), Lane(0.375f));
}

/// Of a light that is modulated: what `radial` adds to G+ and to G-.
template <int B>
HWY_INLINE void weighModulation(const SeenLanes& seen, const SlopeLanes& slope, BandWeights<B>& weights) {
  const Lane c = seen.c, c2 = c * c, radial = slope.radial;
  Lane k[5];
  k[0] = quotient(radial, Lane(1.0f) + c);
  k[1] = Lane(0.5f) * radial;
  if constexpr (B > 2) k[2] = k[1] * c;
  if constexpr (B > 3) k[3] = radial * mulAdd(Lane(0.625f), c2, Lane(-0.125f));
  if constexpr (B > 4) k[4] = radial * c * mulAdd(Lane(0.875f), c2, Lane(-0.375f));
  for (int l = 0; l < B; ++l) weights.plus[l] += k[l];
  weights.excess[1] = k[1];
  if constexpr (B > 2) weights.excess[2] = mulAdd(Lane(1.0f / 2), k[0], k[2]);
  if constexpr (B > 3) weights.excess[3] = mulAdd(Lane(2.0f / 3), k[1], k[3]);
  if constexpr (B > 4) weights.excess[4] = mulAdd(Lane(3.0f / 4), k[2], k[4]);
}

/// `put(number, value)` for all numbers of the value and G+, and those of X where there is any.
template <int B, bool WithExcess, class Put>
HWY_INLINE void weighSlopes(const SeenLanes& seen, const BandWeights<B>& weights, const Put& put) {
  using Numbers = detail::SlopeNumbers<B>;
  Lane basis[(B + 1) * (B + 1)];
  polynomials<B>(seen.wx, seen.wy, seen.wz, basis);
  put(0, weights.value[0]);
  HWY_UNROLL(5)
  for (int l = 1; l < B; ++l) {
    HWY_UNROLL(9)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) put(i, weights.value[l] * basis[i]);
  }
  HWY_UNROLL(5)
  for (int l = 1; l <= B; ++l) {
    HWY_UNROLL(11)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) put(Numbers::kPlus + i - 1, weights.plus[l - 1] * basis[i]);
  }
  if constexpr (WithExcess) {
    put(Numbers::kExcess, weights.excess[1]);
    HWY_UNROLL(5)
    for (int l = 1; l < B - 1; ++l) {
      HWY_UNROLL(7)
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) put(Numbers::kExcess + i, weights.excess[l + 1] * basis[i]);
    }
  }
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
