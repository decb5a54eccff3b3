// A posed object without its shape: for flat.frag.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

layout(location = 0) in vec3 position;
layout(location = 2) in vec3 colour;
layout(location = 3) in uint triangle;

layout(location = 2) flat out vec3 baseColour;
layout(location = 3) flat out uint triangleNumber;

void main() {
  baseColour = colour;
  triangleNumber = triangle;
  gl_Position = clipFromWorld(position);
}
