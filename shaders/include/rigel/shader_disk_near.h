// A near disk light's Lambert irradiance by branches and the approximate forms of it, in the bisector frame of
// shader_disk.h and normalised by the vector irradiance as shader_disk_irradiance.h is: wrap, the cheap Lambert form,
// and what 3-band SH leave out. A normal sees the disk as it sees a sphere of the disk's angular size in its own
// direction. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_DISK_NEAR_H
#define RIGEL_SHADER_DISK_NEAR_H

#include "rigel/shader_disk_irradiance.h"
#include "rigel/shader_near_cap.h"

#ifdef __cplusplus
#define rigel_diskLambertBranched diskLambertBranched
#define rigel_diskSpread2 diskSpread2
#define rigel_diskBands diskBands
#define rigel_kernelBands kernelBands
#define rigel_diskWrapped diskWrapped
#define rigel_diskLambertCheap diskLambertCheap
#define rigel_diskAboveBand2 diskAboveBand2
#define RigelDiskCone DiskCone<float>
#define RigelDiskMoments DiskMoments<float>
namespace rigel::detail {
#endif

/// rigel_diskLambert for those who may branch: most lights are not crossed by the horizon.
RIGEL_FUNCTION float rigel_diskLambertBranched(RIGEL_IN(RigelDiskCone) cone, float nx, float ny,
                                               float nz) RIGEL_NOEXCEPT {
  float ex = cone.sx * cone.u * nx;
  float ey = cone.sy * ny;
  float ez = cone.cy * nz;
  if (ez * ez >= ex * ex + ey * ey) return max(nz, 0.0f);
  return rigel_diskLambert(cone, nx, ny, nz);
}

/// The square of the disk's angular size s along the normal, by which n.w varies over it. The last term stands for the
/// fall of the cosine towards the rim; its factor and that of x below are fits.
RIGEL_FUNCTION float rigel_diskSpread2(RIGEL_IN(RigelDiskCone) cone, float nx, float ny, float nz) RIGEL_NOEXCEPT {
  return cone.sx2 * nx * nx + cone.sy2 * ny * ny + 0.375f * (cone.sx2 + cone.sy2) * nz * nz;
}

/// pi sum_l f_l sum_m q_lm Y_lm(n) of five bands.
RIGEL_FUNCTION float rigel_diskBands(RIGEL_IN(RigelDiskMoments) q, float nx, float ny, float nz,
                                     RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  float x2 = nx * nx;
  float y2 = ny * ny;
  float z2 = nz * nz;
  float twofold = x2 - y2;
  float fourfold = twofold * twofold - 4.0f * x2 * y2;
  float b2 = float(kRigelY20) * q.q20 * (3.0f * z2 - 1.0f) + float(kRigelY22) * q.q22 * twofold;
  float b3 = nz * (float(kRigelY30) * q.q30 * (5.0f * z2 - 3.0f) + float(kRigelY32) * q.q32 * twofold);
  float b4 = float(kRigelY40) * q.q40 * (z2 * (35.0f * z2 - 30.0f) + 3.0f) +
             float(kRigelY42) * q.q42 * twofold * (7.0f * z2 - 1.0f) + float(kRigelY44) * q.q44 * fourfold;
  return float(kRigelPi) * (wrap.f.x * float(kRigelY00) * q.q00 + wrap.f.z * b2 + wrap.f.w * b3 + wrap.f4 * b4) +
         0.75f * wrap.f.y * nz;
}

/// The first five bands of rigel_blurredKernel, `blur` as in rigel_wrapCap.
RIGEL_FUNCTION float rigel_kernelBands(float x, float blur, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  float b0 = wrap.f.x + blur * wrap.blurBand.x;
  float b1 = wrap.f.y + blur * wrap.blurBand.y;
  float b2 = wrap.f.z + blur * wrap.blurBand.z;
  float b3 = wrap.f.w + blur * wrap.blurBand.w;
  float b4 = wrap.f4 + blur * wrap.blurBand4;
  float q = x * x;
  // (2l+1)/4 P_l(x) by powers of x.
  return 0.25f * b0 - 0.625f * b2 + 0.84375f * b4 + q * (1.875f * b2 - 8.4375f * b4 + q * (9.84375f * b4)) +
         x * (0.75f * b1 - 2.625f * b3 + q * (4.375f * b3));
}

/// Any wrap: the first five bands as SH give them, and above them the blurred kernel's, less and less the larger the
/// disk is along the normal. `q`: five bands.
RIGEL_FUNCTION float rigel_diskWrapped(RIGEL_IN(RigelDiskMoments) q, RIGEL_IN(RigelDiskCone) cone, float nx, float ny,
                                       float nz, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  float e = rigel_diskBands(q, nx, ny, nz, wrap);
  float s2 = rigel_diskSpread2(cone, nx, ny, nz);
  float h = rigel_highBandShare(s2);
  if (h > 0.0f) {
    // n.w averages less than at the disk's middle, the more the longer the disk is.
    float x = nz * (0.8f + 0.2f * cone.u);
    float kernel = wrap.gain * rigel_blurredKernel(x, wrap.blur * sqrt(s2), wrap);
    e += h * (kernel - rigel_kernelBands(x, s2 * (1.0f - 1.474f * s2), wrap));
  }
  return max(e, 0.0f);
}

/// Lambert without inverse function or branch: rigel_lambertCapCheap of a sphere of the size along the normal.
RIGEL_FUNCTION float rigel_diskLambertCheap(RIGEL_IN(RigelDiskCone) cone, float nx, float ny, float nz) RIGEL_NOEXCEPT {
  float x2 = nx * nx;
  float y2 = ny * ny;
  float perAround = 1.0f / max(x2 + y2, 1e-12f);
  float s = sqrt(clamp((cone.sx2 * x2 + cone.sy2 * y2) * perAround, 1e-12f, 1.0f));
  float c = sqrt(min((cone.cx2 * x2 + cone.cy2 * y2) * perAround, 1.0f));
  return max(rigel_lambertCapCheap(nz, s, c), 0.0f);
}

/// What 3-band SH leave out: rigel_kernelAboveBand2, faded out where the disk is so large that SH hold it.
RIGEL_FUNCTION float rigel_diskAboveBand2(RIGEL_IN(RigelDiskCone) cone, float nx, float ny, float nz,
                                          RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  return rigel_highBandShare(rigel_diskSpread2(cone, nx, ny, nz)) * rigel_kernelAboveBand2(nz, wrap);
}

#ifdef __cplusplus
}  // namespace rigel::detail
#endif

#endif
