// From a disk light's place to the bisector frame of shader_disk.h, and SH from there to the world. Parsed by C++ and
// GLSL.
#ifndef RIGEL_SHADER_DISK_VIEW_H
#define RIGEL_SHADER_DISK_VIEW_H

#include "rigel/shader_disk.h"

#ifdef __cplusplus
#define rigel_diskPlace diskPlace
#define rigel_diskView diskView
#define rigel_diskBand2 diskBand2
#define rigel_diskBand3 diskBand3
#define rigel_diskBand4 diskBand4
#define rigel_addZonalBand4 addZonalBand4
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#endif

/// Where a receiver is: rho and z of shader_disk.h, X_b the unit vector from it towards the disk's axis (on the axis
/// any that is perpendicular), Z_b towards the disk's plane; Y is perpendicular to both.
RIGEL_STRUCT(DiskPlace) {
  Real rho, z;
  Real xx, xy, xz;
  Real yx, yy, yz;
  Real zx, zy, zz;
};

/// `v`: from the receiver to the disk's centre, in radii. `a`: unit vector the disk emits along; zero gives z = 0.
/// `along`: v . a, which callers near the disk's plane know better than v says. `behind`: -1 where it emits backwards
/// too, else 0 (GpuNearLight::cosOuter).
RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskPlace)
    rigel_diskPlace(Real vx, Real vy, Real vz, Real ax, Real ay, Real az, Real along, Real behind) RIGEL_NOEXCEPT {
  // Two axes s, t perpendicular to `a` (T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017): what
  // they make is perpendicular even where v is all but parallel to a.
  Real side = rigel_select(az < Real(0.0f), Real(-1.0f), Real(1.0f));
  Real k = Real(-1.0f) / (side + az);
  Real sx = Real(1.0f) + side * ax * ax * k;
  Real tx = ax * ay * k;
  Real sy = side * tx;
  Real ty = side + ay * ay * k;
  Real sz = -side * ax;
  Real tz = -ay;

  Real vs = vx * sx + vy * sy + vz * sz;
  Real vt = vx * tx + vy * ty + vz * tz;
  Real facing = rigel_select(along > Real(0.0f), behind, Real(1.0f));

  RIGEL_OF(DiskPlace) place;
  place.rho = sqrt(vs * vs + vt * vt);
  place.z = -along * facing;
  Real perRho = Real(1.0f) / max(place.rho, Real(1e-18f));
  Real cosine = rigel_select(place.rho > Real(1e-18f), vs * perRho, Real(1.0f));
  Real sine = rigel_select(place.rho > Real(1e-18f), vt * perRho, Real(0.0f));
  place.xx = cosine * sx + sine * tx;
  place.xy = cosine * sy + sine * ty;
  place.xz = cosine * sz + sine * tz;
  place.yx = facing * (sine * sx - cosine * tx);
  place.yy = facing * (sine * sy - cosine * ty);
  place.yz = facing * (sine * sz - cosine * tz);
  place.zx = -facing * ax;
  place.zy = -facing * ay;
  place.zz = -facing * az;
  return place;
}

/// A disk as a receiver sees it; X, Y, Z: the axes of the bisector frame.
RIGEL_STRUCT(DiskView) {
  RIGEL_OF(DiskCone) cone;
  Real flux;  // vector irradiance over pi L: sx sy, or 0 behind the disk and in its plane
  Real xx, xy, xz;
  Real yx, yy, yz;
  Real zx, zy, zz;
};

/// `m`: rho^2 + z^2 - 1.
RIGEL_GENERIC RIGEL_FUNCTION RIGEL_OF(DiskView)
    rigel_diskView(RIGEL_IN(RIGEL_OF(DiskPlace)) place, Real m) RIGEL_NOEXCEPT {
  RIGEL_OF(DiskView) view;
  view.cone = rigel_diskCone(place.rho, m, place.z);
  view.flux = rigel_select(place.z > Real(0.0f), view.cone.sx * view.cone.sy, Real(0.0f));
  // Tilted about Y.
  Real perSy = Real(1.0f) / max(view.cone.sy, Real(1e-18f));
  Real cosTilt = view.cone.sx * perSy;
  Real sinTilt = view.cone.t * view.cone.cx * perSy;
  view.xx = cosTilt * place.xx - sinTilt * place.zx;
  view.xy = cosTilt * place.xy - sinTilt * place.zy;
  view.xz = cosTilt * place.xz - sinTilt * place.zz;
  view.yx = place.yx;
  view.yy = place.yy;
  view.yz = place.yz;
  view.zx = sinTilt * place.xx + cosTilt * place.zx;
  view.zy = sinTilt * place.xy + cosTilt * place.zy;
  view.zz = sinTilt * place.xz + cosTilt * place.zz;
  return view;
}

// World SH, l = 0: q00; l = 1: Y_1m(Z). The others are what harmonic polynomials of the frame's axes are in the
// world's.

