#include "bench/wallace_batch.h"

#include <rigel/shader_constants.h>

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/wallace_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef RIGEL_WALLACE_POINTS
#define RIGEL_WALLACE_POINTS
namespace rigel::tools {
struct WallacePoints {
  const float *x, *y, *z, *nx, *ny, *nz;
  std::size_t count;
};
}  // namespace rigel::tools
#endif

HWY_BEFORE_NAMESPACE();
namespace rigel::tools::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE void wallaceVector(D d, const DiskLight& light, Vec3 axis, const WallacePoints& in, std::size_t i,
                              float* out) {
  using V = hn::Vec<D>;
  const float pi = static_cast<float>(kRigelPi);
  const V zero = hn::Zero(d);
  V wx = hn::Sub(hn::Set(d, light.position.x), hn::LoadU(d, in.x + i));
  V wy = hn::Sub(hn::Set(d, light.position.y), hn::LoadU(d, in.y + i));
  V wz = hn::Sub(hn::Set(d, light.position.z), hn::LoadU(d, in.z + i));
  const V squared = hn::MulAdd(wx, wx, hn::MulAdd(wy, wy, hn::Mul(wz, wz)));
  const V inverse = hn::Div(hn::Set(d, 1.0f), hn::Sqrt(squared));
  wx = hn::Mul(wx, inverse);
  wy = hn::Mul(wy, inverse);
  wz = hn::Mul(wz, inverse);
  const V atReceiver = hn::MulAdd(wx, hn::LoadU(d, in.nx + i),
                                  hn::MulAdd(wy, hn::LoadU(d, in.ny + i), hn::Mul(wz, hn::LoadU(d, in.nz + i))));
  const V atLight =
      hn::Neg(hn::MulAdd(wx, hn::Set(d, axis.x), hn::MulAdd(wy, hn::Set(d, axis.y), hn::Mul(wz, hn::Set(d, axis.z)))));
  const V area = hn::Set(d, pi * light.radius * light.radius);
  const V cosines = hn::Mul(hn::Max(atReceiver, zero), hn::Max(atLight, zero));
  const V factor = hn::Div(hn::Mul(area, cosines), hn::MulAdd(hn::Set(d, pi), squared, area));
  hn::StoreU(hn::Mul(hn::Set(d, pi), factor), d, out + i);
}

void wallacePoints(const DiskLight& light, const WallacePoints& in, float* out) {
  const Vec3 axis = light.direction * (1 / length(light.direction));
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= in.count; i += hn::Lanes(d)) wallaceVector(d, light, axis, in, i, out);
  for (; i < in.count; ++i) wallaceVector(one, light, axis, in, i, out);
}

}  // namespace rigel::tools::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::tools {

HWY_EXPORT(wallacePoints);

void wallaceBatch(const DiskLight& light, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                  std::span<const float> nx, std::span<const float> ny, std::span<const float> nz,
                  std::span<float> irradiance) {
  HWY_DYNAMIC_DISPATCH(wallacePoints)
  (light, {x.data(), y.data(), z.data(), nx.data(), ny.data(), nz.data(), x.size()}, irradiance.data());
}

}  // namespace rigel::tools
#endif
