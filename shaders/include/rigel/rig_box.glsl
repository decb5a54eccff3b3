// Points in the coordinates of a rig's box.
#ifndef RIGEL_RIG_BOX_GLSL
#define RIGEL_RIG_BOX_GLSL

#include "rigel/shader_types.h"

/// u in [-1, 1] inside the box, 0 along an axis without extent and for a coordinate that is not a number. `p` in the
/// world; nothing is lost far from the origin: p - centre is exact near the box, and what the centre was rounded by is
/// in the axes' w.
vec3 rigel_boxCoordinates(GpuRig rig, vec3 p) {
  vec3 d = p - rig.centre;
  vec3 u = vec3(dot(rig.axisX.xyz, d), dot(rig.axisY.xyz, d), dot(rig.axisZ.xyz, d));
  u += vec3(rig.axisX.w, rig.axisY.w, rig.axisZ.w);
  return mix(u, vec3(0.0), isnan(u));
}

#endif
