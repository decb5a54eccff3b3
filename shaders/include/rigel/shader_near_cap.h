// Irradiance of a sphere light in float, normalised by pi L min(1, (r/d)^2): 1 is what a small light straight above
// gives. The receiver is outside the sphere here, s = r/d, c = sqrt(1-s^2), x = n.w; inside, E(x) = f_0 - s^2 E_cap(-x)
// with s = d/r (exact.cpp). Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_NEAR_CAP_H
#define RIGEL_SHADER_NEAR_CAP_H

#include "rigel/shader_arctangent.h"
#include "rigel/shader_types.h"
#include "rigel/shader_wrap.h"

#ifdef __cplusplus
#define rigel_lambertCap lambertCap
#define rigel_lambertCapCheap lambertCapCheap
#define rigel_blurredKernel blurredKernel
#define rigel_highBandShare highBandShare
#define rigel_wrapCap wrapCap
#define rigel_kernelAboveBand2 kernelAboveBand2
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#endif

/// Lambert, clipped at the horizon: the form of exact.cpp, whose terms are all of the result's size, over pi s^2.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_lambertCap(Real x, Real s, Real c) RIGEL_NOEXCEPT {
  Real whole = max(x, Real(0.0f));
  if (rigel_all(abs(x) >= s)) return whole;
  Real t = x / s;
  Real z = sqrt((Real(1.0f) - t) * (Real(1.0f) + t));
  Real quadrant = rigel_atanQuadrant(z, c * abs(t));
  Real arc = x * rigel_select(t > Real(0.0f), Real(kRigelPi) - quadrant, quadrant);
  Real sz = s * z;
  Real rest = Real(0.0f);
  if (!rigel_all(sz <= c)) rest = (rigel_atanQuadrant(sz, c) - sz * c) / (s * s);
  if (!rigel_all(sz > c)) {
    // s^2 v - (v - atan v), v = s z/c, over s^2.
    Real zc = z / max(c, Real(1e-30f));
    Real v = s * zc;
    rest = rigel_select(sz > c, rest, v * (Real(1.0f) - zc * zc * rigel_atanTail(v * v)));
  }
  return rigel_select(abs(x) >= s, whole, max(Real(0.0f), arc + rest) * Real(1.0 / kRigelPi));
}

/// Lambert, cheap: the parabola (x+s)^2/4s between x = -s and s, plus (s/4) g(c) (1-(x/s)^2). g is a fit over all
/// normals for each c; g(0) = 1 makes the touching sphere, (1+x)/2, exact.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_lambertCapCheap(Real x, Real s, Real c) RIGEL_NOEXCEPT {
  Real t = clamp(x / s, Real(-1.0f), Real(1.0f));
  Real g = Real(1.0f) + c * (Real(-2.818f) + c * (Real(2.973f) - c * Real(1.285f)));
  return max(x - s, Real(0.0f)) + Real(0.25f) * s * (Real(1.0f) + t) * (Real(1.0f) + t + g * (Real(1.0f) - t));
}

/// f(x|a) with its corner at the horizon blurred over +-width in u = (x+a)/(1+a).
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_blurredKernel(Real x, Real width, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  Real u = (x + Real(wrap.a)) * Real(wrap.inverse);
  Real halfWidth = max(width, Real(1e-6f));
  Real t = Real(1.0f) + clamp(u / halfWidth, Real(-1.0f), Real(1.0f));
  return rigel_wrapPower(Real(0.25f) * halfWidth * t * t + max(u - halfWidth, Real(0.0f)), wrap.a);
}

/// How much of the kernel's bands from 5 on a sphere of angular size s keeps; with GpuWrap's blur a fit over all a.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_highBandShare(Real s2) RIGEL_NOEXCEPT {
  return max(Real(0.0f), Real(1.0f) - s2 * (Real(2.111f) + Real(1.709f) * s2));
}

/// Any wrap: the first five bands as SH give them, and above them the blurred kernel's, less and less the larger the
/// light,
///   h blurred(x) + sum_{l<5} (2l+1)/4 [f_l (2 k_l - h) - h blurBand_l s^2 (1 - 1.474 s^2)] P_l(x),
/// k_l the zonal factors of zonal.h.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_wrapCap(Real x, Real s, Real c, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  Real s2 = s * s;
  Real h = rigel_highBandShare(s2);
  Real blur = h * s2 * (Real(1.0f) - Real(1.474f) * s2);
  Real b0 = Real(wrap.f.x) * (Real(2.0f) / (Real(1.0f) + c) - h) - blur * Real(wrap.blurBand.x);
  Real b1 = Real(wrap.f.y) * (Real(1.0f) - h) - blur * Real(wrap.blurBand.y);
  Real b2 = Real(wrap.f.z) * (c - h) - blur * Real(wrap.blurBand.z);
  Real b3 = Real(wrap.f.w) * (Real(1.0f) - Real(1.25f) * s2 - h) - blur * Real(wrap.blurBand.w);
  Real b4 = Real(wrap.f4) * (c * (Real(1.0f) - Real(1.75f) * s2) - h) - blur * Real(wrap.blurBand4);
  Real q = x * x;
  // (2l+1)/4 P_l(x) by powers of x.
  Real e = Real(0.25f) * b0 - Real(0.625f) * b2 + Real(0.84375f) * b4 +
           q * (Real(1.875f) * b2 - Real(8.4375f) * b4 + q * (Real(9.84375f) * b4));
  e += x * (Real(0.75f) * b1 - Real(2.625f) * b3 + q * (Real(4.375f) * b3));
  if (!rigel_all(h <= Real(0.0f))) e += h * Real(wrap.gain) * rigel_blurredKernel(x, Real(wrap.blur) * s, wrap);
  // No cap gives more than the whole sphere: where it touches, held at both ends or E would jump on the way in.
  if (!rigel_all(h > Real(0.0f))) e = rigel_select(h > Real(0.0f), e, min(e, Real(wrap.f.x) / s2));
  return max(e, Real(0.0f));
}

/// The delta kernel less its own three bands.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_kernelAboveBand2(Real x, RIGEL_IN(GpuWrap) wrap) RIGEL_NOEXCEPT {
  Real kernel = max(x, Real(0.0f));
  if (wrap.a != 0.0f) kernel = rigel_blurredKernel(x, Real(0.0f), wrap);
  Real bands = Real(0.25f) * Real(wrap.f.x) + Real(0.75f) * Real(wrap.f.y) * x +
               Real(wrap.f.z) * (Real(1.875f) * x * x - Real(0.625f));
  return Real(wrap.gain) * kernel - bands;
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#endif

#endif
