// Adds numbers of many lights at a vector of points, times colours, to sums held in registers. Included once per
// Highway target, after <hwy/highway.h>.
#if defined(RIGEL_SUM_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_SUM_LANES_H
#undef RIGEL_SUM_LANES_H
#else
#define RIGEL_SUM_LANES_H
#endif

#include "lane.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// Coefficients whose sums of three colours fit the registers, beside a light's colour and number: 32 registers or 16.
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_NEON
inline constexpr int kSumGroup = 9;
#else
inline constexpr int kSumGroup = 3;
#endif

/// sums[3 i + colour] += numbers[light][i] * colours[light], for `Count` coefficients from `First` on.
template <int N, int First, int Count>
HWY_INLINE void addGroup(const Lane (*numbers)[N], const detail::RawRgb* colours, int lights, Lane* sums) {
  Lane held[3 * Count];
  HWY_UNROLL(27)
  for (int i = 0; i < 3 * Count; ++i) held[i].v = sums[3 * First + i].v;
  for (int k = 0; k < lights; ++k) {
    const Lane r(colours[k].r), g(colours[k].g), b(colours[k].b);
    HWY_UNROLL(9)
    for (int i = 0; i < Count; ++i) {
      const hn::Vec<Lane::Tag> number = numbers[k][First + i].v;
      held[3 * i].v = hn::MulAdd(number, r.v, held[3 * i].v);
      held[3 * i + 1].v = hn::MulAdd(number, g.v, held[3 * i + 1].v);
      held[3 * i + 2].v = hn::MulAdd(number, b.v, held[3 * i + 2].v);
    }
  }
  HWY_UNROLL(27)
  for (int i = 0; i < 3 * Count; ++i) sums[3 * First + i].v = held[i].v;
}

/// The first `End` of N coefficients, in groups as equal as they can be.
template <int N, int End = N, int First = 0>
HWY_INLINE void addGroups(const Lane (*numbers)[N], const detail::RawRgb* colours, int lights, Lane* sums) {
  constexpr int kLeft = End - First, kGroups = (kLeft + kSumGroup - 1) / kSumGroup;
  constexpr int kCount = (kLeft + kGroups - 1) / kGroups;
  addGroup<N, First, kCount>(numbers, colours, lights, sums);
  if constexpr (First + kCount < End) addGroups<N, End, First + kCount>(numbers, colours, lights, sums);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
