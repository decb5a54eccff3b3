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

/// `put(number, value)` for the numbers of the value and of G+.
template <int B, class Put>
HWY_INLINE void weighSlopes(const SeenLanes& seen, const BandWeights<B>& weights, const Put& put) {
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
    for (int i = l * l; i < (l + 1) * (l + 1); ++i)
      put(detail::SlopeNumbers<B>::kPlus + i - 1, weights.plus[l - 1] * basis[i]);
  }
}

/// `put(i, value)` for the numbers of X, i from 0.
template <int B, class Put>
HWY_INLINE void weighExcess(const SeenLanes& seen, const BandWeights<B>& weights, const Put& put) {
  put(0, weights.excess[1]);
  if constexpr (B > 2) {
    put(1, weights.excess[2] * seen.wy);
    put(2, weights.excess[2] * seen.wz);
    put(3, weights.excess[2] * seen.wx);
  }
  if constexpr (B > 3) {
    Lane basis[(B - 1) * (B - 1)];
    polynomials<B - 2>(seen.wx, seen.wy, seen.wz, basis);
    HWY_UNROLL(5)
    for (int l = 2; l < B - 1; ++l) {
      HWY_UNROLL(7)
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) put(i, weights.excess[l + 1] * basis[i]);
    }
  }
}

/// Parts of the numbers of 2 and 3 bands whose sums fit 32 registers, in an order that needs few more: the value; G+ of
/// the bands 1 and 2; G+ of band 3.
template <int B, int Part>
struct SlopePart {
  static constexpr int kFirst = Part == 0 ? 0 : B * B + (Part == 1 ? 0 : 8);
  static constexpr int kCount = Part == 0 ? B * B : Part == 1 ? 8 : 7;
};
/// `put(i, number)` with i from 0 in the part.
template <int B, int Part, class Put>
HWY_INLINE void weighPart(const SeenLanes& seen, const BandWeights<B>& weights, const Put& put) {
  const Lane x = seen.wx, y = seen.wy, z = seen.wz;
  if constexpr (Part == 0) {
    weighBasis<B>(seen, put);
  } else if constexpr (Part == 1) {
    put(0, weights.plus[0] * y);
    put(1, weights.plus[0] * z);
    put(2, weights.plus[0] * x);
    const Lane wy = weights.plus[1] * y;
    put(4, wy * z);
    const Lane wx = weights.plus[1] * x;
    put(3, wx * y);
    put(6, wx * z);
    const Lane xx = wx * x, yy = wy * y;
    put(7, xx - yy);
    const Lane zz = weights.plus[1] * z * z;
    put(5, mulSub(Lane(2.0f), zz, xx + yy));
  } else {
    const Lane weight = weights.plus[2], xx = x * x, yy = y * y, xxyy = xx - yy, tt = xx + yy, xy2 = (x + x) * y;
    put(0, weight * mulAdd(x, xy2, y * xxyy));
    put(6, weight * mulSub(x, xxyy, y * xy2));
    const Lane weightZ = weight * z, zz = z * z;
    put(1, weightZ * xy2);
    put(5, weightZ * xxyy);
    put(3, weightZ * negMulAdd(Lane(3.0f), tt, zz + zz));
    const Lane f31 = weight * mulSub(Lane(4.0f), zz, tt);
    put(2, f31 * y);
    put(4, f31 * x);
  }
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
