// SH of a disk light in the bisector frame. Seen from any point a disk fills an elliptic cone of directions, which has
// two mirror planes; Z bisects the directions to the nearest and the farthest point of the rim, X is in the plane
// through the disk's axis. In that frame every coefficient of odd m vanishes and so does m < 0, Z is the direction of
// the vector irradiance, and bands 1 and 3 are elementary. The others are integrals over a quarter of the cone,
//
//   q_lm = sx sy 4 int_0^{pi/2} h_lm(c(psi)) dpsi,   c^2 = cx^2 cos^2 psi + cy^2 sin^2 psi,
//
// smooth everywhere but on the rim itself, so that a few nodes do. ax <= ay are the cone's half-angles, s and c their
// sine and cosine. Lengths are in disk radii: the receiver is at distance rho from the axis and at height z above the
// face. All of it is finite for rho and z from 0 to kRigelDiskReach; z = 0 is the limit from above. Parsed by C++ and
// GLSL.
#ifndef RIGEL_SHADER_DISK_H
#define RIGEL_SHADER_DISK_H

#include "rigel/shader_constants.h"
#include "rigel/shader_language.h"

#ifdef __cplusplus
#define rigel_diskConeOf diskConeOf
#define rigel_diskCone diskCone
#define rigel_firstDiskNode firstDiskNode
#define rigel_diskNode diskNode
#define rigel_addDiskNode addDiskNode
#define rigel_addDiskNodes addDiskNodes
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

/// A node psi: c, its square, and what e = sx^2 cos^2 psi - sy^2 sin^2 psi and 1 - c^2 are the difference and sum of.
RIGEL_STRUCT(DiskNode) { Real weight, c, c2, along, across; };

/// psi = 0: no root is needed.
RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskNode)
    rigel_firstDiskNode(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real weight) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskNode) node;
  node.weight = weight;
  node.c = cone.cx;
  node.c2 = cone.cx2;
  node.along = cone.sx2;
  node.across = Real(0.0f);
  return node;
}

/// u = cos^2 psi.
RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskNode)
    rigel_diskNode(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real weight, Real u) RIGEL_NOEXCEPT {
  Real v = Real(1.0f) - u;
  RIGEL_OF(DiskNode) node;
  node.weight = weight;
  node.c2 = cone.cx2 * u + cone.cy2 * v;
  node.c = sqrt(node.c2);
  node.along = cone.sx2 * u;
  node.across = cone.sy2 * v;
  return node;
}

/// `inverse`: 1/(1 + c).
RIGEL_GENERIC_BANDS RIGEL_FUNCTION void rigel_addDiskNode(RIGEL_INOUT(RIGEL_OF(DiskSums)) sums,
                                                          RIGEL_IN(RIGEL_OF(DiskNode)) node,
                                                          Real inverse) RIGEL_NOEXCEPT {
  sums.inverse += node.weight * inverse;
  if (Bands > 2) {
    Real g = inverse + inverse * inverse;
    Real e = node.weight * (node.along - node.across);
    sums.c += node.weight * node.c;
    sums.eInverse += e * g;
    if (Bands > 4) {
      Real both = node.along + node.across;
      Real fourfold = Real(2.0f) * e * (node.along - node.across) - node.weight * (both * both);
      sums.c3 += node.weight * (node.c * node.c2);
      sums.ec += e * node.c;
      sums.fourfold += fourfold * (Real(3.0f) * g + Real(2.0f) * (inverse * inverse * inverse));
    }
  }
}

