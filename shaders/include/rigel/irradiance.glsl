// Irradiance from one SH vector, and the clamp that ends every sum of rig and near lights.
#ifndef RIGEL_IRRADIANCE_GLSL
#define RIGEL_IRRADIANCE_GLSL

#include "rigel/wrap.glsl"

/// E(n) of a material from pi times radiance SH: evaluate(irradianceFromRadiance(...), n) of wrap.h. May be negative.
vec3 rigel_irradiance(vec3 c[RIGEL_SH_COUNT], vec3 n, GpuWrap wrap) {
  float y[RIGEL_SH_COUNT];
  rigel_wrapBasis(n, wrap, y);
  vec3 sum = c[0] * y[0];
  for (int i = 1; i < RIGEL_SH_COUNT; ++i) sum = fma(c[i], vec3(y[i]), sum);
  return sum;
}

/// What truncated SH leave below zero is no light. NaN gives 0.
vec3 rigel_clampIrradiance(vec3 e) {
  return vec3(e.x > 0.0f ? e.x : 0.0f, e.y > 0.0f ? e.y : 0.0f, e.z > 0.0f ? e.z : 0.0f);
}

#endif
