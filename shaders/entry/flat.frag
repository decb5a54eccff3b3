// The base colour as it is: lights in the picture, and the frame that shading times are measured against.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

layout(location = 2) flat in vec3 baseColour;
layout(location = 3) flat in uint triangleNumber;

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 irradiance;
layout(location = 2) out uvec2 surface;

void main() {
  radiance = vec4(baseColour * radianceScale, 1.0);
  irradiance = vec4(0.0);
  surface = uvec2(part, triangleNumber);
}
