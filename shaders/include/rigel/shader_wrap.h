// The wrap kernel ((x + a)/(1 + a))^(1 + a) in float (wrap.h), its power as polynomials. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_WRAP_H
#define RIGEL_SHADER_WRAP_H

#include <rigel/shader_language.h>

#ifdef __cplusplus
#define rigel_wrapPower wrapPower
#define rigel_wrapKernel wrapKernel
namespace rigel::detail {
#endif

/// base^(1+a) = base 2^(a log2 base) for 0 <= base <= 2 and -0.25 <= a <= 1: to 1.5e-7 of max(1, base^(1+a)). Exact for
/// a = 0, for base 0 and 1. One division; NaN gives NaN. Minimax fits: log2 m = z P(z^2), z = (m-1)/(m+1), to 7e-10
/// and 2^f - 1 = f Q(f), |f| <= 1/2, to 2e-9, both relative.
RIGEL_FUNCTION float rigel_wrapPower(float base, float a) RIGEL_NOEXCEPT {
  // base = 2^e m with m in [sqrt 1/2, sqrt 2); base = 0 gives some finite logarithm of no consequence.
  uint bits = floatBitsToUint(base);
  int e = int(bits - 0x3f3504f3u) >> 23;
  float m = uintBitsToFloat(bits - (uint(e) << 23u));
  float z = (m - 1.0f) / (m + 1.0f);
  float q = z * z;
  float logarithm = float(e) + z * (2.88539004f + q * (0.961798847f + q * (0.576712906f + q * 0.431776285f)));

  float exponent = a * logarithm;
  int whole = int(exponent + 256.5f) - 256;
  float f = exponent - float(whole);
  float fraction =
      f * (0.693147182f + f * (0.240226477f + f * (0.0555033199f +
                                                   f * (0.00961843971f + f * (0.00133991020f + f * 0.000153530797f)))));
  float scaled = base * uintBitsToFloat(uint(whole + 127) << 23u);
  return scaled + scaled * fraction;
}

/// f(theta|a) for x = cos theta.
RIGEL_FUNCTION float rigel_wrapKernel(float x, float a) RIGEL_NOEXCEPT {
  return rigel_wrapPower(max(0.0f, (x + a) / (1.0f + a)), a);
}

#ifdef __cplusplus
}  // namespace rigel::detail
#endif

#endif
