// Where a rig's SH vectors come from, and the two things done with them: the dot product with a basis, and the sum.
//
// RIGEL_SOURCE is the type of what coefficients are read from, RIGEL_FETCH(source, i) its vec4 i: a texel buffer unless
// defined before. A uniform block does with
//   #define RIGEL_SOURCE int
//   #define RIGEL_FETCH(source, i) block.coefficients[i]
// RIGEL_BANDS (2 to 5) is that of the rig. Coefficients are pi times radiance SH, interleaved RGB, one coefficient after
// the other, RIGEL_SH_VEC4 vec4 a vector.
//
// Unrolled by hand, and with fused products: Mesa's lavapipe does neither on its own, and takes twice as long.
#ifndef RIGEL_RIG_SOURCE_GLSL
#define RIGEL_RIG_SOURCE_GLSL

#include "rigel/sh.glsl"

#ifndef RIGEL_SOURCE
#define RIGEL_SOURCE samplerBuffer
#define RIGEL_FETCH(source, i) texelFetch(source, i)
#endif

#define RIGEL_SH_VEC4 ((3 * RIGEL_SH_COUNT + 3) / 4)

// GLSL before 4.00 and ES before 3.20 have no fma; there it is a hint to nobody.
#ifndef RIGEL_FMA
#if __VERSION__ >= 400 || (defined(GL_ES) && __VERSION__ >= 320)
#define RIGEL_FMA(a, b, c) fma(a, b, c)
#else
#define RIGEL_FMA(a, b, c) ((a) * (b) + (c))
#endif
#endif

// Three vec4 hold four coefficients; with an odd number of bands one is left over at the end.
#define RIGEL_QUAD_DOT(q)                                         \
  a = RIGEL_FETCH(source, at + 3 * (q));                          \
  b = RIGEL_FETCH(source, at + 3 * (q) + 1);                      \
  c = RIGEL_FETCH(source, at + 3 * (q) + 2);                      \
  sum = RIGEL_FMA(a.xyz, vec3(y[4 * (q)]), sum);                  \
  sum = RIGEL_FMA(vec3(a.w, b.xy), vec3(y[4 * (q) + 1]), sum);    \
  sum = RIGEL_FMA(vec3(b.zw, c.x), vec3(y[4 * (q) + 2]), sum);    \
  sum = RIGEL_FMA(c.yzw, vec3(y[4 * (q) + 3]), sum);

#define RIGEL_QUAD_ADD(q)                                                         \
  a = RIGEL_FETCH(source, at + 3 * (q));                                          \
  b = RIGEL_FETCH(source, at + 3 * (q) + 1);                                      \
  c = RIGEL_FETCH(source, at + 3 * (q) + 2);                                      \
  sh[4 * (q)] = RIGEL_FMA(a.xyz, vec3(weight), sh[4 * (q)]);                      \
  sh[4 * (q) + 1] = RIGEL_FMA(vec3(a.w, b.xy), vec3(weight), sh[4 * (q) + 1]);    \
  sh[4 * (q) + 2] = RIGEL_FMA(vec3(b.zw, c.x), vec3(weight), sh[4 * (q) + 2]);    \
  sh[4 * (q) + 3] = RIGEL_FMA(c.yzw, vec3(weight), sh[4 * (q) + 3]);

#if RIGEL_BANDS == 2
#define RIGEL_QUADS(DO) DO(0)
#elif RIGEL_BANDS == 3
#define RIGEL_QUADS(DO) DO(0) DO(1)
#elif RIGEL_BANDS == 4
#define RIGEL_QUADS(DO) DO(0) DO(1) DO(2) DO(3)
#elif RIGEL_BANDS == 5
#define RIGEL_QUADS(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5)
#else
#error "RIGEL_BANDS must be 2, 3, 4 or 5"
#endif

/// sum_i y_i c_i of the SH vector at vec4 `at`.
vec3 rigel_dotVector(RIGEL_SOURCE source, int at, float y[RIGEL_SH_COUNT]) {
  vec4 a, b, c;
  vec3 sum = vec3(0.0);
  RIGEL_QUADS(RIGEL_QUAD_DOT)
#if RIGEL_BANDS == 3 || RIGEL_BANDS == 5
  sum = RIGEL_FMA(RIGEL_FETCH(source, at + RIGEL_SH_VEC4 - 1).xyz, vec3(y[RIGEL_SH_COUNT - 1]), sum);
#endif
  return sum;
}

/// sh += weight times the SH vector at vec4 `at`.
void rigel_addVector(RIGEL_SOURCE source, int at, float weight, inout vec3 sh[RIGEL_SH_COUNT]) {
  vec4 a, b, c;
  RIGEL_QUADS(RIGEL_QUAD_ADD)
#if RIGEL_BANDS == 3 || RIGEL_BANDS == 5
  sh[RIGEL_SH_COUNT - 1] =
      RIGEL_FMA(RIGEL_FETCH(source, at + RIGEL_SH_VEC4 - 1).xyz, vec3(weight), sh[RIGEL_SH_COUNT - 1]);
#endif
}

// What a rig's basis functions are summed into; every rig has both forms. In the scope of `source` and `y` or `sh`:
// irradiance e, or the SH vector.
#define RIGEL_ADD_IRRADIANCE(at, weight) e = RIGEL_FMA(rigel_dotVector(source, at, y), vec3(weight), e);
#define RIGEL_ADD_SH(at, weight) rigel_addVector(source, at, weight, sh);

void rigel_clearSh(out vec3 sh[RIGEL_SH_COUNT]) {
  for (int i = 0; i < RIGEL_SH_COUNT; ++i) sh[i] = vec3(0.0);
}

#endif
