// Disk lights (light.h): how a receiver sees one, and its SH in the world, from GpuNearLight as gpuNearLight made it. The
// mathematics is in shader_disk*.h, one text with C++; the vectors are here.
//
// What is left of a disk's shape, its moments, comes from RIGEL_DISK_NODES nodes of a quadrature, 4, 6 or 8 (errors in
// shader_disk.h), or from the two textures of DiskTable (disk_table.h), which an entry shader hands over as one of
//   RIGEL_DISK_TABLE(texture, uv)    vec4 from a sampler that filters linearly and clamps to the edge
//   RIGEL_DISK_TEXEL(texture, x, y)  single texels, interpolated here
// where `texture` is the literal 0 or 1. With one of them moments come from the table, without from the quadrature, unless
// RIGEL_DISK_BY_TABLE and RIGEL_DISK_BY_QUADRATURE, constants or specialisation constants, say which of the two may occur.
#ifndef RIGEL_DISK_GLSL
#define RIGEL_DISK_GLSL

#include "rigel/float_pair.glsl"
#include "rigel/sh.glsl"
#include "rigel/shader_disk.h"
#include "rigel/shader_disk_table.h"
#include "rigel/shader_disk_view.h"
#include "rigel/shader_types.h"

#ifndef RIGEL_DISK_NODES
#define RIGEL_DISK_NODES 6
#endif
#ifndef RIGEL_DISK_TABLE_SIZE
#define RIGEL_DISK_TABLE_SIZE 32
#endif

/// `light` is a disk. Its radiance SH are colour * flux times those of its moments, its irradiance on a normal that sees
/// all of it colour * flux * n.Z. No flux where `p` is NaN or infinite.
RigelDiskView rigel_viewDisk(GpuNearLight light, vec3 p) {
  vec3 toCentre = light.position - p;
  vec3 apart = abs(toCentre);
  float unit = rigel_inverseExponent(max(max(apart.x, apart.y), max(apart.z, light.radius)));
  vec3 v = toCentre * unit;
  float radius = light.radius * unit;
  float d2 = dot(v, v);

  // Beyond kRigelDiskReach radii a larger and dimmer disk does.
  float drawn = max(max(radius, sqrt(d2) * float(1.0 / kRigelDiskReach)), 1e-30f);
  float perRadius = 1.0f / drawn;
  float along = dot(v, light.axis);
  float r2 = radius * radius;
  float gap = d2 - drawn * drawn;
  // Just above the plane the height is a small difference of large products, and near the rim so is the gap.
  if (along * along < 0.04f * d2) {
    along = rigel_differenceDot(light.position, p, light.axis, unit);
    if (abs(d2 - r2) < 0.25f * r2) gap = rigel_squaredGap(light.position, p, light.radius, unit);
  }
  RigelDiskPlace place = rigel_diskPlace(v.x * perRadius, v.y * perRadius, v.z * perRadius, light.axis.x, light.axis.y,
                                         light.axis.z, along * perRadius, light.cosOuter);
  RigelDiskView view = rigel_diskView(place, gap * perRadius * perRadius);
  float share = radius / drawn;
  view.flux = rigel_isNumber(d2) ? view.flux * (share * share) : 0.0f;
  return view;
}

/// SH of unit vector irradiance in the view's frame.
RigelDiskMoments rigel_diskMomentsByQuadrature(RigelDiskCone cone) {
#if RIGEL_DISK_NODES == 4
  return rigel_diskMoments4(cone);
#elif RIGEL_DISK_NODES == 6
  return rigel_diskMoments6(cone);
#elif RIGEL_DISK_NODES == 8
  return rigel_diskMoments8(cone);
#else
#error "RIGEL_DISK_NODES: 4, 6 or 8"
#endif
}

#if defined(RIGEL_DISK_TABLE) || defined(RIGEL_DISK_TEXEL)
#ifndef RIGEL_DISK_BY_TABLE
#define RIGEL_DISK_BY_TABLE true
#endif

#ifndef RIGEL_DISK_TABLE
vec4 rigel_diskBilinear(vec4 a, vec4 b, vec4 c, vec4 d, vec2 part) {
  vec4 low = a + (b - a) * part.x;
  vec4 high = c + (d - c) * part.x;
  return low + (high - low) * part.y;
}
#define RIGEL_DISK_TABLE(texture, uv)                                                                \
  rigel_diskBilinear(RIGEL_DISK_TEXEL(texture, cell.x, cell.y),                                      \
                     RIGEL_DISK_TEXEL(texture, cell.x + 1, cell.y),                                  \
                     RIGEL_DISK_TEXEL(texture, cell.x, cell.y + 1),                                  \
                     RIGEL_DISK_TEXEL(texture, cell.x + 1, cell.y + 1), part)
#endif

/// The same from the table.
RigelDiskMoments rigel_diskMomentsByTable(RigelDiskCone cone) {
  vec2 at = vec2(rigel_diskTableU(cone), rigel_diskTableV(cone)) * float(RIGEL_DISK_TABLE_SIZE - 1);
  vec2 uv = (at + 0.5f) / float(RIGEL_DISK_TABLE_SIZE);
  ivec2 cell = clamp(ivec2(at), 0, RIGEL_DISK_TABLE_SIZE - 2);
  vec2 part = at - vec2(cell);
  RigelDiskMoments q = rigel_diskMomentsAtOneNode(cone);
  vec4 low = RIGEL_DISK_TABLE(0, uv);
  q.q00 += low.x;
  q.q20 += low.y;
  q.q22 += low.z;
  q.q40 += low.w;
  vec4 high = RIGEL_DISK_TABLE(1, uv);
  q.q42 += high.x;
  q.q44 += high.y;
  return q;
}
#else
#ifndef RIGEL_DISK_BY_TABLE
#define RIGEL_DISK_BY_TABLE false
#endif
#define rigel_diskMomentsByTable rigel_diskMomentsByQuadrature
#endif
#ifndef RIGEL_DISK_BY_QUADRATURE
#define RIGEL_DISK_BY_QUADRATURE true
#endif

/// By the table where there is one.
RigelDiskMoments rigel_diskMoments(RigelDiskCone cone) {
  if (RIGEL_DISK_BY_TABLE) return rigel_diskMomentsByTable(cone);
  return rigel_diskMomentsByQuadrature(cone);
}

/// World SH of radiance from moments: to be multiplied by the light's colour (pi times radiance) and `view.flux`.
void rigel_diskSh(RigelDiskMoments q, RigelDiskView view, out float sh[RIGEL_SH_COUNT]) {
  sh[0] = q.q00;
  sh[1] = kRigelY1 * view.zy;
  sh[2] = kRigelY1 * view.zz;
  sh[3] = kRigelY1 * view.zx;
#if RIGEL_BANDS > 2
  float band2[5];
  rigel_diskBand2(q, view, band2);
  for (int i = 0; i < 5; ++i) sh[4 + i] = band2[i];
#endif
#if RIGEL_BANDS > 3
  float band3[7];
  rigel_diskBand3(q, view, band3);
  for (int i = 0; i < 7; ++i) sh[9 + i] = band3[i];
#endif
#if RIGEL_BANDS > 4
  float band4[9];
  rigel_diskBand4(q, view, band4);
  for (int i = 0; i < 9; ++i) sh[16 + i] = band4[i];
#endif
}

#endif
