// SH of a disk light in the bisector frame. Seen from any point a disk fills an elliptic cone of directions, which has
// two mirror planes; Z bisects the directions to the nearest and the farthest point of the rim, X is in the plane
// through the disk's axis. In that frame every coefficient of odd m vanishes and so does m < 0, Z is the direction of
// the vector irradiance, and bands 1 and 3 are elementary. The others are integrals over a quarter of the cone,
//
//   q_lm = sx sy 4 int_0^{pi/2} h_lm(c(psi)) dpsi,   c^2 = cx^2 cos^2 psi + cy^2 sin^2 psi,
//
// smooth everywhere but on the rim itself, so that a few Gauss-Legendre nodes do. ax <= ay are the cone's half-angles,
// s and c their sine and cosine. Lengths are in disk radii: the receiver is at distance rho from the axis and at height
// z above the face. All of it is finite for rho and z from 0 to kRigelDiskReach; z = 0 is the limit from above. Parsed
// by C++ and GLSL.
#ifndef RIGEL_SHADER_DISK_H
#define RIGEL_SHADER_DISK_H

#include "rigel/shader_constants.h"
#include "rigel/shader_language.h"

#ifdef __cplusplus
#define rigel_diskConeOf diskConeOf
#define rigel_diskCone diskCone
#define rigel_addDiskPair addDiskPair
#define rigel_diskSums diskSums
#define rigel_diskMomentsOf diskMomentsOf
#define rigel_diskMoments4 diskMoments4
#define rigel_diskMoments6 diskMoments6
#define rigel_diskMoments8 diskMoments8
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#define Bands 5
#endif

/// t = 0 on the axis, 1 on the rim; u^2 = 1 - t^2, sy^2 = sx^2 + t^2 cx^2, cy = u cx. No square loses digits anywhere.
RIGEL_STRUCT(DiskCone) {
  Real sx2, cx2, sy2, cy2;
  Real sx, cx, sy, cy;
  Real t, u;
};

RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskCone) rigel_diskConeOf(Real sx, Real cx, Real t, Real u2) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskCone) cone;
  cone.t = t;
  cone.u = sqrt(u2);
  cone.sx = sx;
  cone.cx = cx;
  cone.sx2 = sx * sx;
  cone.cx2 = cx * cx;
  cone.sy2 = cone.sx2 + t * t * cone.cx2;
  cone.cy2 = cone.cx2 * u2;
  cone.sy = sqrt(cone.sy2);
  cone.cy = cx * cone.u;
  return cone;
}

/// rho, z >= 0; `m` = rho^2 + z^2 - 1, which callers near the rim know better than rho and z say.
RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskCone) rigel_diskCone(Real rho, Real m, Real z) RIGEL_NOEXCEPT {
  // d1, d2 are the distances to the farthest and the nearest point of the rim: cos(2 ax) = m / (d1 d2) and
  // sin(2 ax) = 2 z / (d1 d2), t = (d1 - d2)/(d1 + d2).
  Real product = max(sqrt(m * m + Real(4.0f) * z * z), Real(1e-18f));
  Real halfSquare = m + Real(2.0f) + product;  // (d1 + d2)^2 / 2
  Real sum = product + abs(m);
  Real all = Real(1.0f) / (product * sum * halfSquare);
  Real perHalfSquare = all * product * sum;
  // The larger of sine and cosine of ax, and the smaller from their product.
  Real larger = sqrt(Real(0.5f) * sum * (all * sum * halfSquare));
  Real smaller = Real(2.0f) * z * larger * (all * product * halfSquare);
  return rigel_diskConeOf(rigel_select(m > Real(0.0f), smaller, larger), rigel_select(m > Real(0.0f), larger, smaller),
                          Real(2.0f) * rho * perHalfSquare, Real(2.0f) * product * perHalfSquare);
}

/// SH per vector irradiance, which is pi L sx sy along Z: coefficient (1, 0) is Y_10(Z), those not listed are 0, and of
/// a small light (l, 0) is Y_l0(Z) and the rest 0. Bands that are not asked for are 0.
RIGEL_STRUCT(DiskMoments) { Real q00, q20, q22, q30, q32, q40, q42, q44; };

/// Sums over nodes of the functions of psi, weights adding up to 1.
RIGEL_STRUCT(DiskSums) { Real inverse, c, c3, eInverse, ec, fourfold; };

RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskSums) rigel_diskSums(Real start) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums;
  sums.inverse = sums.c = sums.c3 = sums.eInverse = sums.ec = sums.fourfold = start;
  return sums;
}

