// poly, auto and invquad: a polynomial of box coordinates, and one over a falloff.
//
// Terms are unrolled up to RIGEL_POLY_MAX (24 unless defined, as many as `auto` has; at most 56), each under a condition
// on the rig's number of vectors, so that K may change from frame to frame and from object to object. What shapes the
// polynomial comes from the rig, or from what an entry shader defines instead; of specialisation constants nothing but
// the sums is left.
//   RIGEL_VECTORS(rig)  K > 0
//   RIGEL_TERM(rig, k)  from * 4 + axis: monomial k is monomial `from` times coordinate `axis`
//   RIGEL_OFFSET(rig)   vec4 where the coefficients begin: 0 for a uniform block that holds one rig
// With RIGEL_POLY_LOOP the sum is a loop to K: for software devices, which take both sides of every condition. Up to 24
// monomials are still made before it; more are made on the way, or compiling would take minutes.
#ifndef RIGEL_RIG_POLY_GLSL
#define RIGEL_RIG_POLY_GLSL

#include "rigel/rig_source.glsl"
#include "rigel/shader_types.h"

#ifndef RIGEL_POLY_MAX
#define RIGEL_POLY_MAX 24
#endif
#ifndef RIGEL_VECTORS
#define RIGEL_VECTORS(rig) rig.vectors
#endif
#ifndef RIGEL_TERM
#define RIGEL_TERM(rig, k) ((rig.terms[(k) >> 4][((k) >> 2) & 3] >> (8 * ((k) & 3))) & 255)
#endif
#ifndef RIGEL_OFFSET
#define RIGEL_OFFSET(rig) rig.offset
#endif

#define RIGEL_MONOMIAL(ADD, k) phi[k] = phi[RIGEL_TERM(rig, k) >> 2] * u[RIGEL_TERM(rig, k) & 3];
#define RIGEL_POLY_TERM(ADD, k)                                  \
  if ((k) < RIGEL_VECTORS(rig)) {                                \
    RIGEL_MONOMIAL(ADD, k)                                       \
    ADD(RIGEL_OFFSET(rig) + (k) * RIGEL_SH_VEC4, phi[k])         \
  }

#define RIGEL_POLY_4(DO, ADD, k) DO(ADD, k) DO(ADD, (k) + 1) DO(ADD, (k) + 2) DO(ADD, (k) + 3)
#define RIGEL_POLY_8(DO, ADD, k) RIGEL_POLY_4(DO, ADD, k) RIGEL_POLY_4(DO, ADD, (k) + 4)
#if RIGEL_POLY_MAX > 8
#define RIGEL_POLY_FROM_8(DO, ADD) RIGEL_POLY_8(DO, ADD, 8)
#else
#define RIGEL_POLY_FROM_8(DO, ADD)
#endif
#if RIGEL_POLY_MAX > 16
#define RIGEL_POLY_FROM_16(DO, ADD) RIGEL_POLY_8(DO, ADD, 16)
#else
#define RIGEL_POLY_FROM_16(DO, ADD)
#endif
#if RIGEL_POLY_MAX > 24
#define RIGEL_POLY_FROM_24(DO, ADD) RIGEL_POLY_8(DO, ADD, 24)
#else
#define RIGEL_POLY_FROM_24(DO, ADD)
#endif
#if RIGEL_POLY_MAX > 32
#define RIGEL_POLY_FROM_32(DO, ADD) RIGEL_POLY_8(DO, ADD, 32)
#else
#define RIGEL_POLY_FROM_32(DO, ADD)
#endif
#if RIGEL_POLY_MAX > 40
#define RIGEL_POLY_FROM_40(DO, ADD) RIGEL_POLY_8(DO, ADD, 40)
#else
#define RIGEL_POLY_FROM_40(DO, ADD)
#endif
#if RIGEL_POLY_MAX > 48
#define RIGEL_POLY_FROM_48(DO, ADD) RIGEL_POLY_8(DO, ADD, 48)
#else
#define RIGEL_POLY_FROM_48(DO, ADD)
#endif
// DO(ADD, k) for every k from 1.
#define RIGEL_POLY_ALL(DO, ADD)                                                                          \
  DO(ADD, 1) DO(ADD, 2) DO(ADD, 3) RIGEL_POLY_4(DO, ADD, 4)                                              \
  RIGEL_POLY_FROM_8(DO, ADD) RIGEL_POLY_FROM_16(DO, ADD) RIGEL_POLY_FROM_24(DO, ADD)                     \
  RIGEL_POLY_FROM_32(DO, ADD) RIGEL_POLY_FROM_40(DO, ADD) RIGEL_POLY_FROM_48(DO, ADD)

#define RIGEL_POLY_PHI ((RIGEL_POLY_MAX + 8) / 8 * 8)
#if defined(RIGEL_POLY_LOOP) && RIGEL_POLY_MAX > 24
#define RIGEL_POLY_SUM(ADD)                    \
  phi[0] = 1.0;                                \
  int at = RIGEL_OFFSET(rig);                  \
  int k = 0;                                   \
  do {                                         \
    ADD(at, phi[k])                            \
    at += RIGEL_SH_VEC4;                       \
    ++k;                                       \
    RIGEL_MONOMIAL(ADD, k)                     \
  } while (k < RIGEL_VECTORS(rig));
#elif defined(RIGEL_POLY_LOOP)
#define RIGEL_POLY_SUM(ADD)                    \
  phi[0] = 1.0;                                \
  RIGEL_POLY_ALL(RIGEL_MONOMIAL, ADD)          \
  int at = RIGEL_OFFSET(rig);                  \
  int k = 0;                                   \
  do {                                         \
    ADD(at, phi[k])                            \
    at += RIGEL_SH_VEC4;                       \
    ++k;                                       \
  } while (k < RIGEL_VECTORS(rig));
#else
#define RIGEL_POLY_SUM(ADD)                    \
  phi[0] = 1.0;                                \
  ADD(RIGEL_OFFSET(rig), 1.0)                  \
  RIGEL_POLY_ALL(RIGEL_POLY_TERM, ADD)
#endif

/// sum_k phi_k(u) sum_i y_i c_ki: with y the basis of the normal times f_l, irradiance over the rig's scale.
vec3 rigel_polyIrradiance(RIGEL_SOURCE source, GpuRig rig, vec3 u, float y[RIGEL_SH_COUNT]) {
  float phi[RIGEL_POLY_PHI];
  vec3 e = vec3(0.0);
  RIGEL_POLY_SUM(RIGEL_ADD_IRRADIANCE)
  return e;
}

/// sum_k phi_k(u) c_k: pi times radiance SH over the rig's scale.
void rigel_polySh(RIGEL_SOURCE source, GpuRig rig, vec3 u, out vec3 sh[RIGEL_SH_COUNT]) {
  float phi[RIGEL_POLY_PHI];
  rigel_clearSh(sh);
  RIGEL_POLY_SUM(RIGEL_ADD_SH)
}

/// q > 0, what invquad divides by, at the point of the box that is nearest to u.
float rigel_falloff(GpuRig rig, vec3 u) {
  vec3 v = clamp(u, -1.0, 1.0);
  vec4 a = rig.falloff[0];
  vec4 b = rig.falloff[1];
  vec2 c = rig.falloff[2].xy;
  return c.y + v.x * (b.z + a.x * v.x + a.w * v.y + b.x * v.z) + v.y * (b.w + a.y * v.y + b.y * v.z) +
         v.z * (c.x + a.z * v.z);
}

#endif
