// The one constant band beyond a rig's own (HighBand of object_lighting.h): band 4 for Lambert, band 3 for wrap.
//   RIGEL_HIGH_BAND(rig)    3, 4 or 0: none
//   RIGEL_HIGH_OFFSET(rig)  vec4 where it begins
// come from the rig, or from what an entry shader defines instead.
#ifndef RIGEL_HIGH_BAND_GLSL
#define RIGEL_HIGH_BAND_GLSL

#include "rigel/rig_source.glsl"
#include "rigel/shader_constants.h"
#include "rigel/shader_types.h"

#ifndef RIGEL_HIGH_BAND
#define RIGEL_HIGH_BAND(rig) rig.highBand
#endif
#ifndef RIGEL_HIGH_OFFSET
#define RIGEL_HIGH_OFFSET(rig) rig.highOffset
#endif
#ifndef RIGEL_SCALE
#define RIGEL_SCALE(rig) rig.scale
#endif

/// Y_3m(w), m = -3 to 3, of the unit vector `w`; polynomials as in sh.glsl.
void rigel_shBand3(vec3 w, out float y[7]) {
  float xy2 = 2.0 * w.x * w.y;
  float xxyy = (w.x - w.y) * (w.x + w.y);
  float zz = w.z * w.z;
  float tt = w.x * w.x + w.y * w.y;
  float f31 = kRigelY31 * (4.0 * zz - tt);
  y[0] = kRigelY33 * (w.x * xy2 + w.y * xxyy);
  y[1] = kRigelY32 * w.z * xy2;
  y[2] = f31 * w.y;
  y[3] = kRigelY30 * w.z * (2.0 * zz - 3.0 * tt);
  y[4] = f31 * w.x;
  y[5] = kRigelY32 * w.z * xxyy;
  y[6] = kRigelY33 * (w.x * xxyy - w.y * xy2);
}

/// Y_4m(w), m = -4 to 4.
void rigel_shBand4(vec3 w, out float y[9]) {
  float xy2 = 2.0 * w.x * w.y;
  float xxyy = (w.x - w.y) * (w.x + w.y);
  float zz = w.z * w.z;
  float tt = w.x * w.x + w.y * w.y;
  float f41 = kRigelY41 * w.z * (4.0 * zz - 3.0 * tt);
  float f42 = kRigelY42 * (6.0 * zz - tt);
  float f43 = kRigelY43 * w.z;
  y[0] = 2.0 * kRigelY44 * xy2 * xxyy;
  y[1] = f43 * (w.x * xy2 + w.y * xxyy);
  y[2] = f42 * xy2;
  y[3] = f41 * w.y;
  y[4] = kRigelY40 * (8.0 * zz * (zz - 3.0 * tt) + 3.0 * tt * tt);
  y[5] = f41 * w.x;
  y[6] = f42 * xxyy;
  y[7] = f43 * (w.x * xxyy - w.y * xy2);
  y[8] = kRigelY44 * (xxyy - xy2) * (xxyy + xy2);
}

/// What the band adds to irradiance [W/m2] on normal `n`; 0 without one.
vec3 rigel_highBandIrradiance(RIGEL_SOURCE source, GpuRig rig, vec3 n, GpuWrap wrap) {
  int at = RIGEL_HIGH_OFFSET(rig);
  vec4 a, b, c;
  vec3 sum = vec3(0.0);
  float f = 0.0;
  if (RIGEL_HIGH_BAND(rig) == 3) {
    float y[7];
    rigel_shBand3(n, y);
    f = wrap.f.w;
    RIGEL_QUAD_DOT(0)
    a = RIGEL_FETCH(source, at + 3);
    b = RIGEL_FETCH(source, at + 4);
    c = RIGEL_FETCH(source, at + 5);
    sum = RIGEL_FMA(a.xyz, vec3(y[4]), sum);
    sum = RIGEL_FMA(vec3(a.w, b.xy), vec3(y[5]), sum);
    sum = RIGEL_FMA(vec3(b.zw, c.x), vec3(y[6]), sum);
  } else if (RIGEL_HIGH_BAND(rig) == 4) {
    float y[9];
    rigel_shBand4(n, y);
    f = wrap.f4;
    RIGEL_QUAD_DOT(0)
    RIGEL_QUAD_DOT(1)
    sum = RIGEL_FMA(RIGEL_FETCH(source, at + 6).xyz, vec3(y[8]), sum);
  }
  return sum * (f * RIGEL_SCALE(rig));
}

#endif
