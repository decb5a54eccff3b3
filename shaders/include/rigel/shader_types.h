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
struct ivec4 {
  int x = 0, y = 0, z = 0, w = 0;
};
#endif

/// GpuNearLight::kind, as NearLight::Kind.
const int kGpuDirectional = 0;
const int kGpuPoint = 1;
const int kGpuSpot = 2;
const int kGpuSphere = 3;

/// A light evaluated exactly at every point (near_light.h).
struct GpuNearLight {
  vec3 position;  // m, world; directional: unit vector towards the light
  float radius;   // m
  vec3 colour;    // of the light's own struct, times its share
  int kind;
  vec3 axis;    // spot: unit, the way the light travels
  float range;  // m; infinity: no window
  float cosOuter;
  float inverseConeWidth;  // 1 / (cosInner - cosOuter)
  float unused0;
  float unused1;
};

#ifdef __cplusplus
static_assert(sizeof(GpuNearLight) == 64);
static_assert(offsetof(GpuNearLight, radius) == 12 && offsetof(GpuNearLight, colour) == 16);
static_assert(offsetof(GpuNearLight, kind) == 28 && offsetof(GpuNearLight, axis) == 32);
static_assert(offsetof(GpuNearLight, range) == 44 && offsetof(GpuNearLight, cosOuter) == 48);
}  // namespace shader_types
using shader_types::GpuNearLight;
}  // namespace rigel
#endif

#endif
