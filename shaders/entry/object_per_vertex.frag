// An object whose vertices are shaded.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "rigel/shader_constants.h"

layout(location = 0) in vec3 vertexIrradiance;
layout(location = 2) flat in vec3 baseColour;
layout(location = 3) flat in uint triangleNumber;

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 irradiance;
layout(location = 2) out uvec2 surface;

void main() {
  irradiance = vec4(vertexIrradiance, 1.0);
  radiance = vec4(baseColour * vertexIrradiance * (radianceScale / float(kRigelPi)), 1.0);
  surface = uvec2(part, triangleNumber);
}
