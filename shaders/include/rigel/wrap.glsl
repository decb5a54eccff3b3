// Wrap reflectance (wrap.h): kernel, coefficients, convolution. Materials whose wrap is known on the CPU bring a GpuWrap
// from gpuWrap; the functions of `a` are for those whose wrap a texture gives.
#ifndef RIGEL_WRAP_GLSL
#define RIGEL_WRAP_GLSL

#include "rigel/sh.glsl"
#include "rigel/shader_types.h"
#include "rigel/shader_wrap.h"

/// `a` held within what wraps there are; NaN gives 0, Lambert.
float rigel_clampWrap(float a) { return isnan(a) ? 0.0f : clamp(a, kRigelMinWrap, kRigelMaxWrap); }

/// 1 / f_0: what makes irradiance that of the energy-normalised kernel.
float rigel_wrapEnergy(float a) {
  a = rigel_clampWrap(a);
  return 1.0f - 0.5f * a / (1.0f + a);
}

/// f_l(a), l < RIGEL_BANDS. Each as its value for Lambert and a small rest, so that no digits are lost.
void rigel_wrapCoefficients(float a, out float f[RIGEL_BANDS]) {
  a = rigel_clampWrap(a);
  float d2 = 2.0f + a;
  float d3 = d2 * (3.0f + a);
  f[0] = 1.0f + a / d2;
  f[1] = 2.0f / 3.0f + (2.0f / 3.0f) * a * (1.0f - a) / d3;
#if RIGEL_BANDS > 2
  float d4 = d3 * (4.0f + a);
  f[2] = 0.25f + 0.25f * a * (a * (7.0f * a - 17.0f) - 18.0f) / d4;
#endif
#if RIGEL_BANDS > 3
  float d5 = d4 * (5.0f + a);
  float b = (1.0f - a) * (1.0f + a);
  f[3] = -2.0f * a * b * (7.0f - 5.0f * a) / d5;
#endif
#if RIGEL_BANDS > 4
  f[4] = 2.0f * b * (a * (a * (46.0f - 36.0f * a) + 7.0f) - 15.0f) / (d5 * (6.0f + a));
#endif
}

/// f_l of a prepared wrap, as gpuWrap left them (times its gain).
void rigel_wrapCoefficients(GpuWrap wrap, out float f[RIGEL_BANDS]) {
  f[0] = wrap.f.x;
  f[1] = wrap.f.y;
#if RIGEL_BANDS > 2
  f[2] = wrap.f.z;
#endif
#if RIGEL_BANDS > 3
  f[3] = wrap.f.w;
#endif
#if RIGEL_BANDS > 4
  f[4] = wrap.f4;
#endif
}

/// y_lm times f_l: turns the basis of a normal into what pi times radiance SH are multiplied by to give irradiance.
/// Once a point, however many SH vectors follow.
void rigel_convolve(float f[RIGEL_BANDS], inout float y[RIGEL_SH_COUNT]) {
  y[0] *= f[0];
  for (int i = 1; i < 4; ++i) y[i] *= f[1];
#if RIGEL_BANDS > 2
  for (int i = 4; i < 9; ++i) y[i] *= f[2];
#endif
#if RIGEL_BANDS > 3
  for (int i = 9; i < 16; ++i) y[i] *= f[3];
#endif
#if RIGEL_BANDS > 4
  for (int i = 16; i < 25; ++i) y[i] *= f[4];
#endif
}

/// f_l Y_lm(n).
void rigel_wrapBasis(vec3 n, GpuWrap wrap, out float y[RIGEL_SH_COUNT]) {
  float f[RIGEL_BANDS];
  rigel_wrapCoefficients(wrap, f);
  rigel_shBasis(n, y);
  rigel_convolve(f, y);
}

#endif
