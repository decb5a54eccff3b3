// Points with normals, shaded one by one: what reports measure, and what benchmarks time.
#version 450
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;

layout(push_constant) uniform Draw {
  int pointCount;
  int firstPoint;
  int firstNear;
  int nearCount;
};

#include "shade_object.glsl"

// Position and normal, a vec4 each; the rig's part of irradiance, not clamped, and that of near lights likewise.
layout(set = 0, binding = 6) uniform samplerBuffer points;
layout(set = 0, binding = 7, std430) writeonly buffer Results { vec4 irradiance[]; };

void main() {
  // No early return: lavapipe reads buffers ten times slower behind one.
  int i = firstPoint + min(int(gl_GlobalInvocationID.x), pointCount - 1);
  vec3 p = texelFetch(points, 2 * i).xyz;
  vec3 n = texelFetch(points, 2 * i + 1).xyz;
  GpuWrap own = materialWrap();
  irradiance[2 * i] = vec4(rigPart(p, n, own), 0.0);
  irradiance[2 * i + 1] = vec4(nearPart(p, n, own, firstNear, nearCount), 0.0);
}
