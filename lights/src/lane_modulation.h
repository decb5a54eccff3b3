// Range windows and spot cones on all lanes. Included once per Highway target, after lane.h.
#if defined(RIGEL_LANE_MODULATION_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_LANE_MODULATION_H
#undef RIGEL_LANE_MODULATION_H
#else
#define RIGEL_LANE_MODULATION_H
#endif

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// clamp(1-(d/R)^4, 0, 1)^2.
HWY_INLINE Lane rangeWindow(Lane square, float inverseRangeSquare) {
  const Lane x2 = square * Lane(inverseRangeSquare);
  const Lane u = max(negMulAdd(x2, x2, Lane(1.0f)), Lane(0.0f));
  return u * u;
}

/// The same by parts, all 0 beyond the range.
struct RangeLanes {
  Lane x2, u;  // (d/R)^2, 1-(d/R)^4
  LaneMask within;

  HWY_INLINE RangeLanes(Lane square, float inverseRangeSquare) {
    x2 = square * Lane(inverseRangeSquare);
    u = negMulAdd(x2, x2, Lane(1.0f));
    within = x2 < Lane(1.0f);
  }
  HWY_INLINE Lane window(Lane e) const { return zeroUnless(within, e * u * u); }
  /// By how much window(e) falls with ln d.
  HWY_INLINE Lane slope(Lane e) const { return zeroUnless(within, Lane(8.0f) * e * u * (x2 * x2)); }
};

HWY_INLINE Lane smoothStep(Lane t) {
  const Lane held = clamp(t, Lane(0.0f), Lane(1.0f));
  return held * held * negMulAdd(Lane(2.0f), held, Lane(3.0f));
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
