// A vector of numbers that reads as one number: what the generic text of the shader_*.h files asks of a Real, on all
// lanes at once. Included once per Highway target, after <hwy/highway.h>.
#if defined(RIGEL_LANE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_LANE_H
#undef RIGEL_LANE_H
#else
#define RIGEL_LANE_H
#endif

#include <cstddef>
#include <cstdint>

#include "lane_packing.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Tag>
struct LaneMaskOf {
  hn::Mask<Tag> mask;

  friend HWY_INLINE LaneMaskOf operator&&(LaneMaskOf a, LaneMaskOf b) noexcept { return {hn::And(a.mask, b.mask)}; }
  friend HWY_INLINE LaneMaskOf operator||(LaneMaskOf a, LaneMaskOf b) noexcept { return {hn::Or(a.mask, b.mask)}; }
  friend HWY_INLINE std::size_t count(LaneMaskOf a) noexcept { return hn::CountTrue(Tag(), a.mask); }
  friend HWY_INLINE bool all(LaneMaskOf a) noexcept { return hn::AllTrue(Tag(), a.mask); }
  friend HWY_INLINE bool none(LaneMaskOf a) noexcept { return hn::AllFalse(Tag(), a.mask); }
};

/// `Tag`: hn::ScalableTag<float> and the like.
template <class AnyTag>
struct LaneOf {
  using Tag = AnyTag;
  using Scalar = hn::TFromD<Tag>;
  static constexpr std::size_t kCount = hn::MaxLanes(Tag());

  hn::Vec<Tag> v;

  LaneOf() = default;
  HWY_INLINE LaneOf(hn::Vec<Tag> all) noexcept : v(all) {}
  HWY_INLINE explicit LaneOf(float each) noexcept : v(hn::Set(Tag(), static_cast<Scalar>(each))) {}
  HWY_INLINE explicit LaneOf(double each) noexcept : v(hn::Set(Tag(), static_cast<Scalar>(each))) {}

  HWY_INLINE static LaneOf load(const Scalar* from) noexcept { return hn::LoadU(Tag(), from); }
  HWY_INLINE void store(Scalar* to) const noexcept { hn::StoreU(v, Tag(), to); }

  // Friends: found by their arguments wherever a template calls them.
  friend HWY_INLINE LaneOf operator+(LaneOf a, LaneOf b) noexcept { return hn::Add(a.v, b.v); }
  friend HWY_INLINE LaneOf operator-(LaneOf a, LaneOf b) noexcept { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE LaneOf operator*(LaneOf a, LaneOf b) noexcept { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE LaneOf operator/(LaneOf a, LaneOf b) noexcept { return hn::Div(a.v, b.v); }
  friend HWY_INLINE LaneOf operator-(LaneOf a) noexcept { return hn::Neg(a.v); }
  friend HWY_INLINE LaneOf& operator+=(LaneOf& a, LaneOf b) noexcept { return a = a + b; }
  friend HWY_INLINE LaneOf& operator-=(LaneOf& a, LaneOf b) noexcept { return a = a - b; }
  friend HWY_INLINE LaneOf& operator*=(LaneOf& a, LaneOf b) noexcept { return a = a * b; }

  using Mask = LaneMaskOf<Tag>;
  friend HWY_INLINE Mask operator<(LaneOf a, LaneOf b) noexcept { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE Mask operator<=(LaneOf a, LaneOf b) noexcept { return {hn::Le(a.v, b.v)}; }
  friend HWY_INLINE Mask operator>(LaneOf a, LaneOf b) noexcept { return {hn::Gt(a.v, b.v)}; }
  friend HWY_INLINE Mask operator>=(LaneOf a, LaneOf b) noexcept { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE LaneOf select(Mask where, LaneOf a, LaneOf b) noexcept {
    return hn::IfThenElse(where.mask, a.v, b.v);
  }
  friend HWY_INLINE LaneOf zeroUnless(Mask where, LaneOf a) noexcept { return hn::IfThenElseZero(where.mask, a.v); }

  /// a b + c, a b - c and c - a b, of one rounding where the machine has that.
  friend HWY_INLINE LaneOf mulAdd(LaneOf a, LaneOf b, LaneOf c) noexcept { return hn::MulAdd(a.v, b.v, c.v); }
  friend HWY_INLINE LaneOf mulSub(LaneOf a, LaneOf b, LaneOf c) noexcept { return hn::MulSub(a.v, b.v, c.v); }
  friend HWY_INLINE LaneOf negMulAdd(LaneOf a, LaneOf b, LaneOf c) noexcept { return hn::NegMulAdd(a.v, b.v, c.v); }

  friend HWY_INLINE LaneOf sqrt(LaneOf a) noexcept { return hn::Sqrt(a.v); }
  friend HWY_INLINE LaneOf abs(LaneOf a) noexcept { return hn::Abs(a.v); }
  friend HWY_INLINE LaneOf min(LaneOf a, LaneOf b) noexcept { return hn::Min(a.v, b.v); }
  friend HWY_INLINE LaneOf max(LaneOf a, LaneOf b) noexcept { return hn::Max(a.v, b.v); }
  friend HWY_INLINE LaneOf clamp(LaneOf x, LaneOf lo, LaneOf hi) noexcept { return min(max(x, lo), hi); }
};

using DoubleTag = hn::ScalableTag<double>;
using Lane = LaneOf<hn::ScalableTag<float>>;
using LaneMask = Lane::Mask;

/// Stores the lanes where a mask is set one behind the other. A store writes a whole vector.
class LanePacker {
 public:
#if HWY_TARGET == HWY_AVX2
  // Of Highway 1.0's Compress GCC copies the table to the stack at every call, which takes longer than all else.
  HWY_INLINE explicit LanePacker(LaneMask where) noexcept : order_(orderOf(where)) {}
  HWY_INLINE void store(Lane x, float* to) const noexcept { Lane(hn::TableLookupLanes(x.v, order_)).store(to); }

 private:
  using Order = decltype(hn::SetTableIndices(Lane::Tag(), static_cast<const std::int32_t*>(nullptr)));

  HWY_INLINE static Order orderOf(LaneMask where) noexcept {
    std::uint8_t set[8];
    hn::StoreMaskBits(Lane::Tag(), where.mask, set);
    return hn::SetTableIndices(Lane::Tag(), kLanePackings[set[0]].data());
  }

  Order order_;
#else
  HWY_INLINE explicit LanePacker(LaneMask where) noexcept : where_(where) {}
  HWY_INLINE void store(Lane x, float* to) const noexcept { Lane(hn::Compress(x.v, where_.mask)).store(to); }

 private:
  LaneMask where_;
#endif
};
using DoubleLane = LaneOf<DoubleTag>;

/// As many floats as a DoubleLane has numbers.
HWY_INLINE DoubleLane loadWidened(const float* from) noexcept {
  return hn::PromoteTo(DoubleTag(), hn::LoadU(hn::Rebind<float, DoubleTag>(), from));
}
HWY_INLINE void storeNarrowed(DoubleLane x, float* to) noexcept {
  const hn::Rebind<float, DoubleTag> floats;
  hn::StoreU(hn::DemoteTo(floats, x.v), floats, to);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
