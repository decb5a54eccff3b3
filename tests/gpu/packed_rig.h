// Reading what packRig writes.
#pragma once

#include <rigel/gpu_rig.h>

#include <cstring>
#include <span>
#include <vector>

namespace rigel::test {

/// from * 4 + axis of monomial k.
inline int termOf(const GpuRig& rig, int k) {
  unsigned char bytes[sizeof rig.terms];
  std::memcpy(bytes, rig.terms, sizeof bytes);
  return bytes[k];
}

inline std::span<const float> floatsOf(std::span<const GpuVec4> texels) { return {&texels[0].x, 4 * texels.size()}; }

inline float floatFromHalf(std::uint16_t half) {
  const int exponent = half >> 10 & 31;
  const auto mantissa = static_cast<float>(half & 1023);
  const float sign = half & 0x8000 ? -1.0f : 1.0f;
  if (exponent == 31) return mantissa != 0 ? std::nanf("") : sign * std::numeric_limits<float>::infinity();
  return sign * (exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25));
}

/// As a texel buffer or texture of RGBA16F reads.
inline std::vector<float> floatsOf(std::span<const GpuHalf4> texels) {
  std::vector<float> out;
  for (const GpuHalf4& t : texels)
    for (const std::uint16_t half : {t.x, t.y, t.z, t.w}) out.push_back(floatFromHalf(half));
  return out;
}

}  // namespace rigel::test
