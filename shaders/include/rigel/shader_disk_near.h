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
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#endif

/// rigel_diskLambert for those who may branch: most lights are not crossed by the horizon.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskLambertBranched(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real nx, Real ny,
                                                            Real nz) RIGEL_NOEXCEPT {
  Real ex = cone.sx * cone.u * nx;
  Real ey = cone.sy * ny;
  Real ez = cone.cy * nz;
  if (rigel_all(ez * ez >= ex * ex + ey * ey)) return max(nz, Real(0.0f));
  return rigel_diskLambert(cone, nx, ny, nz);
}

/// The square of the disk's angular size s along the normal, by which n.w varies over it. The last term stands for the
/// fall of the cosine towards the rim; its factor and that of x below are fits.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskSpread2(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real nx, Real ny,
                                                    Real nz) RIGEL_NOEXCEPT {
  return cone.sx2 * nx * nx + cone.sy2 * ny * ny + Real(0.375f) * (cone.sx2 + cone.sy2) * nz * nz;
}

/// pi sum_l f_l sum_m q_lm Y_lm(n) of five bands.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskBands(RIGEL_IN(RIGEL_OF(DiskMoments)) q, Real nx, Real ny, Real nz,
                                                  RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  Real x2 = nx * nx;
  Real y2 = ny * ny;
  Real z2 = nz * nz;
  Real twofold = x2 - y2;
  Real fourfold = twofold * twofold - Real(4.0f) * x2 * y2;
  Real b2 = Real(kRigelY20) * q.q20 * (Real(3.0f) * z2 - Real(1.0f)) + Real(kRigelY22) * q.q22 * twofold;
  Real b3 = nz * (Real(kRigelY30) * q.q30 * (Real(5.0f) * z2 - Real(3.0f)) + Real(kRigelY32) * q.q32 * twofold);
  Real b4 = Real(kRigelY40) * q.q40 * (z2 * (Real(35.0f) * z2 - Real(30.0f)) + Real(3.0f)) +
            Real(kRigelY42) * q.q42 * twofold * (Real(7.0f) * z2 - Real(1.0f)) + Real(kRigelY44) * q.q44 * fourfold;
  return Real(kRigelPi) * (Real(wrap.f.x) * Real(kRigelY00) * q.q00 + Real(wrap.f.z) * b2 + Real(wrap.f.w) * b3 +
                           Real(wrap.f4) * b4) +
         Real(0.75f) * Real(wrap.f.y) * nz;
}

/// The first five bands of rigel_blurredKernel, `blur` as in rigel_wrapCap.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_kernelBands(Real x, Real blur, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  Real b0 = Real(wrap.f.x) + blur * Real(wrap.blurBand.x);
  Real b1 = Real(wrap.f.y) + blur * Real(wrap.blurBand.y);
  Real b2 = Real(wrap.f.z) + blur * Real(wrap.blurBand.z);
  Real b3 = Real(wrap.f.w) + blur * Real(wrap.blurBand.w);
  Real b4 = Real(wrap.f4) + blur * Real(wrap.blurBand4);
  Real q = x * x;
  // (2l+1)/4 P_l(x) by powers of x.
  return Real(0.25f) * b0 - Real(0.625f) * b2 + Real(0.84375f) * b4 +
         q * (Real(1.875f) * b2 - Real(8.4375f) * b4 + q * (Real(9.84375f) * b4)) +
         x * (Real(0.75f) * b1 - Real(2.625f) * b3 + q * (Real(4.375f) * b3));
}

/// Any wrap: the first five bands as SH give them, and above them the blurred kernel's, less and less the larger the
/// disk is along the normal. `q`: five bands.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskWrapped(RIGEL_IN(RIGEL_OF(DiskMoments)) q,
                                                    RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real nx, Real ny, Real nz,
                                                    RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  Real e = rigel_diskBands(q, nx, ny, nz, wrap);
  Real s2 = rigel_diskSpread2(cone, nx, ny, nz);
  Real h = rigel_highBandShare(s2);
  if (!rigel_all(h <= Real(0.0f))) {
    // n.w averages less than at the disk's middle, the more the longer the disk is.
    Real x = nz * (Real(0.8f) + Real(0.2f) * cone.u);
    Real kernel = Real(wrap.gain) * rigel_blurredKernel(x, Real(wrap.blur) * sqrt(s2), wrap);
    e += h * (kernel - rigel_kernelBands(x, s2 * (Real(1.0f) - Real(1.474f) * s2), wrap));
  }
  return max(e, Real(0.0f));
}

/// Lambert without inverse function or branch: rigel_lambertCapCheap of a sphere of the size along the normal.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskLambertCheap(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real nx, Real ny,
                                                         Real nz) RIGEL_NOEXCEPT {
  Real x2 = nx * nx;
  Real y2 = ny * ny;
  Real perAround = Real(1.0f) / max(x2 + y2, Real(1e-12f));
  Real s = sqrt(clamp((cone.sx2 * x2 + cone.sy2 * y2) * perAround, Real(1e-12f), Real(1.0f)));
  Real c = sqrt(min((cone.cx2 * x2 + cone.cy2 * y2) * perAround, Real(1.0f)));
  return max(rigel_lambertCapCheap(nz, s, c), Real(0.0f));
}

/// What 3-band SH leave out: rigel_kernelAboveBand2, faded out where the disk is so large that SH hold it.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskAboveBand2(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real nx, Real ny, Real nz,
                                                       RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  return rigel_highBandShare(rigel_diskSpread2(cone, nx, ny, nz)) * rigel_kernelAboveBand2(nz, wrap);
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#endif

#endif
