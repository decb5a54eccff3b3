// Near disk lights: what near_light.glsl multiplies a disk's colour by. Errors as in near_light.h. RIGEL_HAS_NEAR_WRAP as
// there; where a disk's bands come from: disk.glsl.
#ifndef RIGEL_NEAR_DISK_GLSL
#define RIGEL_NEAR_DISK_GLSL

#include "rigel/disk.glsl"
#include "rigel/shader_disk_irradiance.h"
#include "rigel/shader_disk_near.h"

#ifndef RIGEL_HAS_NEAR_WRAP
#define RIGEL_HAS_NEAR_WRAP true
#endif

/// A unit vector in the frame of the view.
vec3 rigel_inDiskFrame(RigelDiskView view, vec3 n) {
  return vec3(dot(n, vec3(view.xx, view.xy, view.xz)), dot(n, vec3(view.yx, view.yy, view.yz)),
              dot(n, vec3(view.zx, view.zy, view.zz)));
}

/// 0 where the normal is none; `e` is what it would be else.
float rigel_diskFactor(RigelDiskView view, vec3 normalInFrame, float e) {
  return rigel_isNumber(normalInFrame.x + normalInFrame.y + normalInFrame.z) ? view.flux * e : 0.0f;
}

float rigel_nearDisk(GpuNearLight light, vec3 p, vec3 n, GpuWrap wrap) {
  RigelDiskView view = rigel_viewDisk(light, p);
  vec3 m = rigel_inDiskFrame(view, n);
  float e;
  if (RIGEL_HAS_NEAR_WRAP && (RIGEL_DISK_BY_TABLE || RIGEL_DISK_BY_QUADRATURE) && wrap.a != 0.0f) {
    e = rigel_diskWrapped(rigel_diskMoments(view.cone), view.cone, m.x, m.y, m.z, wrap);
  } else {
    e = wrap.gain * rigel_diskLambertBranched(view.cone, m.x, m.y, m.z);
  }
  return rigel_diskFactor(view, m, e);
}

float rigel_cheapDisk(GpuNearLight light, vec3 p, vec3 n) {
  RigelDiskView view = rigel_viewDisk(light, p);
  vec3 m = rigel_inDiskFrame(view, n);
  return rigel_diskFactor(view, m, rigel_diskLambertCheap(view.cone, m.x, m.y, m.z));
}

float rigel_correctorDisk(GpuNearLight light, vec3 p, vec3 n, GpuWrap wrap) {
  RigelDiskView view = rigel_viewDisk(light, p);
  vec3 m = rigel_inDiskFrame(view, n);
  return rigel_diskFactor(view, m, rigel_diskAboveBand2(view.cone, m.x, m.y, m.z, wrap));
}

#endif
