// An object shaded per vertex: cheaper where triangles are smaller than the light's detail.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "shade_object.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
layout(location = 3) in uint triangle;

layout(location = 0) out vec3 vertexIrradiance;
layout(location = 2) flat out vec3 baseColour;
layout(location = 3) flat out uint triangleNumber;

void main() {
  vertexIrradiance = shadeObject(position, normal, firstNear, nearCount);
  baseColour = colour;
  triangleNumber = triangle;
  gl_Position = clipFromWorld(position);
}
