#include "basis_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "basis_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigel::basisrows::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using One = hn::CappedTag<float, 1>;

/// body(tag, i) for all i, in vectors and then one by one.
template <class Body>
HWY_INLINE void forEach(std::size_t count, const Body& body) {
  constexpr std::size_t kLanes = hn::MaxLanes(Tag());
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) body(Tag(), i);
  for (; i < count; ++i) body(One(), i);
}

void multiply(const float* a, const float* b, std::size_t count, float* out) {
  forEach(count, [=](auto tag, std::size_t i)
                     HWY_ATTR { hn::StoreU(hn::Mul(hn::LoadU(tag, a + i), hn::LoadU(tag, b + i)), tag, out + i); });
}

template <bool Smooth>
HWY_INLINE void hatsOf(int nodes, const float* u, std::size_t count, float* rows) {
  const float scale = 0.5f * static_cast<float>(nodes - 1);
  forEach(count, [=](auto tag, std::size_t i) HWY_ATTR {
    const auto one = hn::Set(tag, 1.0f);
    const auto held = hn::Min(hn::Max(hn::LoadU(tag, u + i), hn::Set(tag, -1.0f)), one);
    const auto x = hn::Mul(hn::Add(held, one), hn::Set(tag, scale));
    for (int node = 0; node < nodes; ++node) {
      // Both sides exact but for one rounding, so that the two of a cell sum to 1.
      const auto rising = hn::Sub(x, hn::Set(tag, static_cast<float>(node - 1)));
      const auto falling = hn::Sub(hn::Set(tag, static_cast<float>(node + 1)), x);
      auto weight = hn::Max(hn::Min(rising, falling), hn::Zero(tag));
      if (Smooth)
        weight = hn::Mul(hn::Mul(weight, weight), hn::NegMulAdd(hn::Set(tag, 2.0f), weight, hn::Set(tag, 3.0f)));
      hn::StoreU(weight, tag, rows + static_cast<std::size_t>(node) * count + i);
    }
  });
}

void hats(int nodes, bool smooth, const float* u, std::size_t count, float* rows) {
  smooth ? hatsOf<true>(nodes, u, count, rows) : hatsOf<false>(nodes, u, count, rows);
}

}  // namespace
}  // namespace rigel::basisrows::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::basisrows {

HWY_EXPORT(multiply);
HWY_EXPORT(hats);

void multiply(const float* a, const float* b, std::size_t count, float* out) noexcept {
  HWY_DYNAMIC_DISPATCH(multiply)(a, b, count, out);
}
void hats(int nodes, bool smooth, const float* u, std::size_t count, float* rows) noexcept {
  HWY_DYNAMIC_DISPATCH(hats)(nodes, smooth, u, count, rows);
}

}  // namespace rigel::basisrows
#endif
