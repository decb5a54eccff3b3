// Lattice rigs as a 3-D texture, interpolated by the texture unit.
//
// One texture holds the RIGEL_SH_VEC4 vec4 of the rig's vectors as slabs along its depth: slab i is the grid of nodes
// with vec4 i of each. It wants a sampler that filters linearly and clamps to the edge. Within a slab coordinates stay
// half a texel from its ends, so that slabs never mix. packTexture (gpu_rig.h) makes it, with the axes by decreasing
// number of nodes, so that the slabs take the least depth.
#ifndef RIGEL_RIG_TEXTURE_GLSL
#define RIGEL_RIG_TEXTURE_GLSL

#include "rigel/rig_box.glsl"
#include "rigel/rig_source.glsl"
#include "rigel/rig_tensor.glsl"
#include "rigel/shader_lattice.h"
#include "rigel/shader_types.h"

/// Where `u` is in slab 0, in [0, 1]^3 of the texture; the step from slab to slab in z is 1 / RIGEL_SH_VEC4. kGpuSmooth
/// bends the way from node to node; kGpuCubic is not to be had in one look-up and is refused by the packing.
vec3 rigel_textureCoordinates(GpuRig rig, vec3 u) {
  vec3 nodes = vec3(RIGEL_NODES(rig));
  vec3 x = (clamp(u, -1.0, 1.0) + 1.0) * 0.5 * (nodes - 1.0);
  if (RIGEL_KERNEL(rig) == kGpuSmooth) {
    vec3 cell = floor(x);
    vec3 t = x - cell;
    x = cell + vec3(rigel_latticeSmooth(t.x), rigel_latticeSmooth(t.y), rigel_latticeSmooth(t.z));
  }
  return (x + 0.5) / (nodes * vec3(1.0, 1.0, float(RIGEL_SH_VEC4)));
}

#define RIGEL_SLAB(i) \
  textureLod(lattice, vec3(at.xy, at.z + float(i) * (1.0 / float(RIGEL_SH_VEC4))), 0.0)

#define RIGEL_SLAB_DOT(q)                                         \
  a = RIGEL_SLAB(3 * (q));                                        \
  b = RIGEL_SLAB(3 * (q) + 1);                                    \
  c = RIGEL_SLAB(3 * (q) + 2);                                    \
  e = RIGEL_FMA(a.xyz, vec3(y[4 * (q)]), e);                      \
  e = RIGEL_FMA(vec3(a.w, b.xy), vec3(y[4 * (q) + 1]), e);        \
  e = RIGEL_FMA(vec3(b.zw, c.x), vec3(y[4 * (q) + 2]), e);        \
  e = RIGEL_FMA(c.yzw, vec3(y[4 * (q) + 3]), e);

#define RIGEL_SLAB_COPY(q)                                        \
  a = RIGEL_SLAB(3 * (q));                                        \
  b = RIGEL_SLAB(3 * (q) + 1);                                    \
  c = RIGEL_SLAB(3 * (q) + 2);                                    \
  sh[4 * (q)] = scale * a.xyz;                                    \
  sh[4 * (q) + 1] = scale * vec3(a.w, b.xy);                      \
  sh[4 * (q) + 2] = scale * vec3(b.zw, c.x);                      \
  sh[4 * (q) + 3] = scale * c.yzw;

/// As rigel_rigIrradiance, of a rig whose coefficients are in `lattice`.
vec3 rigel_textureIrradiance(sampler3D lattice, GpuRig rig, vec3 p, float y[RIGEL_SH_COUNT]) {
  vec3 at = rigel_textureCoordinates(rig, rigel_boxCoordinates(rig, p));
  vec4 a, b, c;
  vec3 e = vec3(0.0);
  RIGEL_QUADS(RIGEL_SLAB_DOT)
#if RIGEL_BANDS == 3 || RIGEL_BANDS == 5
  e = RIGEL_FMA(RIGEL_SLAB(RIGEL_SH_VEC4 - 1).xyz, vec3(y[RIGEL_SH_COUNT - 1]), e);
#endif
  return e * rig.scale;
}

/// As rigel_rigSh.
void rigel_textureSh(sampler3D lattice, GpuRig rig, vec3 p, out vec3 sh[RIGEL_SH_COUNT]) {
  vec3 at = rigel_textureCoordinates(rig, rigel_boxCoordinates(rig, p));
  float scale = rig.scale;
  vec4 a, b, c;
  RIGEL_QUADS(RIGEL_SLAB_COPY)
#if RIGEL_BANDS == 3 || RIGEL_BANDS == 5
  sh[RIGEL_SH_COUNT - 1] = scale * RIGEL_SLAB(RIGEL_SH_VEC4 - 1).xyz;
#endif
}

#endif
