// What every shader that lights an object shares: bindings, specialisation, and the sum of rig, high band and near
// lights. Effects (shader_effects.h) are specialisation constants, all off unless asked for: what a scene lacks is
// folded away by the driver. Tests compare with shaders that never had an effect: they declare its constant as false
// (RIGEL_EFFECTS_DECLARED), define RIGEL_HAS_x accordingly and leave whole parts out by RIGEL_WITHOUT_x (diskTable,
// highBand, near, texture).
#ifndef RIGEL_ENTRY_SHADE_OBJECT_GLSL
#define RIGEL_ENTRY_SHADE_OBJECT_GLSL

#include "rigel/shader_constants.h"
#include "rigel/shader_effects.h"
#include "rigel/shader_types.h"

#ifndef RIGEL_EFFECTS_DECLARED
#define RIGEL_EFFECT(name, id) layout(constant_id = id) const bool name = false;
RIGEL_EFFECTS(RIGEL_EFFECT)
#undef RIGEL_EFFECT
#endif

// What an object's rig is made of, where it is known when the pipeline is made; 0 vectors or nodes: as GpuRig says.
layout(constant_id = 40) const int kVectors = 0;
layout(constant_id = 41) const int kNodesX = 0;
layout(constant_id = 42) const int kNodesY = 1;
layout(constant_id = 43) const int kNodesZ = 1;
layout(constant_id = 44) const int kSlopeX = 0;
layout(constant_id = 45) const int kSlopeY = 0;
layout(constant_id = 46) const int kSlopeZ = 0;
layout(constant_id = 47) const int kPerNode = 1;
layout(constant_id = 48) const int kKernel = 0;
// The monomials as GpuRig packs them, 0 where they are to be read from there.
layout(constant_id = 49) const bool kTermsKnown = false;
layout(constant_id = 50) const int kTerms0 = 0;
layout(constant_id = 51) const int kTerms1 = 0;
layout(constant_id = 52) const int kTerms2 = 0;
layout(constant_id = 53) const int kTerms3 = 0;
layout(constant_id = 54) const int kTerms4 = 0;
layout(constant_id = 55) const int kTerms5 = 0;
#define RIGEL_KNOWN_TERMS(q) \
  ((q) == 0 ? kTerms0 : (q) == 1 ? kTerms1 : (q) == 2 ? kTerms2 : (q) == 3 ? kTerms3 : (q) == 4 ? kTerms4 : kTerms5)

// Functions rather than expressions: glslang 12 puts out operations on specialisation constants in the wrong order.
bool hasKind(int kind) {
  if (kind == kGpuRigConstant) return rig_constant;
  if (kind == kGpuRigPoly) return rig_poly;
  if (kind == kGpuRigInvquad) return rig_invquad;
  if (kind == kGpuRigGauss) return rig_gauss;
  return rig_tensor && !rig_gauss;
}
bool hasNear(int kind) {
  if (kind == kGpuDirectional) return light_near_directional;
  if (kind == kGpuPoint) return light_near_point;
  if (kind == kGpuSpot) return light_near_spot;
  if (kind == kGpuDisk) return light_near_disk;
  return light_near_sphere;
}
#ifndef RIGEL_HAS_KIND
#define RIGEL_HAS_KIND(kind) hasKind(kind)
#endif
#ifndef RIGEL_HAS_NEAR
#define RIGEL_HAS_NEAR(kind) hasNear(kind)
#endif
#define RIGEL_HAS_NEAR_WRAP light_near_wrap
#define RIGEL_DISK_BY_QUADRATURE light_near_diskQuadrature
#define RIGEL_DISK_BY_TABLE light_near_diskTable
#ifndef RIGEL_WITHOUT_diskTable
// One texture after the other, row by row.
#define RIGEL_DISK_TEXEL(texture, x, y) \
  texelFetch(diskTable, ((texture) * RIGEL_DISK_TABLE_SIZE + (y)) * RIGEL_DISK_TABLE_SIZE + (x))
#endif

