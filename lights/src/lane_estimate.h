// Roots and quotients at the price of products. AVX-512 divides no more lanes a cycle than AVX2, but its estimates are
// of 14 bits: one Newton step brings them to 1.5 units in the last place. Elsewhere the exact operations are no dearer.
// Included once per Highway target, after lane.h.
#if defined(RIGEL_LANE_ESTIMATE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_LANE_ESTIMATE_H
#undef RIGEL_LANE_ESTIMATE_H
#else
#define RIGEL_LANE_ESTIMATE_H
#endif

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

// x is positive and finite, or the result anything; inverseRoot of infinity is NaN, so that what is too far shows.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL

HWY_INLINE Lane root(Lane x) {
  const Lane y = hn::ApproximateReciprocalSqrt(x.v);
  const Lane root = x * y;
  return mulAdd(root * Lane(0.5f), negMulAdd(root, y, Lane(1.0f)), root);
}

/// 1 / sqrt(x).
HWY_INLINE Lane inverseRoot(Lane x) {
  const Lane y = hn::ApproximateReciprocalSqrt(x.v);
  return mulAdd(y * Lane(0.5f), negMulAdd(x * y, y, Lane(1.0f)), y);
}

/// a / b, b of ordinary size.
HWY_INLINE Lane quotient(Lane a, Lane b) {
  const Lane y = hn::ApproximateReciprocal(b.v);
  return a * mulAdd(y, negMulAdd(b, y, Lane(1.0f)), y);
}

#else

HWY_INLINE Lane root(Lane x) { return sqrt(x); }
HWY_INLINE Lane inverseRoot(Lane x) { return sqrt(x) / x; }
HWY_INLINE Lane quotient(Lane a, Lane b) { return a / b; }

#endif

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
