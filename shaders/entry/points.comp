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

// Position and normal, a vec4 each.
layout(set = 0, binding = 6) uniform samplerBuffer points;
layout(set = 0, binding = 7, std430) writeonly buffer Results { vec4 irradiance[]; };

void main() {
  // No early return: lavapipe reads buffers ten times slower behind one.
  int i = firstPoint + min(int(gl_GlobalInvocationID.x), pointCount - 1);
  vec3 p = texelFetch(points, 2 * i).xyz;
  vec3 n = texelFetch(points, 2 * i + 1).xyz;
  irradiance[i] = vec4(shadeObject(p, n, firstNear, nearCount), 1.0);
}
