// The points that object.frag shades, for those who want to shade the same ones.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) flat in vec3 baseColour;  // layers complain of outputs that nobody takes
layout(location = 3) flat in uint triangleNumber;

layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;
layout(location = 2) out uvec2 surface;

void main() {
  position = vec4(worldPosition, 1.0);
  normal = vec4(worldNormal * inversesqrt(max(dot(worldNormal, worldNormal), 1e-24)), 0.0);
  surface = uvec2(part, triangleNumber);
}