RIGEL_GENERIC RIGEL_FUNCTION void rigel_diskBand2(RIGEL_IN(RIGEL_OF(DiskMoments)) q, RIGEL_IN(RIGEL_OF(DiskView)) view,
                                                  RIGEL_ARRAY(out2, 5)) RIGEL_NOEXCEPT {
  // w^T N w with N = sqrt(3) q20 Z Z^T + q22 (X X^T - Y Y^T), up to its trace; so Y Y^T = 1 - X X^T - Z Z^T leaves only
  // Z Z^T and X X^T.
  Real a = Real(1.7320508075688773) * q.q20 + q.q22;
  Real b = Real(2.0f) * q.q22;
  Real azx = a * view.zx;
  Real azy = a * view.zy;
  Real azz = a * view.zz;
  Real bxx = b * view.xx;
  Real bxy = b * view.xy;
  Real bxz = b * view.xz;
  Real nxx = azx * view.zx + bxx * view.xx;
  Real nyy = azy * view.zy + bxy * view.xy;
  Real nzz = azz * view.zz + bxz * view.xz;
  out2[0] = azx * view.zy + bxx * view.xy;
  out2[1] = azy * view.zz + bxy * view.xz;
  out2[2] = Real(0.28867513459481288) * (Real(2.0f) * nzz - nxx - nyy);
  out2[3] = azx * view.zz + bxx * view.xz;
  out2[4] = Real(0.5f) * (nxx - nyy);
}

RIGEL_GENERIC RIGEL_FUNCTION void rigel_diskBand3(RIGEL_IN(RIGEL_OF(DiskMoments)) q, RIGEL_IN(RIGEL_OF(DiskView)) view,
                                                  RIGEL_ARRAY(out3, 7)) RIGEL_NOEXCEPT {
  // The second derivatives of r^3 Y_3m at Z, which have no trace, contracted with N = a' Z Z^T + b' (X X^T - Y Y^T).
  Real twofold = Real(8.0 / 105.0 * kRigelPi * kRigelY32) * q.q32;
  Real a = Real(1.0 / 6.0 / kRigelY30) * q.q30 + twofold;
  Real b = Real(2.0f) * twofold;
  Real x = view.zx;
  Real y = view.zy;
  Real z = view.zz;
  Real bxx = b * view.xx;
  Real bxy = b * view.xy;
  Real nxx = a * x * x + bxx * view.xx;
  Real nyy = a * y * y + bxy * view.xy;
  Real nzz = a * z * z + b * view.xz * view.xz;
  Real nxy = a * x * y + bxx * view.xy;
  Real nyz = a * y * z + bxy * view.xz;
  Real nxz = a * x * z + bxx * view.xz;
  Real difference = nxx - nyy;
  Real trace = Real(2.0f) * nzz - nxx - nyy;
  out3[0] = Real(3.0 * kRigelY33) * (y * difference + Real(2.0f) * x * nxy);
  out3[1] = Real(2.0 * kRigelY32) * (z * nxy + y * nxz + x * nyz);
  out3[2] = Real(kRigelY31) * (y * (Real(2.0f) * trace + difference) - Real(2.0f) * x * nxy + Real(8.0f) * z * nyz);
  out3[3] = Real(3.0 * kRigelY30) * (z * trace - Real(2.0f) * (x * nxz + y * nyz));
  out3[4] = Real(kRigelY31) * (x * (Real(2.0f) * trace - difference) - Real(2.0f) * y * nxy + Real(8.0f) * z * nxz);
  out3[5] = Real(kRigelY32) * (z * difference + Real(2.0f) * (x * nxz - y * nyz));
  out3[6] = Real(3.0 * kRigelY33) * (x * difference - Real(2.0f) * y * nxy);
}

/// out4[m + 4] += weight Y_4m of a unit vector.
RIGEL_GENERIC RIGEL_FUNCTION void rigel_addZonalBand4(Real weight, Real x, Real y, Real z,
                                                      RIGEL_ARRAY(out4, 9)) RIGEL_NOEXCEPT {
  Real xx = x * x;
  Real yy = y * y;
  Real zz = z * z;
  Real tt = xx + yy;
  Real xy2 = Real(2.0f) * x * y;
  Real xxyy = xx - yy;
  Real f41 = Real(kRigelY41) * weight * z * (Real(4.0f) * zz - Real(3.0f) * tt);
  Real f42 = Real(kRigelY42) * weight * (Real(6.0f) * zz - tt);
  Real f43 = Real(kRigelY43) * weight * z;
  Real f44 = Real(kRigelY44) * weight;
  out4[0] += f44 * Real(2.0f) * xy2 * xxyy;
  out4[1] += f43 * (x * xy2 + y * xxyy);
  out4[2] += f42 * xy2;
  out4[3] += f41 * y;
  out4[4] += Real(kRigelY40) * weight * (Real(8.0f) * zz * (zz - Real(3.0f) * tt) + Real(3.0f) * tt * tt);
  out4[5] += f41 * x;
  out4[6] += f42 * xxyy;
  out4[7] += f43 * (x * xxyy - y * xy2);
  out4[8] += f44 * (xxyy - xy2) * (xxyy + xy2);
}

RIGEL_GENERIC RIGEL_FUNCTION void rigel_diskBand4(RIGEL_IN(RIGEL_OF(DiskMoments)) q, RIGEL_IN(RIGEL_OF(DiskView)) view,
                                                  RIGEL_ARRAY(out4, 9)) RIGEL_NOEXCEPT {
  // Y_4m(X) - Y_4m(Y) is m = 2 alone, Y_4m(X) + Y_4m(Y) is m = 4 and 0.
  Real twofold = Real(0.5 / kRigelY42) * q.q42;
  Real fourfold = Real(0.5 / kRigelY44) * q.q44;
  for (int i = 0; i < 9; ++i) out4[i] = Real(0.0f);
  rigel_addZonalBand4(fourfold - twofold, view.xx, view.xy, view.xz, out4);
  rigel_addZonalBand4(fourfold + twofold, view.yx, view.yy, view.yz, out4);
  rigel_addZonalBand4(Real(0.125 / kRigelY40) * q.q40 - Real(0.75f) * fourfold, view.zx, view.zy, view.zz, out4);
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#endif

#endif
