// The one light that stands for all others in a specular term (dominant_light.h).
#ifndef RIGEL_DOMINANT_LIGHT_GLSL
#define RIGEL_DOMINANT_LIGHT_GLSL

#include "rigel/float_pair.glsl"
#include "rigel/sh.glsl"
#include "rigel/shader_constants.h"

struct RigelDominantLight {
  vec3 direction;   // unit, towards the light
  vec3 irradiance;  // [W/m2] at normal incidence
};

/// From pi times the linear band of radiance SH, coefficients 1, 2 and 3 of any number of bands.
RigelDominantLight rigel_dominantLight(vec3 c1, vec3 c2, vec3 c3) {
  const vec3 luminance = vec3(kRigelLuminanceR, kRigelLuminanceG, kRigelLuminanceB);
  vec3 v = vec3(dot(luminance, c3), dot(luminance, c1), dot(luminance, c2));
  vec3 size = abs(v);
  float unit = rigel_inverseExponent(max(size.x, max(size.y, size.z)));
  v *= unit;
  float squared = dot(v, v);

  RigelDominantLight light;
  light.direction = vec3(0.0f, 1.0f, 0.0f);
  light.irradiance = vec3(0.0f);
  // Also false for NaN.
  if (squared > 0.0f && squared < 16.0f) {
    float inverse = 1.0f / sqrt(squared);
    light.direction = v * inverse;
    vec3 along = max(c3 * light.direction.x + c1 * light.direction.y + c2 * light.direction.z, vec3(0.0f));
    // sqrt(4 pi / 3) / pi, and what the colours that were held at 0 would have taken away.
    float held = dot(luminance, along) * unit;
    float share = squared * inverse / held;
    light.irradiance = along * (share * (1.0f / (kRigelY1 * kRigelPi)));
  }
  return light;
}

/// From pi times radiance SH, a rig's at a point (rigel_rigSh) for one; only its linear band is computed.
RigelDominantLight rigel_dominantLight(vec3 c[RIGEL_SH_COUNT]) { return rigel_dominantLight(c[1], c[2], c[3]); }

#endif
