// Irradiance of a sphere light, in float, normalised by pi L min(1, (r/d)^2): 1 is the peak of a light whose whole disk
// stands above the horizon.
#pragma once

#include <rigel/near_light.h>

#include <algorithm>
#include <cmath>

namespace rigel::detail {

/// The sphere as the receiver sees it. Outside s = r/d, inside s = d/r; c = sqrt(1-s^2) either way; x = n.w.
struct NearView {
  float x = 0;
  float s = 0;
  float c = 1;
  bool inside = false;
};

inline float wrapKernelFloat(float x, const NearWrap& wrap) noexcept {
  const float base = (x + wrap.a) / (1 + wrap.a);
  return base > 0 ? std::pow(base, 1 + wrap.a) : 0.0f;
}

inline float lambertCap(float x, float s, float c) noexcept {
  if (std::abs(x) >= s) return std::max(x, 0.0f);
  const float t = x / s;
  const float z = std::sqrt((1 - t) * (1 + t));
  const float arc = x * std::atan2(z, -c * t);
  const float inversePi = static_cast<float>(1 / kPi);
  const float sz = s * z;
  if (sz > 0.1f * c) return inversePi * std::max(0.0f, arc + (std::atan2(sz, c) - sz * c) / (s * s));
  const float v = sz / c;
  const float q = v * v;
  const float zc = z / c;
  return inversePi * std::max(0.0f, arc + v * (1 - zc * zc * (1.0f / 3 - q * (1.0f / 5 - q * (1.0f / 7 - q / 9)))));
}

inline float wrapCap(float x, float c, const NearWrap& wrap) noexcept {
  const float p2 = 1.5f * x * x - 0.5f;
  return wrapKernelFloat(x, wrap) + (2 / (1 + c) - 1) * 0.25f * wrap.f[0] + (c - 1) * 1.25f * wrap.f[2] * p2;
}

inline float nearSphere(const NearView& view, const NearWrap& wrap) noexcept {
  const float x = view.inside ? -view.x : view.x;
  const float cap = wrap.a == 0 ? lambertCap(x, view.s, view.c) : std::max(0.0f, wrapCap(x, view.c, wrap));
  return view.inside ? wrap.f[0] - view.s * view.s * cap : cap;
}

}  // namespace rigel::detail
