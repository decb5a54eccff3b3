// What distant lights give at points: their value and slopes at one centre.
#include "crowd_block.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowd_distant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigel::crowd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Vec = hn::Vec<Tag>;

constexpr std::size_t kLanes = hn::MaxLanes(Tag());

/// A vector of numbers, or the last few of a row.
HWY_INLINE Vec load(const float* from, std::size_t count) {
  if (count == kLanes) return hn::LoadU(Tag(), from);
  HWY_ALIGN float few[kLanes] = {};
  std::copy_n(from, count, few);
  return hn::Load(Tag(), few);
}
HWY_INLINE void store(Vec v, float* to, std::size_t count) {
  if (count == kLanes) return hn::StoreU(v, Tag(), to);
  HWY_ALIGN float few[kLanes];
  hn::Store(v, Tag(), few);
  std::copy_n(few, count, to);
}

/// Of so many points from `at` on.
HWY_INLINE void addAt(const float* slopes, Vec3 centre, const Vec3Rows& points, std::size_t at, std::size_t count,
                      std::span<float> sums) {
  const Tag tag;
  const Vec x = hn::Sub(load(points.x.data() + at, count), hn::Set(tag, centre.x));
  const Vec y = hn::Sub(load(points.y.data() + at, count), hn::Set(tag, centre.y));
  const Vec z = hn::Sub(load(points.z.data() + at, count), hn::Set(tag, centre.z));
  for (std::size_t row = at; row < sums.size(); row += points.x.size(), slopes += 4) {
    float* to = sums.data() + row;
    Vec sum = hn::MulAdd(x, hn::Set(tag, slopes[1]), hn::Set(tag, slopes[0]));
    sum = hn::MulAdd(y, hn::Set(tag, slopes[2]), sum);
    sum = hn::MulAdd(z, hn::Set(tag, slopes[3]), sum);
    store(hn::Add(load(to, count), sum), to, count);
  }
}

}  // namespace

void addDistant(const float* slopes, Vec3 centre, const Vec3Rows& points, std::span<float> sums) {
  const std::size_t all = points.x.size();
  for (std::size_t at = 0; at < all; at += kLanes) addAt(slopes, centre, points, at, std::min(kLanes, all - at), sums);
}

}  // namespace rigel::crowd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::crowd {

HWY_EXPORT(addDistant);

void addDistant(const float* slopes, Vec3 centre, const Vec3Rows& points, std::span<float> sums) noexcept {
  HWY_DYNAMIC_DISPATCH(addDistant)(slopes, centre, points, sums);
}

}  // namespace rigel::crowd
#endif
