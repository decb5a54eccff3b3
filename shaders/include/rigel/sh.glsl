// Real orthonormal spherical harmonics of RIGEL_BANDS bands (sh.h): no Condon-Shortley sign, coefficient index
// l(l+1)+m. The polynomials are homogeneous, r^l Y_lm, for the reason given in lights/src/sh_polynomials.h.
#ifndef RIGEL_SH_GLSL
#define RIGEL_SH_GLSL

#include "rigel/shader_constants.h"

#ifndef RIGEL_BANDS
#define RIGEL_BANDS 3
#endif
#if RIGEL_BANDS < 2 || RIGEL_BANDS > 5
#error "RIGEL_BANDS: 2 to 5"
#endif
#define RIGEL_SH_COUNT (RIGEL_BANDS * RIGEL_BANDS)

/// Y_lm(w) of the unit vector `w`.
void rigel_shBasis(vec3 w, out float y[RIGEL_SH_COUNT]) {
  y[0] = kRigelY00;
  y[1] = kRigelY1 * w.y;
  y[2] = kRigelY1 * w.z;
  y[3] = kRigelY1 * w.x;
#if RIGEL_BANDS > 2
  // Sine and cosine of 2 phi, times sin^2 theta.
  float xy2 = 2.0f * w.x * w.y;
  float xxyy = (w.x - w.y) * (w.x + w.y);
  float zz = w.z * w.z;
  float tt = w.x * w.x + w.y * w.y;
  y[4] = kRigelY22 * xy2;
  y[5] = kRigelY21 * w.y * w.z;
  y[6] = kRigelY20 * (2.0f * zz - tt);
  y[7] = kRigelY21 * w.x * w.z;
  y[8] = kRigelY22 * xxyy;
#endif
#if RIGEL_BANDS > 3
  // Of 3 phi.
  float s3 = w.x * xy2 + w.y * xxyy;
  float c3 = w.x * xxyy - w.y * xy2;
  float f31 = kRigelY31 * (4.0f * zz - tt);
  y[9] = kRigelY33 * s3;
  y[10] = kRigelY32 * w.z * xy2;
  y[11] = f31 * w.y;
  y[12] = kRigelY30 * w.z * (2.0f * zz - 3.0f * tt);
  y[13] = f31 * w.x;
  y[14] = kRigelY32 * w.z * xxyy;
  y[15] = kRigelY33 * c3;
#endif
#if RIGEL_BANDS > 4
  float f41 = kRigelY41 * w.z * (4.0f * zz - 3.0f * tt);
  float f42 = kRigelY42 * (6.0f * zz - tt);
  float f43 = kRigelY43 * w.z;
  y[16] = 2.0f * kRigelY44 * xy2 * xxyy;
  y[17] = f43 * s3;
  y[18] = f42 * xy2;
  y[19] = f41 * w.y;
  y[20] = kRigelY40 * (8.0f * zz * (zz - 3.0f * tt) + 3.0f * tt * tt);
  y[21] = f41 * w.x;
  y[22] = f42 * xxyy;
  y[23] = f43 * c3;
  y[24] = kRigelY44 * (xxyy - xy2) * (xxyy + xy2);
#endif
}

/// sum_i c_i Y_i(w), the value in direction `w` (unit).
vec3 rigel_evaluate(vec3 c[RIGEL_SH_COUNT], vec3 w) {
  float y[RIGEL_SH_COUNT];
  rigel_shBasis(w, y);
  vec3 sum = c[0] * y[0];
  for (int i = 1; i < RIGEL_SH_COUNT; ++i) sum = fma(c[i], vec3(y[i]), sum);
  return sum;
}

#endif
