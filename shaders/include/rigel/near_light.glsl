// Lights evaluated one by one at every point shaded (near_light.h), from GpuNearLight as gpuNearLight made it.
//
// A scene that lacks a kind of near light leaves its code out: RIGEL_HAS_NEAR(kind) says whether it may occur, and
// RIGEL_HAS_NEAR_WRAP whether any material wraps; constants or specialisation constants in an entry shader.
#ifndef RIGEL_NEAR_LIGHT_GLSL
#define RIGEL_NEAR_LIGHT_GLSL

#include "rigel/float_pair.glsl"
#include "rigel/near_disk.glsl"
#include "rigel/shader_near_cap.h"

#ifndef RIGEL_HAS_NEAR
#define RIGEL_HAS_NEAR(kind) true
#endif
#ifndef RIGEL_HAS_NEAR_WRAP
#define RIGEL_HAS_NEAR_WRAP true
#endif

/// A light as one receiver sees it: outside s = r/d, inside s = d/r, c = sqrt(1-s^2), x = n.w; the irradiance is `scale`
/// times the light's colour times a function of x, s and c.
struct RigelNearView {
  float x;
  float s;
  float c;
  float scale;
  bool inside;
};

/// clamp(1-(d/R)^4, 0, 1)^2.
float rigel_rangeWindow(float distanceOverRange) {
  float square = distanceOverRange * distanceOverRange;
  float u = max(0.0f, 1.0f - square * square);
  return u * u;
}

