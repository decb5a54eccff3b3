// An object shaded per pixel.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "shade_object.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) flat in vec3 baseColour;
layout(location = 3) flat in uint triangleNumber;

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 irradiance;
layout(location = 2) out uvec2 surface;

void main() {
  vec3 n = worldNormal * inversesqrt(max(dot(worldNormal, worldNormal), 1e-24));
  vec3 e = shadeObject(worldPosition, n, firstNear, nearCount);
  irradiance = vec4(e, 1.0);
  radiance = vec4(baseColour * e * (radianceScale / float(kRigelPi)), 1.0);
  surface = uvec2(part, triangleNumber);
}
