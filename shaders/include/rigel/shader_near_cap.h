// Irradiance of a sphere light in float, normalised by pi L min(1, (r/d)^2): 1 is what a small light straight above
// gives. The receiver is outside the sphere here, s = r/d, c = sqrt(1-s^2), x = n.w; inside, E(x) = f_0 - s^2 E_cap(-x)
// with s = d/r (exact.cpp). Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_NEAR_CAP_H
#define RIGEL_SHADER_NEAR_CAP_H

#include "rigel/shader_arctangent.h"
#include "rigel/shader_types.h"
#include "rigel/shader_wrap.h"

#ifdef __cplusplus
#define rigel_lambertCap lambertCap
#define rigel_lambertCapCheap lambertCapCheap
#define rigel_blurredKernel blurredKernel
#define rigel_highBandShare highBandShare
#define rigel_wrapCap wrapCap
#define rigel_kernelAboveBand2 kernelAboveBand2
namespace rigel::detail {
#endif

/// Lambert, clipped at the horizon: the form of exact.cpp, whose terms are all of the result's size, over pi s^2.
RIGEL_FUNCTION float rigel_lambertCap(float x, float s, float c) RIGEL_NOEXCEPT {
  if (abs(x) >= s) return max(x, 0.0f);
  float t = x / s;
  float z = sqrt((1.0f - t) * (1.0f + t));
  float quadrant = rigel_atanQuadrant(z, c * abs(t));
  float arc = x * (t > 0.0f ? float(kRigelPi) - quadrant : quadrant);
  float sz = s * z;
  float rest;
  if (sz > c) {
    rest = (rigel_atanQuadrant(sz, c) - sz * c) / (s * s);
  } else {
    // s^2 v - (v - atan v), v = s z/c, over s^2.
    float zc = z / max(c, 1e-30f);
    float v = s * zc;
    rest = v * (1.0f - zc * zc * rigel_atanTail(v * v));
  }
  return max(0.0f, arc + rest) * float(1.0 / kRigelPi);
}

/// Lambert, cheap: the parabola (x+s)^2/4s between x = -s and s, plus (s/4) g(c) (1-(x/s)^2). g is a fit over all
/// normals for each c; g(0) = 1 makes the touching sphere, (1+x)/2, exact.
RIGEL_FUNCTION float rigel_lambertCapCheap(float x, float s, float c) RIGEL_NOEXCEPT {
  float t = clamp(x / s, -1.0f, 1.0f);
  float g = 1.0f + c * (-2.818f + c * (2.973f - c * 1.285f));
  return max(x - s, 0.0f) + 0.25f * s * (1.0f + t) * (1.0f + t + g * (1.0f - t));
}

/// f(x|a) with its corner at the horizon blurred over +-width in u = (x+a)/(1+a).
RIGEL_FUNCTION float rigel_blurredKernel(float x, float width, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  float u = (x + wrap.a) * wrap.inverse;
  float halfWidth = max(width, 1e-6f);
  float t = 1.0f + clamp(u / halfWidth, -1.0f, 1.0f);
  return rigel_wrapPower(0.25f * halfWidth * t * t + max(u - halfWidth, 0.0f), wrap.a);
}

/// How much of the kernel's bands from 5 on a sphere of angular size s keeps; with GpuWrap's blur a fit over all a.
RIGEL_FUNCTION float rigel_highBandShare(float s2) RIGEL_NOEXCEPT {
  return max(0.0f, 1.0f - s2 * (2.111f + 1.709f * s2));
}

/// Any wrap: the first five bands as SH give them, and above them the blurred kernel's, less and less the larger the
/// light,
///   h blurred(x) + sum_{l<5} (2l+1)/4 [f_l (2 k_l - h) - h blurBand_l s^2 (1 - 1.474 s^2)] P_l(x),
/// k_l the zonal factors of zonal.h.
RIGEL_FUNCTION float rigel_wrapCap(float x, float s, float c, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  float s2 = s * s;
  float h = rigel_highBandShare(s2);
  float blur = h * s2 * (1.0f - 1.474f * s2);
  float b0 = wrap.f.x * (2.0f / (1.0f + c) - h) - blur * wrap.blurBand.x;
  float b1 = wrap.f.y * (1.0f - h) - blur * wrap.blurBand.y;
  float b2 = wrap.f.z * (c - h) - blur * wrap.blurBand.z;
  float b3 = wrap.f.w * (1.0f - 1.25f * s2 - h) - blur * wrap.blurBand.w;
  float b4 = wrap.f4 * (c * (1.0f - 1.75f * s2) - h) - blur * wrap.blurBand4;
  float q = x * x;
  // (2l+1)/4 P_l(x) by powers of x.
  float e = 0.25f * b0 - 0.625f * b2 + 0.84375f * b4 + q * (1.875f * b2 - 8.4375f * b4 + q * (9.84375f * b4));
  e += x * (0.75f * b1 - 2.625f * b3 + q * (4.375f * b3));
  if (h > 0.0f) e += h * wrap.gain * rigel_blurredKernel(x, wrap.blur * s, wrap);
  // No cap gives more than the whole sphere: where it touches, held at both ends or E would jump on the way in.
  if (h <= 0.0f) e = min(e, wrap.f.x / s2);
  return max(e, 0.0f);
}

/// The delta kernel less its own three bands.
RIGEL_FUNCTION float rigel_kernelAboveBand2(float x, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  float kernel = wrap.a == 0.0f ? max(x, 0.0f) : rigel_blurredKernel(x, 0.0f, wrap);
  float bands = 0.25f * wrap.f.x + 0.75f * wrap.f.y * x + wrap.f.z * (1.875f * x * x - 0.625f);
  return wrap.gain * kernel - bands;
}

#ifdef __cplusplus
}  // namespace rigel::detail
#endif

#endif