/// Smoothstep of the cosine between the spot's axis and the direction from it. 1 for lights that are no spots.
float rigel_spotCone(GpuNearLight light, float cosine) {
  float t = clamp((cosine - light.cosOuter) * light.inverseConeWidth, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

RigelNearView rigel_viewLocal(GpuNearLight light, vec3 p, vec3 n) {
  // In units of a power of two near the larger of distance and radius: the squares of 1e-15 and of 1e15 fit no float.
  vec3 toCentre = light.position - p;
  vec3 apart = abs(toCentre);
  float unit = rigel_inverseExponent(max(max(apart.x, apart.y), max(apart.z, light.radius)));
  toCentre *= unit;
  float radius = light.radius * unit;
  float d2 = dot(toCentre, toCentre);
  float r2 = radius * radius;
  float gap = d2 - r2;
  // How far a light that all but touches reaches beyond the horizon hangs on all digits of this difference: plain
  // float is 3e-4 of the peak off there. Few points are so close.
  if (abs(gap) < 0.25f * r2) gap = rigel_squaredGap(light.position, p, light.radius, unit);

  RigelNearView view;
  float d = sqrt(d2);
  view.inside = gap < 0.0f;
  float inverse = 1.0f / (view.inside ? radius : d);
  view.s = (view.inside ? d : radius) * inverse;
  view.c = sqrt(abs(gap)) * inverse;
  vec3 w = toCentre * (view.inside ? 1.0f / max(d, 1e-30f) : inverse);
  float x = dot(n, w);
  view.x = clamp(x, -1.0f, 1.0f);

  float perMetre = inverse * unit;
  float share = light.extent * perMetre;
  bool valid = perMetre >= 1.0f / kRigelMaxReach && perMetre <= 1.0f / kRigelMinReach;
  view.scale = valid && rigel_isNumber(x) ? share * share : 0.0f;
  if (RIGEL_HAS_NEAR(kGpuPoint) || RIGEL_HAS_NEAR(kGpuSpot)) {
    view.scale *= rigel_rangeWindow(d / unit * light.inverseRange);
  }
  if (RIGEL_HAS_NEAR(kGpuSpot)) {
    view.scale *= rigel_spotCone(light, -dot(w, light.axis) * (view.inside ? view.s : 1.0f));
  }
  return view;
}

/// A directional light is a sphere of no size.
RigelNearView rigel_viewDirectional(GpuNearLight light, vec3 n) {
  float x = dot(n, light.position);
  return RigelNearView(clamp(x, -1.0f, 1.0f), 0.0f, 1.0f, rigel_isNumber(x) ? 1.0f : 0.0f, false);
}

/// Any light but a disk.
RigelNearView rigel_viewNear(GpuNearLight light, vec3 p, vec3 n) {
  bool local = RIGEL_HAS_NEAR(kGpuPoint) || RIGEL_HAS_NEAR(kGpuSpot) || RIGEL_HAS_NEAR(kGpuSphere);
  if (RIGEL_HAS_NEAR(kGpuDirectional) && (!local || light.kind == kGpuDirectional)) {
    return rigel_viewDirectional(light, n);
  }
  return rigel_viewLocal(light, p, n);
}

/// Finite whatever the factor; a factor of NaN gives 0.
vec3 rigel_scaledColour(GpuNearLight light, float factor) {
  vec3 e = clamp(light.colour * factor, -kRigelMaxScale, kRigelMaxScale);
  return abs(factor) > 0.0f ? e : vec3(0.0f);
}

bool rigel_isDisk(GpuNearLight light) {
  bool others = RIGEL_HAS_NEAR(kGpuDirectional) || RIGEL_HAS_NEAR(kGpuPoint) || RIGEL_HAS_NEAR(kGpuSpot) ||
                RIGEL_HAS_NEAR(kGpuSphere);
  return RIGEL_HAS_NEAR(kGpuDisk) && (!others || light.kind == kGpuDisk);
}

/// share * wrap.gain * irradiance [W/m2] at `p` with unit normal `n`: horizon clipped, window and cone at p, and inside
/// a sphere the continuous extension. Errors as in near_light.h.
vec3 rigel_nearIrradiance(GpuNearLight light, vec3 p, vec3 n, GpuWrap wrap) {
  if (rigel_isDisk(light)) return rigel_scaledColour(light, rigel_nearDisk(light, p, n, wrap));
  RigelNearView view = rigel_viewNear(light, p, n);
  // Inside: the whole sphere less a cap on the other side.
  float x = view.inside ? -view.x : view.x;
  float e;
  float whole;
  if (RIGEL_HAS_NEAR_WRAP && wrap.a != 0.0f) {
    e = rigel_wrapCap(x, view.s, view.c, wrap);
    whole = wrap.f.x;
  } else {
    e = wrap.gain * rigel_lambertCap(x, view.s, view.c);
    whole = wrap.gain;
  }
  if (view.inside) e = whole - view.s * view.s * e;
  return rigel_scaledColour(light, view.scale * e);
}

/// Lambert without inverse function: within 0.5 % of the peak for r/d <= 0.7, 1.3 % at any distance; disks as in
/// near_light.h.
vec3 rigel_cheapIrradiance(GpuNearLight light, vec3 p, vec3 n) {
  if (rigel_isDisk(light)) return rigel_scaledColour(light, rigel_cheapDisk(light, p, n));
  RigelNearView view = rigel_viewNear(light, p, n);
  float e = rigel_lambertCapCheap(view.inside ? -view.x : view.x, max(view.s, 1e-6f), view.c);
  if (view.inside) e = 1.0f - view.s * view.s * e;
  return rigel_scaledColour(light, view.scale * e);
}

/// What 3-band SH leave out of the light: to be added where the light itself is in a rig. May be negative.
vec3 rigel_correctorIrradiance(GpuNearLight light, vec3 p, vec3 n, GpuWrap wrap) {
  if (rigel_isDisk(light)) return rigel_scaledColour(light, rigel_correctorDisk(light, p, n, wrap));
  RigelNearView view = rigel_viewNear(light, p, n);
  float share = view.inside ? 0.0f : rigel_highBandShare(view.s * view.s);
  return rigel_scaledColour(light, view.scale * share * rigel_kernelAboveBand2(view.x, wrap));
}

#endif