#define RIGEL_VECTORS(rig) (kVectors > 0 ? kVectors : rig.vectors)
#define RIGEL_RIG_TERM(rig, k) ((rig.terms[(k) >> 4][((k) >> 2) & 3] >> (8 * ((k)&3))) & 255)
#ifndef RIGEL_POLY_MAX
#define RIGEL_POLY_MAX 16  // what is worth unrolling
#endif
#if RIGEL_POLY_MAX <= 24
#define RIGEL_TERM(rig, k) (kTermsKnown ? (RIGEL_KNOWN_TERMS((k) >> 2) >> (8 * ((k)&3))) & 255 : RIGEL_RIG_TERM(rig, k))
#endif
#define RIGEL_NODES(rig) (kNodesX > 0 ? ivec3(kNodesX, kNodesY, kNodesZ) : rig.nodes)
#define RIGEL_SLOPE(rig) (kNodesX > 0 ? ivec3(kSlopeX, kSlopeY, kSlopeZ) : rig.slope)
#define RIGEL_PER_NODE(rig) (kNodesX > 0 ? kPerNode : rig.perNode)
#define RIGEL_KERNEL(rig) (kNodesX > 0 ? kKernel : rig.kernel)
// Half-float coefficients leave no room for nodes: those have a buffer of their own.
#define RIGEL_GAUSS(source, rig, i) texelFetch(gaussNodes, rig.gaussOffset + (i))

layout(set = 0, binding = 0) uniform samplerBuffer coefficients;
layout(set = 0, binding = 1) uniform samplerBuffer gaussNodes;
layout(set = 0, binding = 2) uniform samplerBuffer nearLights;
layout(set = 0, binding = 3) uniform sampler3D lattice;
layout(set = 0, binding = 4, std140) uniform Object { GpuRig rig; };
layout(set = 0, binding = 5, std140) uniform Material { GpuWrap wrap; };
// 6 and 7 are of points.comp.
layout(set = 0, binding = 8) uniform samplerBuffer diskTable;

#include "rigel/high_band.glsl"
#include "rigel/irradiance.glsl"
#include "rigel/near_light.glsl"
#include "rigel/rig.glsl"
#include "rigel/rig_texture.glsl"

GpuWrap materialWrap() {
  GpuWrap own = wrap;
  // Lambert is known: its bands fold away.
  if (!material_wrap && !light_near_wrap) {
    own.f = vec4(1.0, 2.0 / 3.0, 0.25, 0.0);
    own.f4 = -1.0 / 24.0;
    own.a = 0.0;
    own.inverse = 1.0;
    own.gain = 1.0;
    own.blurBand = vec4(0.0);
    own.blurBand4 = 0.0;
    own.blur = 0.0;
  }
  return own;
}

vec3 rigIrradiance(vec3 p, vec3 n, GpuWrap own) {
  float y[RIGEL_SH_COUNT];
  rigel_wrapBasis(n, own, y);
#ifndef RIGEL_WITHOUT_texture
  if (rig_texture) return rigel_textureIrradiance(lattice, rig, p, y);
#endif
  return rigel_rigIrradiance(coefficients, rig, p, y);
}

#ifndef RIGEL_WITHOUT_near
GpuNearLight nearLightAt(int i) {
  vec4 a = texelFetch(nearLights, 4 * i);
  vec4 b = texelFetch(nearLights, 4 * i + 1);
  vec4 c = texelFetch(nearLights, 4 * i + 2);
  vec4 d = texelFetch(nearLights, 4 * i + 3);
  return GpuNearLight(a.xyz, a.w, b.xyz, int(b.w), c.xyz, c.w, d.x, d.y, d.z, d.w);
}
#endif

/// Irradiance [W/m2] at `p` (world) with unit normal `n` from rig and high band, not clamped.
vec3 rigPart(vec3 p, vec3 n, GpuWrap own) {
  vec3 e = vec3(0.0);
  if (rig_constant || rig_poly || rig_invquad || rig_tensor || rig_texture) e = rigIrradiance(p, n, own);
#ifndef RIGEL_WITHOUT_highBand
  if (rig_highBand) e += rigel_highBandIrradiance(coefficients, rig, n, own);
#endif
  return e;
}

/// And from near lights [first, first + count).
vec3 nearPart(vec3 p, vec3 n, GpuWrap own, int first, int count) {
  vec3 e = vec3(0.0);
#ifndef RIGEL_WITHOUT_near
  if (light_near_directional || light_near_point || light_near_spot || light_near_sphere ||
      light_near_disk) {
    for (int i = first; i < first + count; ++i) e += rigel_nearIrradiance(nearLightAt(i), p, n, own);
  }
#endif
  return e;
}

vec3 shadeObject(vec3 p, vec3 n, int first, int count) {
  GpuWrap own = materialWrap();
  return rigel_clampIrradiance(rigPart(p, n, own)) + nearPart(p, n, own, first, count);
}

#endif
