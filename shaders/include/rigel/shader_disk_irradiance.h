// Irradiance of a disk light, clipped at the receiver's horizon, in the bisector frame of shader_disk.h and normalised
// by the vector irradiance pi L sx sy: 1 is what arrives at a normal along Z. Parsed by C++ and GLSL.
//
// Rim and horizon. The rim is (sx u cos f, sy sin f, cx u), the horizon cuts it at f0 -+ phi, where with
// e = (sx u nx, sy ny, cx u nz) and A = hypot(ex, ey) f0 is the angle of (ex, ey) and cos phi = -ez/A. Half the contour
// integral of n . (w x dw)/|w|^2 over rim and horizon (Lambert 1760) is
//
//   2E = sx sy nz dpsi + O - (sy cx nx/t) X - (sx cx u^2 ny/t) Y,
//
// O the angle between the two points on the horizon, dpsi what atan(tan f/u) gains between them, and X + iY = 2 atan of
// (t sin phi/|g|^2) g, g = u cos f0 + i sin f0. With tau = (t sin phi)^2, G = |g|^2 and k = 2 sin phi u^2 cx/A
//
//   tan O = sx sy k/H,   tan X = 2 t u sin phi cos f0/(G - tau),   tanh Y = 2 t sin phi sin f0/(G + tau),
//   H = u^2 (cx^2 + sx^2 cos f1 cos f2) + sy^2 sin f1 sin f2,   G - tau = H + 2 (sx u sin phi)^2.
//
// For a light of angular size s the three are of size s and cancel to s^3. So what is left of their leading terms is
// taken together,
//
//   sx sy k [1/H - nx^2/(G-tau) - ny^2/(G+tau)]
//     = sx sy k/(G-tau) [2 (sx u sin phi)^2/H + nz^2 + 2 tau ny^2/(G+tau)],
//
// no term of which is negative. Where O or X is above 45 degrees the light is large, but a sliver (sx << 1) may lie
// along the horizon, O and X all but the same: there their difference is formed as one arc tangent.
#ifndef RIGEL_SHADER_DISK_IRRADIANCE_H
#define RIGEL_SHADER_DISK_IRRADIANCE_H

#include "rigel/shader_disk.h"

#ifdef __cplusplus
#define rigel_diskAtanRest diskAtanRest
#define rigel_diskAtanSlope diskAtanSlope
#define rigel_diskAngle diskAngle
#define rigel_diskHalve diskHalve
#define rigel_diskLambert diskLambert
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#endif

/// 1 - atan(r)/r for 0 <= r <= 1, to 3e-8 of r. Minimax fit (shader_arctangent.h).
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskAtanRest(Real r) RIGEL_NOEXCEPT {
  Real q = r * r;
  return q * (Real(0.333316590f) +
              q * (Real(-0.199627032f) +
                   q * (Real(0.139765777f) +
                        q * (Real(-0.097942225f) +
                             q * (Real(0.057773421f) + q * (Real(-0.023040017f) + q * Real(0.004355373f)))))));
}

/// (rest(a) - rest(b)) / (a - b) of the above as a function of r^2.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskAtanSlope(Real a, Real b) RIGEL_NOEXCEPT {
  Real c = Real(0.004355373f);
  Real d = c;
  c = Real(-0.023040017f) + a * c;
  d = c + b * d;
  c = Real(0.057773421f) + a * c;
  d = c + b * d;
  c = Real(-0.097942225f) + a * c;
  d = c + b * d;
  c = Real(0.139765777f) + a * c;
  d = c + b * d;
  c = Real(-0.199627032f) + a * c;
  d = c + b * d;
  c = Real(0.333316590f) + a * c;
  return c + b * d;
}

/// atan2(y, x), y >= 0, from the arc tangent of the smaller over the larger of y and |x|.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskAngle(Real y, Real x, Real acute) RIGEL_NOEXCEPT {
  Real angle = rigel_select(y > abs(x), Real(0.5 * kRigelPi) - acute, acute);
  return rigel_select(x < Real(0.0f), Real(kRigelPi) - angle, angle);
}