/// The nodes psi and pi/2 - psi, each with `weight`; u = cos^2 psi, v = sin^2 psi.
RIGEL_GENERIC_BANDS RIGEL_FUNCTION void rigel_addDiskPair(RIGEL_INOUT(RIGEL_OF(DiskSums)) sums,
                                                          RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real weight, Real u,
                                                          Real v) RIGEL_NOEXCEPT {
  Real c2a = cone.cx2 * u + cone.cy2 * v;
  Real c2b = cone.cx2 * v + cone.cy2 * u;
  Real ca = sqrt(c2a);
  Real cb = sqrt(c2b);
  // 1/(1+c) of both by one division.
  Real both = Real(1.0f) / ((Real(1.0f) + ca) * (Real(1.0f) + cb));
  Real ia = both * (Real(1.0f) + cb);
  Real ib = both * (Real(1.0f) + ca);
  sums.inverse += weight * (ia + ib);
  if (Bands > 2) {
    sums.c += weight * (ca + cb);
    Real ga = ia + ia * ia;
    Real gb = ib + ib * ib;
    Real ea = cone.sx2 * u - cone.sy2 * v;
    Real eb = cone.sx2 * v - cone.sy2 * u;
    sums.eInverse += weight * (ea * ga + eb * gb);
    if (Bands > 4) {
      sums.c3 += weight * (ca * c2a + cb * c2b);
      sums.ec += weight * (ea * ca + eb * cb);
      Real k2a = cone.sx2 * u + cone.sy2 * v;  // 1 - c^2
      Real k2b = cone.sx2 * v + cone.sy2 * u;
      sums.fourfold += weight * ((Real(2.0f) * ea * ea - k2a * k2a) * (Real(3.0f) * ga + Real(2.0f) * ia * ia * ia) +
                                 (Real(2.0f) * eb * eb - k2b * k2b) * (Real(3.0f) * gb + Real(2.0f) * ib * ib * ib));
    }
  }
}

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMomentsOf(RIGEL_IN(RIGEL_OF(DiskSums)) sums, RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskMoments) q;
  q.q00 = Real(2.0 * kRigelY00) * sums.inverse;
  q.q20 = q.q22 = q.q30 = q.q32 = q.q40 = q.q42 = q.q44 = Real(0.0f);
  if (Bands > 2) {
    q.q20 = Real(2.0 * kRigelY20) * sums.c;
    q.q22 = Real(2.0 / 3.0 * kRigelY22) * sums.eInverse;
  }
  if (Bands > 3) {
    q.q30 = Real(kRigelY30) * (Real(2.0f) - Real(1.25f) * (cone.sx2 + cone.sy2));
    q.q32 = Real(0.25 * kRigelY32) * (cone.sx2 - cone.sy2);
  }
  if (Bands > 4) {
    q.q40 = Real(2.0 * kRigelY40) * (Real(7.0f) * sums.c3 - Real(3.0f) * sums.c);
    q.q42 = Real(kRigelY42) * (Real(2.8) * sums.ec + Real(4.0 / 15.0) * sums.eInverse);
    q.q44 = Real(2.0 / 15.0 * kRigelY44) * sums.fourfold;
  }
  return q;
}

// Gauss-Legendre in psi.

#define RIGEL_PAIR RIGEL_BANDED(rigel_addDiskPair)

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMoments4(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  RIGEL_PAIR(sums, cone, Real(0.32607257743127307), Real(0.24549210725212254), Real(0.75450789274787746));
  RIGEL_PAIR(sums, cone, Real(0.17392742256872693), Real(0.011847712960255530), Real(0.98815228703974447));
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMoments6(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  RIGEL_PAIR(sums, cone, Real(0.23395696728634552), Real(0.31694648792969507), Real(0.68305351207030493));
  RIGEL_PAIR(sums, cone, Real(0.18038078652406930), Real(0.069146250420202816), Real(0.93085374957979718));
  RIGEL_PAIR(sums, cone, Real(0.085662246189585173), Real(0.0028104265513645311), Real(0.99718957344863547));
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMoments8(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  RIGEL_PAIR(sums, cone, Real(0.18134189168918099), Real(0.35791603804903561), Real(0.64208396195096439));
  RIGEL_PAIR(sums, cone, Real(0.15685332293894364), Real(0.13255503062228385), Real(0.86744496937771615));
  RIGEL_PAIR(sums, cone, Real(0.11119051722668724), Real(0.025287307850590567), Real(0.97471269214940943));
  RIGEL_PAIR(sums, cone, Real(0.050614268145188130), Real(0.00097239307474659505), Real(0.99902760692525340));
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

#undef RIGEL_PAIR

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#undef Bands
#endif

#endif
