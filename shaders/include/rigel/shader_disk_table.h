// SH of a disk light by two small textures. What they hold is not the moments of shader_disk.h but what is left of them
// above one node: the integrands at psi = pi/4, where c is its root mean square over the rim. That node is exact on the
// disk's axis, on its face and far away, so that the rest is small and vanishes on two edges of the textures.
// Coordinates are those in which the rest is smooth, and cost two square roots:
//
//   U = 1 - cx            0 in the disk's plane and far away, 1 on its face
//   V = 1 - u^(3/4)       0 on the disk's axis and far away, 1 on its rim
//
// Texture 0 is (q00, q20, q22, q40), texture 1 (q42, q44, 0, 0), each less that node. Nodes are on the edges: of n
// texels a row, texel i is U = i/(n-1), so the texture coordinate is (U (n-1) + 1/2)/n; filtering is bilinear, clamped
// to the edge. With two or three bands texture 1 is not needed. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_DISK_TABLE_H
#define RIGEL_SHADER_DISK_TABLE_H

#include "rigel/shader_disk.h"

#ifdef __cplusplus
#define rigel_diskTableU diskTableU
#define rigel_diskTableV diskTableV
#define rigel_diskMomentsAtOneNode diskMomentsAtOneNode
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#define Bands 5
#endif

RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskTableU(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  return max(Real(1.0f) - cone.cx, Real(0.0f));
}

RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskTableV(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  Real root = sqrt(cone.u);
  return max(Real(1.0f) - root * sqrt(root), Real(0.0f));
}

/// What the texels are added to. Band 3 is exact as it is, and so is band 1.
RIGEL_GENERIC_BANDS RIGEL_FUNCTION RIGEL_OF(DiskMoments)
    rigel_diskMomentsAtOneNode(RIGEL_IN(RIGEL_OF(DiskCone)) cone) RIGEL_NOEXCEPT {
  Real c2 = Real(0.5f) * (cone.cx2 + cone.cy2);
  Real e = Real(0.5f) * (cone.sx2 - cone.sy2);
  RIGEL_OF(DiskSums) sums = rigel_diskSums(Real(0.0f));
  sums.c = sqrt(c2);
  sums.inverse = Real(1.0f) / (Real(1.0f) + sums.c);
  sums.c3 = sums.c * c2;
  sums.eInverse = e * (sums.inverse + sums.inverse * sums.inverse);
  sums.ec = e * sums.c;
  // `fourfold` stays 0: the node sees nothing of it, and it falls with t^4.
  return RIGEL_BANDED(rigel_diskMomentsOf)(sums, cone);
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#undef Bands
#endif

#endif
