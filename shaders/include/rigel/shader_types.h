// The structures that C++ fills and shaders read: the same bytes under std140 and std430, in multiples of 16. Parsed by
// both languages.
#ifndef RIGEL_SHADER_TYPES_H
#define RIGEL_SHADER_TYPES_H

#ifdef __cplusplus
#include <cstddef>

namespace rigel {
namespace shader_types {
struct vec3 {
  float x = 0, y = 0, z = 0;
};
struct vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};
struct ivec3 {
  int x = 0, y = 0, z = 0;
};
struct ivec4 {
  int x = 0, y = 0, z = 0, w = 0;
};
#endif

/// GpuNearLight::kind, as NearLight::Kind.
const int kGpuDirectional = 0;
const int kGpuPoint = 1;
const int kGpuSpot = 2;
const int kGpuSphere = 3;
const int kGpuDisk = 4;

/// A light evaluated exactly at every point, made by gpuNearLight (near_light.h). Where s = r/d, its irradiance is
/// colour (extent / max(d, r))^2 times a function of s and the normal.
struct GpuNearLight {
  vec3 position;  // m, world; directional: unit vector towards the light
  float radius;   // m
  vec3 colour;    // of the light's own struct, times its share; sphere, disk: times pi
  int kind;
  vec3 axis;               // spot, disk: unit, the way the light travels; else 0
  float inverseRange;      // 1/m; 0: no window
  float cosOuter;          // disk: 0 where it is one-sided; else, spots apart, -1
  float inverseConeWidth;  // 1 / (cosInner - cosOuter); not a spot: 1, so that the cone is 1 everywhere
  float extent;            // m; sphere, disk: the radius; else 1
  float unused;
};

/// A material's wrap, made by gpuWrap (wrap.h).
struct GpuWrap {
  vec4 f;           // f_0 to f_3, times gain
  float f4;         // f_4, times gain
  float a;          // within [-0.25, 1]; 0: Lambert
  float inverse;    // 1 / (1 + a)
  float gain;       // of the kernel; 1 as published
  vec4 blurBand;    // what the blurred horizon adds to f_0 to f_3, per s^2; times gain
  float blurBand4;  // to f_4
  float blur;       // half width of the blurred horizon in (x+a)/(1+a), per s
  float unused0;
  float unused1;
};

/// GpuRig::kind.
const int kGpuRigConstant = 0;
const int kGpuRigPoly = 1;     // poly and auto
const int kGpuRigInvquad = 2;  // poly over a falloff
const int kGpuRigTensor = 3;   // gradient, lattice, mixed
const int kGpuRigGauss = 4;    // these @gauss
const int kGpuRigTexture = 5;  // lattice in a 3-D texture (rig_texture.glsl)

/// GpuRig::kernel, as LatticeKernel.
const int kGpuLinear = 0;
const int kGpuSmooth = 1;
const int kGpuCubic = 2;

/// A rig in a frame, made by packRig (gpu_rig.h); its coefficients are in a buffer of vec4 that rigs share.
struct GpuRig {
  vec3 centre;      // m, world: of the box, rounded; the axes' w make up for it
  int offset;       // vec4 where its SH vectors begin
  vec4 axisX;       // box coordinate u.x = dot(axisX.xyz, p - centre) + axisX.w; all 0 along an axis without extent
  vec4 axisY;
  vec4 axisZ;
  int kind;
  int vectors;      // K of the frame
  float scale;      // what is stored times this is pi times radiance SH
  int highBand;     // 3 or 4: one band beyond the rig's; 0: none
  ivec3 nodes;      // tensor rigs: along the axes, 1 where there is no lattice
  int kernel;
  ivec3 slope;      // tensor rigs: which of a node's vectors is the slope along the axis, 1 to 3, or 0: none
  int perNode;      // vectors a node: 1 + slopes
  int highOffset;   // vec4 where the high band begins
  int gaussOffset;  // vec4 where the nodes of @gauss begin
  int unused0;
  int unused1;
  vec4 falloff[3];  // invquad: of uu, vv, ww, uv | uw, vw, u, v | w, 1, and two unused
  ivec4 terms[4];   // poly: monomial k is monomial `from` times coordinate `axis`, from * 4 + axis in byte k % 4 of int
                    // k / 4
};

#ifdef __cplusplus
static_assert(sizeof(GpuNearLight) == 64);
static_assert(offsetof(GpuNearLight, position) == 0 && offsetof(GpuNearLight, radius) == 12);
static_assert(offsetof(GpuNearLight, colour) == 16 && offsetof(GpuNearLight, kind) == 28);
static_assert(offsetof(GpuNearLight, axis) == 32 && offsetof(GpuNearLight, inverseRange) == 44);
static_assert(offsetof(GpuNearLight, cosOuter) == 48 && offsetof(GpuNearLight, inverseConeWidth) == 52);
static_assert(offsetof(GpuNearLight, extent) == 56 && offsetof(GpuNearLight, unused) == 60);
static_assert(sizeof(GpuWrap) == 64);
static_assert(offsetof(GpuWrap, f) == 0 && offsetof(GpuWrap, f4) == 16 && offsetof(GpuWrap, a) == 20);
static_assert(offsetof(GpuWrap, inverse) == 24 && offsetof(GpuWrap, gain) == 28 && offsetof(GpuWrap, blurBand) == 32);
static_assert(offsetof(GpuWrap, blurBand4) == 48 && offsetof(GpuWrap, blur) == 52 && offsetof(GpuWrap, unused0) == 56);
static_assert(offsetof(GpuWrap, unused1) == 60);
static_assert(sizeof(GpuRig) == 240);
static_assert(offsetof(GpuRig, centre) == 0 && offsetof(GpuRig, offset) == 12 && offsetof(GpuRig, axisX) == 16);
static_assert(offsetof(GpuRig, axisY) == 32 && offsetof(GpuRig, axisZ) == 48 && offsetof(GpuRig, kind) == 64);
static_assert(offsetof(GpuRig, vectors) == 68 && offsetof(GpuRig, scale) == 72 && offsetof(GpuRig, highBand) == 76);
static_assert(offsetof(GpuRig, nodes) == 80 && offsetof(GpuRig, kernel) == 92 && offsetof(GpuRig, slope) == 96);
static_assert(offsetof(GpuRig, perNode) == 108 && offsetof(GpuRig, highOffset) == 112);
static_assert(offsetof(GpuRig, gaussOffset) == 116 && offsetof(GpuRig, unused0) == 120);
static_assert(offsetof(GpuRig, unused1) == 124 && offsetof(GpuRig, falloff) == 128 && offsetof(GpuRig, terms) == 176);
}  // namespace shader_types
using shader_types::GpuNearLight;
using shader_types::GpuRig;
using shader_types::GpuWrap;
}  // namespace rigel
#endif

#endif
