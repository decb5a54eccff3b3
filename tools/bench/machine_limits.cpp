#include "bench/machine_limits.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/machine_limits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigel::tools::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using V = hn::Vec<Tag>;

/// Twelve chains, which is more than any core's latency times its units; the sum of their ends.
float chains(std::size_t rounds) {
  const Tag d;
  const V scale = hn::Set(d, 0.999f), step = hn::Set(d, 0.1f);
  V a = hn::Set(d, 1.0f), b = hn::Set(d, 2.0f), c = hn::Set(d, 3.0f), e = hn::Set(d, 4.0f);
  V f = hn::Set(d, 5.0f), g = hn::Set(d, 6.0f), h = hn::Set(d, 7.0f), i = hn::Set(d, 8.0f);
  V j = hn::Set(d, 9.0f), k = hn::Set(d, 10.0f), l = hn::Set(d, 11.0f), m = hn::Set(d, 12.0f);  // none like another
  for (std::size_t round = 0; round < rounds; ++round) {
    a = hn::MulAdd(a, scale, step);
    b = hn::MulAdd(b, scale, step);
    c = hn::MulAdd(c, scale, step);
    e = hn::MulAdd(e, scale, step);
    f = hn::MulAdd(f, scale, step);
    g = hn::MulAdd(g, scale, step);
    h = hn::MulAdd(h, scale, step);
    i = hn::MulAdd(i, scale, step);
    j = hn::MulAdd(j, scale, step);
    k = hn::MulAdd(k, scale, step);
    l = hn::MulAdd(l, scale, step);
    m = hn::MulAdd(m, scale, step);
  }
  const V first = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(f, g));
  const V second = hn::Add(hn::Add(hn::Add(h, i), hn::Add(j, k)), hn::Add(l, m));
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(first, second)));
}

double runMultiplyAdds(double flops, float* sum) {
  const double perRound = 2 * 12 * static_cast<double>(hn::Lanes(Tag()));
  const auto rounds = static_cast<std::size_t>(std::ceil(flops / perRound));
  *sum = chains(rounds);
  return perRound * static_cast<double>(rounds);
}

void runAddScaled(const float* from, float scale, float* to, std::size_t count) {
  const Tag d;
  const V factor = hn::Set(d, scale);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    hn::StoreU(hn::MulAdd(factor, hn::LoadU(d, from + i), hn::LoadU(d, to + i)), d, to + i);
  for (; i < count; ++i) to[i] += scale * from[i];
}

}  // namespace rigel::tools::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::tools {

HWY_EXPORT(runMultiplyAdds);
HWY_EXPORT(runAddScaled);

double multiplyAdds(double flops) noexcept {
  float sum = 0;
  const double done = HWY_DYNAMIC_DISPATCH(runMultiplyAdds)(flops, &sum);
  return sum > 0 ? done : 0;  // the sum is used, so that no compiler leaves it out
}

void addScaled(std::span<const float> from, float scale, std::span<float> to) noexcept {
  HWY_DYNAMIC_DISPATCH(runAddScaled)(from.data(), scale, to.data(), std::min(from.size(), to.size()));
}

}  // namespace rigel::tools
#endif
