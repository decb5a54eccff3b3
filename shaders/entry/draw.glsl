// What a draw hands its shaders, vertex and fragment alike: 96 bytes of push constants.
#ifndef RIGEL_ENTRY_DRAW_GLSL
#define RIGEL_ENTRY_DRAW_GLSL

layout(push_constant) uniform Draw {
  // The camera looks along -back; depth is 0 at the near plane and 1 at infinity.
  vec4 right;  // times the focal length in x
  vec4 up;     // times that in y
  vec4 back;
  vec3 eye;
  float nearPlane;
  uint part;            // RenderedFrame::part
  float radianceScale;  // of what leaves the surface: scenery is shown dimmed
  int firstNear;        // in the buffer of near lights
  int nearCount;
};

vec4 clipFromWorld(vec3 position) {
  vec3 v = position - eye;
  float distance = -dot(back.xyz, v);
  return vec4(dot(right.xyz, v), dot(up.xyz, v), distance - nearPlane, distance);
}

#endif
