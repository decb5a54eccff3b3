// The wrap kernel ((x + a)/(1 + a))^(1 + a) in float (wrap.h), its power as polynomials. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_WRAP_H
#define RIGEL_SHADER_WRAP_H

#include "rigel/shader_language.h"

#ifdef __cplusplus
#define rigel_wrapPower wrapPower
#define rigel_wrapKernel wrapKernel
namespace rigel::detail {
#endif

/// base^(1+a) = base 2^(a log2 base) for 0 <= base <= 2 and -0.25 <= a <= 1: to 4.5e-7 of max(1, base^(1+a)). Exact for
/// a = 0, for base 0 and 1. One division; NaN gives NaN. With base = 2^e m the whole part of a e goes into the exponent
/// bits; what is left of it and a log2 m go into the exponential. Minimax fits: log2 m = z P(z^2), z = (m-1)/(m+1), to
/// 1.2e-7, and 2^f = 1 + f Q(f), |f| <= 1, to 2.7e-7, both relative; summed in pairs, since it is latency that counts.
RIGEL_FUNCTION float rigel_wrapPower(float base, float a) RIGEL_NOEXCEPT {
  // m in [sqrt 1/2, sqrt 2); base = 0 gives some finite logarithm of no consequence.
  uint bits = floatBitsToUint(base);
  int e = int(bits - 0x3f3504f3u) >> 23;
  float m = uintBitsToFloat(bits - (uint(e) << 23u));
  float z = (m - 1.0f) / (m + 1.0f);
  float q = z * z;
  float perZ = 2.88539052f + q * (0.961587489f + q * 0.595819175f);

  float shift = a * float(e);
  int whole = int(shift + 256.5f) - 256;
  float f = (shift - float(whole)) + a * z * perZ;
  float f2 = f * f;
  float perF = (0.693148315f + f * 0.240224734f) +
               f2 * ((0.0554926805f + f * 0.00962319039f) + f2 * (0.00135869742f + f * 0.000151883476f));
  float scaled = base * uintBitsToFloat(uint(whole + 127) << 23u);
  return scaled + scaled * f * perF;
}

/// f(theta|a) for x = cos theta.
RIGEL_FUNCTION float rigel_wrapKernel(float x, float a) RIGEL_NOEXCEPT {
  return rigel_wrapPower(max(0.0f, (x + a) / (1.0f + a)), a);
}

#ifdef __cplusplus
}  // namespace rigel::detail
#endif

#endif