/// One step of the logarithm below: `start` + log(1/bound)/2 and p/bound where p < bound q.
RIGEL_GENERIC RIGEL_FUNCTION void rigel_diskHalve(RIGEL_INOUT(Real) start, RIGEL_INOUT(Real) p, Real q, Real bound,
                                                  Real inverse, Real halfLog) RIGEL_NOEXCEPT {
  Real below = q * bound - p;
  start = rigel_select(below > Real(0.0f), start + halfLog, start);
  p = rigel_select(below > Real(0.0f), p * inverse, p);
}

/// To 1e-6, for every cone and unit normal.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_diskLambert(RIGEL_IN(RIGEL_OF(DiskCone)) cone, Real normalX, Real normalY,
                                                    Real normalZ) RIGEL_NOEXCEPT {
  Real tiny = Real(1e-18f);
  Real one = Real(1.0f);
  Real zero = Real(0.0f);
  Real nx = abs(normalX);
  Real ny = abs(normalY);
  Real nz = normalZ;
  Real ny2 = ny * ny;
  Real nz2 = nz * nz;
  Real t = cone.t;
  Real u = max(cone.u, Real(1e-6f));  // its sixth power must not vanish; the rim is closer than 1e-12 radii there
  Real u2 = u * u;

  // f0 and phi.
  Real ex = cone.sx * u * nx;
  Real ey = cone.sy * ny;
  Real ez = cone.cy * nz;
  Real a = sqrt(ex * ex + ey * ey);
  Real perA = one / max(a, tiny);
  Real cosF = ex * perA;
  Real sinF = ey * perA;
  Real cosPhi = clamp(-ez * perA, -one, one);
  Real sinPhi = sqrt(max((a - ez) * (a + ez), zero)) * perA;
  Real sc = sinF * cosPhi;
  Real cs = cosF * sinPhi;
  Real cc = cosF * cosPhi;
  Real ss = sinF * sinPhi;
  Real sines = (sc - cs) * (sc + cs);    // sin f1 sin f2
  Real cosines = (cc - ss) * (cc + ss);  // cos f1 cos f2

  // The tangents of O, X and of dpsi's acute part.
  Real twoSinU2 = Real(2.0f) * sinPhi * u2 * perA;
  Real k = twoSinU2 * cone.cx;
  Real flux = cone.sx * cone.sy;
  Real horizonY = flux * k;
  Real horizonX = u2 * (cone.cx2 + cone.sx2 * cosines) + cone.sy2 * sines;
  Real sidePerT = Real(2.0f) * u * cs;
  Real sideY = t * sidePerT;
  Real sideX = u2 + t * t * sines;
  Real crossing = Real(2.0f) * cone.sx2 * u2 * sinPhi * sinPhi;
  Real large = max(horizonY - horizonX, sideY - sideX);  // above 0 where O or X is above 45 degrees
  Real arcY = Real(2.0f) * u * sinPhi * abs(cosPhi);
  Real arcX = u2 * cosines + sines;

  // sy cx - t nx and t - sy cx nx; where nx is all but 1, so are the others and t = sy cx.
  Real diagonal = cone.sy * cone.cx;
  Real perNormal = one + nx;
  Real perDiagonal = max(diagonal + t, tiny);
  Real perX = max(t, Real(0.25f));  // X above 45 degrees needs t above 0.38
  Real fluxed = max(flux, tiny);
  Real both = one / (perNormal * perDiagonal * fluxed * perX * u2);
  Real lengths = both * perNormal * perDiagonal;
  Real perU2 = lengths * fluxed * perX;
  lengths *= u2;
  Real perFlux = lengths * perX;
  Real perT = lengths * fluxed;
  both *= fluxed * perX * u2;
  Real oneLess = (ny2 + nz2) * (both * perDiagonal);
  Real slope2 = cone.sx2 * (cone.cx2 - t * t * (one + cone.cx2)) * (both * perNormal);  // sy cx - t
  Real turn = rigel_select(nx > Real(0.5f), slope2 + t * oneLess, diagonal - t * nx);
  Real slip = rigel_select(nx > Real(0.5f), diagonal * oneLess - slope2, t - diagonal * nx);
  // tan(O - X) = turned / along.
  Real turned = twoSinU2 * cone.sx * (turn * sideX + t * nx * crossing);
  Real along = horizonX * sideX + horizonY * sideY;

  // Three arc tangents by one division: dpsi; X; O, or O - X where they are large.
  Real angleY = rigel_select(large > zero, abs(turned) * perU2, horizonY);
  Real angleX = rigel_select(large > zero, along * perU2, horizonX);
  Real arcMax = max(max(arcY, abs(arcX)), tiny);
  Real sideMax = max(max(sideY, abs(sideX)), tiny);
  Real angleMax = max(max(angleY, abs(angleX)), tiny);
  Real all = one / (arcMax * sideMax * angleMax);
  Real perArc = all * sideMax * angleMax;
  Real perSide = all * arcMax * angleMax;
  Real perAngle = all * arcMax * sideMax;
  Real arcRatio = min(arcY, abs(arcX)) * perArc;
  Real sideRatio = min(sideY, abs(sideX)) * perSide;
  Real angleRatio = min(angleY, abs(angleX)) * perAngle;
  Real arc = rigel_diskAngle(arcY, arcX, arcRatio * (one - rigel_diskAtanRest(arcRatio)));
  arc = rigel_select(cosPhi > zero, arc, Real(2.0 * kRigelPi) - arc);
  Real sideRest = rigel_diskAtanRest(sideRatio);
  Real sideSquare = sideRatio * sideRatio;
  Real angleSquare = angleRatio * angleRatio;
  Real slope = rigel_diskAtanSlope(sideSquare, angleSquare);
  Real angleRest = sideRest + (angleSquare - sideSquare) * slope;

  // Y = log(q/p)/2, as start + atanh(y); over tanh(Y) (G + tau) / t, less 1/(G + tau).
  Real tSin = t * sinPhi;
  Real g = u2 * cosF * cosF;
  Real p = g + (sinF - tSin) * (sinF - tSin);
  Real q = g + (sinF + tSin) * (sinF + tSin);
  Real sum = p + q;
  Real start = zero;
  rigel_diskHalve(start, p, q, Real(5.9604644775390625e-8), Real(16777216.0f), Real(8.3177661667193433));
  rigel_diskHalve(start, p, q, Real(2.44140625e-4f), Real(4096.0f), Real(4.1588830833596717));
  rigel_diskHalve(start, p, q, Real(0.015625f), Real(64.0f), Real(2.0794415416798358));
  rigel_diskHalve(start, p, q, Real(0.125f), Real(8.0f), Real(1.0397207708399179));
  rigel_diskHalve(start, p, q, Real(0.35355339059327379), Real(2.8284271247461903), Real(0.51986038541995897));
  Real tangent = rigel_select(start > zero, Real(2.0f) * tSin * sinF, one);
  Real logs = one / max(sum * (q + p) * tangent, Real(1e-37f));
  Real perG = Real(2.0f) * logs * (q + p) * tangent;
  Real y = (q - p) * (logs * sum * tangent);
  Real y2 = y * y;
  Real yRest =
      y2 *
      (Real(0.333335727f) +
       y2 * (Real(0.199856222f) + y2 * (Real(0.145623311f) + y2 * (Real(0.0884157792f) + y2 * Real(0.170340702f)))));
  yRest = rigel_select(start > zero, (start + y + y * yRest) * (logs * sum * (q + p)) - perG, yRest * perG);

  Real whenSmall = k * (perSide * ((crossing * perAngle + nz2) * (one - sideRest) +
                                   ny2 * (Real(2.0f) * tSin * tSin * perG - sideRest) -
                                   slope * (sideRatio + angleRatio) * (turned * perAngle * perAngle)) -
                        ny2 * yRest);

  Real angle = rigel_diskAngle(angleY, angleX, angleRatio * (one - angleRest)) * perFlux;
  angle = rigel_select(max(turned, -along) < zero, -angle, angle);
  Real side = rigel_select(sideY < sideX, sidePerT * perSide * (one - sideRest),
                           perT * rigel_diskAngle(sideY, sideX, sideRatio * (one - sideRest)));
  Real rest = rigel_select(large > zero, angle + slip * perFlux * side - k * ny2 * (perG + yRest), whenSmall);
  Real clipped = Real(0.5 / kRigelPi) * (nz * arc + rest);
  return max(rigel_select(ez < a, clipped, nz), zero);
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#endif

#endif