/// Two nodes at the cost of one division.
RIGEL_GENERIC_BANDS RIGEL_FUNCTION void rigel_addDiskNodes(RIGEL_INOUT(RIGEL_OF(DiskSums)) sums,
                                                           RIGEL_IN(RIGEL_OF(DiskNode)) a,
                                                           RIGEL_IN(RIGEL_OF(DiskNode)) b) RIGEL_NOEXCEPT {
  Real both = Real(1.0f) / ((Real(1.0f) + a.c) * (Real(1.0f) + b.c));
  RIGEL_BANDED(rigel_addDiskNode)(sums, a, both * (Real(1.0f) + b.c));
  RIGEL_BANDED(rigel_addDiskNode)(sums, b, both * (Real(1.0f) + a.c));
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

// Nodes and weights that are best for just these integrands: the largest error over all cones whose rim is 1e-2 R away
// and more, and a sixth of it at 1e-3 R, is least (5.5e-5, 2.6e-7, 7.5e-9); with a node at psi = 0, and the integrals
// of cos 2 psi and cos 4 psi exact, which is all there is on the axis. tools/study/disk_node_study.cpp finds them; its
// minimum is flat, so that digits from the third on depend on its random starts. Gauss-Legendre rules of as many nodes
// are 20 (four), 200 (six) and 2000 times (eight) worse.

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMoments4(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  RIGEL_OF(DiskNode) a = rigel_firstDiskNode(cone, Real(0.21101687596755971));
  RIGEL_OF(DiskNode) b = rigel_diskNode(cone, Real(0.38347351470119887), Real(0.64067974827603441));
  RIGEL_OF(DiskNode) c = rigel_diskNode(cone, Real(0.27054773537514287), Real(0.15582005704301069));
  RIGEL_OF(DiskNode) d = rigel_diskNode(cone, Real(0.13496187395609856), Real(0.0084664325608696593));
  RIGEL_BANDED(rigel_addDiskNodes)(sums, a, b);
  RIGEL_BANDED(rigel_addDiskNodes)(sums, c, d);
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMoments6(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  RIGEL_OF(DiskNode) a = rigel_firstDiskNode(cone, Real(0.16112653215362763));
  RIGEL_OF(DiskNode) b = rigel_diskNode(cone, Real(0.30042971897576534), Real(0.77460314501154674));
  RIGEL_OF(DiskNode) c = rigel_diskNode(cone, Real(0.24006355790542389), Real(0.36374689295666809));
  RIGEL_OF(DiskNode) d = rigel_diskNode(cone, Real(0.16000217886952570), Real(0.10653153580334008));
  RIGEL_OF(DiskNode) e = rigel_diskNode(cone, Real(0.089625806736413461), Real(0.019317529439492993));
  RIGEL_OF(DiskNode) f = rigel_diskNode(cone, Real(0.048752205359243970), Real(0.0012442999269667659));
  RIGEL_BANDED(rigel_addDiskNodes)(sums, a, b);
  RIGEL_BANDED(rigel_addDiskNodes)(sums, c, d);
  RIGEL_BANDED(rigel_addDiskNodes)(sums, e, f);
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMoments8(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  RIGEL_OF(DiskNode) a = rigel_firstDiskNode(cone, Real(0.12136917160007467));
  RIGEL_OF(DiskNode) b = rigel_diskNode(cone, Real(0.22694950164148579), Real(0.86740497095318211));
  RIGEL_OF(DiskNode) c = rigel_diskNode(cone, Real(0.19531444961525770), Real(0.58050525259638006));
  RIGEL_OF(DiskNode) d = rigel_diskNode(cone, Real(0.16524410758912235), Real(0.30290914899968583));
  RIGEL_OF(DiskNode) e = rigel_diskNode(cone, Real(0.12629513488107194), Real(0.11908210155017760));
  RIGEL_OF(DiskNode) f = rigel_diskNode(cone, Real(0.083111633677498156), Real(0.035073816770880697));
  RIGEL_OF(DiskNode) g = rigel_diskNode(cone, Real(0.049831826260819887), Real(0.0073468566964433783));
  RIGEL_OF(DiskNode) h = rigel_diskNode(cone, Real(0.031884174734669505), Real(0.00056601839147650753));
  RIGEL_BANDED(rigel_addDiskNodes)(sums, a, b);
  RIGEL_BANDED(rigel_addDiskNodes)(sums, c, d);
  RIGEL_BANDED(rigel_addDiskNodes)(sums, e, f);
  RIGEL_BANDED(rigel_addDiskNodes)(sums, g, h);
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#undef Bands
#endif

#endif
