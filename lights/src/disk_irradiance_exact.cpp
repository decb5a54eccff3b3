// Exact irradiance of disk lights. In the bisector frame (shader_disk.h) the rim is seen in the directions
//
//   w(psi) = (sx cos psi, sy sin psi, cx q),   q^2 = cos^2 psi + u^2 sin^2 psi,   u^2 = 1 - t^2,
//
// and n . (w x dw) = [sx sy nz - (sy cx nx cos psi + sx cx u^2 ny sin psi)/q] dpsi =: k dpsi.
//
// Lambert: half the integral of k over the visible part of the rim and of the horizon between its ends (Lambert 1760).
// Any kernel f: about the normal dw = dx dphi, x = n.w, so that by Green's theorem the integral of f over the disk is
// that of G(x) dphi along its rim, G(x) = int_x^1 f, and dphi = k/(1-x^2) dpsi. As it stands that is singular where the
// rim passes -n, and wrong where the disk holds -n. So the mean of the kernel F/2, F = G(-1), is taken out, the
// integral of which is the solid angle:
//
//   E = F/2 sx sy int dpsi/(1 + cx q) + int M(x) k dpsi,   M(x) = [G(x) - F (1-x)/2] / (1-x^2),
//
// M smooth on all of [-1, 1] but for the horizon x = -a, where it goes on as (x+a)^(2+a).
#include <rigel/exact.h>
#include <rigel/shader_disk_view.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrature.h"
#include "vec3d.h"

namespace rigel {
namespace {

using detail::Vec3d;

/// A disk as a receiver sees it, in the bisector frame: its cone and the unit normal.
struct DiskPose {
  double sx = 0, cx = 1, sy = 0, cy = 1;
  double t = 0, u = 1;
  double nx = 0, ny = 0, nz = 0;  // |nx|, |ny|: the cone is symmetric
  bool lit = false;
};

double square(double x) noexcept { return x * x; }

DiskPose poseOf(const DiskLight& light, Vec3 p, Vec3d n) noexcept {
  DiskPose pose;
  const Vec3d toCentre = detail::widen(light.position) - detail::widen(p);
  const double radius = std::min<double>(light.radius, std::numeric_limits<float>::max());
  const double distance2 = detail::dot(toCentre, toCentre);
  // Farther than 1e40 radii nothing is left of any radiance that float holds.
  if (!(radius > 0) || !std::isfinite(distance2) || std::sqrt(distance2) > 1e40 * radius) return pose;
  const Vec3d v = toCentre * (1 / radius);
  const Vec3d axis = detail::directionOf(light.direction);
  const auto place =
      detail::diskPlace(v.x, v.y, v.z, axis.x, axis.y, axis.z, detail::dot(v, axis), light.twoSided ? -1.0 : 0.0);
  if (!(place.z > 0)) return pose;
  const auto view = detail::diskView(place, (place.rho - 1) * (place.rho + 1) + place.z * place.z);
  const detail::DiskCone<double>& cone = view.cone;
  pose = {cone.sx, cone.cx, cone.sy, cone.cy, cone.t, cone.u};
  pose.nx = std::abs(detail::dot(n, {view.xx, view.xy, view.xz}));
  pose.ny = std::abs(detail::dot(n, {view.yx, view.yy, view.yz}));
  pose.nz = detail::dot(n, {view.zx, view.zy, view.zz});
  pose.lit = view.flux > 0;
  return pose;
}

/// (x - atan x) / x^3; to 1e-16 of it.
double atanRest(double x) noexcept {
  if (x > 0.1) return (x - std::atan(x)) / (x * x * x);
  const double q = x * x;
  return 1.0 / 3 - q * (1.0 / 5 - q * (1.0 / 7 - q * (1.0 / 9 - q * (1.0 / 11 - q * (1.0 / 13 - q / 15)))));
}

/// (atanh y - y) / y^3 for y = (q-p)/(q+p): near the rim y rounds to 1, p keeps its digits.
double atanhRest(double y, double p, double q) noexcept {
  if (y > 0.1) return (0.5 * std::log(q / std::max(p, 1e-300)) - y) / (y * y * y);
  const double square = y * y;
  return 1.0 / 3 +
         square * (1.0 / 5 +
                   square * (1.0 / 7 + square * (1.0 / 9 + square * (1.0 / 11 + square * (1.0 / 13 + square / 15)))));
}

/// Lambert per unit radiance, clipped at the horizon; derived in shader_disk_irradiance.h.
double lambertDisk(const DiskPose& d) noexcept {
  // The horizon cuts the rim at f0 -+ phi, f the rim's angle in (sx u cos f, sy sin f, cx u).
  const double ex = d.sx * d.u * d.nx;
  const double ey = d.sy * d.ny;
  const double ez = d.cy * d.nz;
  const double a = std::hypot(ex, ey);
  if (ez >= a) return kPi * d.sx * d.sy * d.nz;
  if (ez <= -a) return 0;
  const double cosF = ex / a;
  const double sinF = ey / a;
  const double cosPhi = -ez / a;
  const double sinPhi = std::sqrt((a - ez) * (a + ez)) / a;

  const double t2 = d.t * d.t;
  const double u2 = d.u * d.u;
  const double ss = (sinF * cosPhi - cosF * sinPhi) * (sinF * cosPhi + cosF * sinPhi);
  const double cc = (cosF * cosPhi - sinF * sinPhi) * (cosF * cosPhi + sinF * sinPhi);
  const double tau = t2 * sinPhi * sinPhi;
  const double atX = u2 + t2 * ss;
  const double p = u2 * cosF * cosF + square(sinF - d.t * sinPhi);
  const double q = u2 * cosF * cosF + square(sinF + d.t * sinPhi);
  const double atY = 0.5 * (p + q);
  const double atHorizon = u2 * (d.cx * d.cx + d.sx * d.sx * cc) + d.sy * d.sy * ss;
  const double horizon = 2 * sinPhi * d.sx * d.u * d.sy * d.cy / a;
  const double x = 2 * d.u * sinPhi * cosF;
  const double y = 2 * sinPhi * sinF / atY;

  const double half = std::atan2(2 * d.u * sinPhi * std::abs(cosPhi), u2 * cc + ss);
  const double arc = d.sx * d.sy * d.nz * (cosPhi > 0 ? half : 2 * kPi - half);
  const double scaleX = d.sy * d.cx * d.nx;
  const double scaleY = d.sx * d.cx * u2 * d.ny;
  const double restY = scaleY * y * square(d.t * y) * atanhRest(d.t * y, p, q);
  if (horizon < atHorizon && d.t * x < atX) {
    const double v = horizon / atHorizon;
    const double perX = x / atX;
    const double leading =
        horizon / atX * (2 * square(d.sx * d.u * sinPhi) / atHorizon + square(d.nz) + 2 * tau * square(d.ny) / atY);
    const double rest = scaleX * perX * square(d.t * perX) * atanRest(d.t * perX) - v * v * v * atanRest(v) - restY;
    return std::max(0.0, 0.5 * (arc + leading + rest));
  }
  const double sidePerT = d.t > 0 ? std::atan2(d.t * x, atX) / d.t : x / atX;
  const double angles = std::atan2(horizon, atHorizon) - scaleX * sidePerT;
  return std::max(0.0, 0.5 * (arc + angles - scaleY * y - restY));
}

/// The kernel's integral over the contour for any a.
class WrapContour {
 public:
  WrapContour(const DiskPose& pose, double a) noexcept
      : d_(pose), a_(a), whole_((1 + a) / (2 + a)), power_(2 + a), tolerance_(toleranceOf(pose)) {}

  double irradiance() const noexcept {
    if (d_.sy < kSmall) return flat();
    double cuts[2 * kSamples];
    const int count = horizonCuts(cuts);
    return std::max(0.0, count > 0 ? pieces(cuts, count) : wholeRim());
  }

 private:
  /// A light so small that it is flat: the integral over an ellipse in slices of equal x.
  double flat() const noexcept {
    const double width = std::hypot(d_.sx * d_.nx, d_.sy * d_.ny);
    const auto slice = [&](double phi) noexcept {
      return wrapKernel(d_.nz + width * std::sin(phi), a_) * square(std::cos(phi));
    };
    const double top = kPi / 2;
    return 2 * d_.sx * d_.sy * detail::integrateAdaptive(slice, -top, top, kTolerance, kMaxDepth);
  }

  /// Both quarters of the rim that the mirror planes leave, and their images.
  double wholeRim() const noexcept {
    const auto folded = [&](double psi) noexcept {
      const Rim rim = rimAt(psi);
      const double x = d_.sx * rim.cosine * d_.nx;
      const double y = d_.sy * rim.sine * d_.ny;
      return 4 * rim.whole + bend(rim.level + x + y) * (rim.kz - rim.kx - rim.ky) +
             bend(rim.level + x - y) * (rim.kz - rim.kx + rim.ky) +
             bend(rim.level - x + y) * (rim.kz + rim.kx - rim.ky) +
             bend(rim.level - x - y) * (rim.kz + rim.kx + rim.ky);
    };
    const double quarter = 0.5 * kPi;
    const double ends = 0.5 * (folded(0.0) + folded(quarter));
    if (const auto sum = detail::integratePeriodic(folded, 0.0, quarter, tolerance_, ends)) return *sum;
    return detail::integrateAdaptive(folded, 0.0, quarter, tolerance_, kMaxDepth);
  }

  /// Cut where the horizon crosses the rim, where the integrand has a kink: psi moves away from there as the cube.
  double pieces(const double* cuts, int count) const noexcept {
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double lo = cuts[i];
      const double width = (i + 1 < count ? cuts[i + 1] : cuts[0] + 2 * kPi) - lo;
      const auto graded = [&](double v) noexcept {
        const double psi = lo + width * v * v * v * (10 + v * (6 * v - 15));
        const Rim rim = rimAt(psi);
        const double x = rim.level + d_.sx * rim.cosine * d_.nx + d_.sy * rim.sine * d_.ny;
        return (rim.whole + bend(x) * (rim.kz - rim.kx - rim.ky)) * width * 30 * square(v * (1 - v));
      };
      sum += detail::integrateAdaptive(graded, 0.0, 0.5, tolerance_, kMaxDepth) +
             detail::integrateAdaptive(graded, 0.5, 1.0, tolerance_, kMaxDepth);
    }
    return sum;
  }

  /// psi where x = -a, ascending.
  int horizonCuts(double* cuts) const noexcept {
    const auto above = [&](double psi) noexcept {
      const double c = std::cos(psi);
      const double s = std::sin(psi);
      return d_.cx * std::sqrt(c * c + square(d_.u * s)) * d_.nz + d_.sx * c * d_.nx + d_.sy * s * d_.ny + a_;
    };
    const double step = 2 * kPi / kSamples;
    double sample[kSamples + 2];
    for (int i = 0; i < kSamples + 2; ++i) sample[i] = above(i * step);
    int count = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double lo = sample[i];
      const double mid = sample[i + 1];
      const double hi = sample[i + 2];
      if ((lo > 0) != (mid > 0)) {
        cuts[count++] = rootBetween(above, i * step, lo, (i + 1) * step, mid);
        continue;
      }
      // Towards the horizon and back: perhaps across it in between.
      if ((mid > 0) != (hi > 0) || std::abs(mid) > std::min(std::abs(lo), std::abs(hi))) continue;
      const double tip = extremumBetween(above, i * step, (i + 2) * step, mid > 0);
      const double atTip = above(tip);
      if ((atTip > 0) == (mid > 0)) continue;
      cuts[count++] = rootBetween(above, i * step, lo, tip, atTip);
      cuts[count++] = rootBetween(above, tip, atTip, (i + 2) * step, hi);
    }
    return count;
  }

  /// Where f is least, or greatest, by the golden section.
  template <class Function>
  static double extremumBetween(const Function& f, double lo, double hi, bool least) noexcept {
    constexpr double kGolden = 0.6180339887498949;
    const double sign = least ? 1 : -1;
    double a = hi - kGolden * (hi - lo);
    double b = lo + kGolden * (hi - lo);
    double atA = sign * f(a);
    double atB = sign * f(b);
    for (int i = 0; i < 24; ++i) {
      if (atA < atB) {
        hi = b;
        b = a;
        atB = atA;
        a = hi - kGolden * (hi - lo);
        atA = sign * f(a);
      } else {
        lo = a;
        a = b;
        atA = atB;
        b = lo + kGolden * (hi - lo);
        atB = sign * f(b);
      }
    }
    return atA < atB ? a : b;
  }

  /// The regula falsi, an end that stays put counting half (Illinois).
  template <class Function>
  static double rootBetween(const Function& f, double lo, double atLo, double hi, double atHi) noexcept {
    double root = 0.5 * (lo + hi);
    int side = 0;
    for (int i = 0; i < 40 && std::abs(hi - lo) > 1e-14; ++i) {
      root = (lo * atHi - hi * atLo) / (atHi - atLo);
      const double value = f(root);
      if (value == 0) break;
      if ((value > 0) == (atHi > 0)) {
        hi = root;
        atHi = value;
        if (side < 0) atLo *= 0.5;
        side = -1;
      } else {
        lo = root;
        atLo = value;
        if (side > 0) atHi *= 0.5;
        side = 1;
      }
    }
    return root;
  }

  /// What the integrand has at w(psi): `whole` is F/2 of the solid angle's, k = kz - kx - ky, level = cx q nz.
  struct Rim {
    double cosine, sine, level, whole, kx, ky, kz;
  };

  Rim rimAt(double psi) const noexcept {
    Rim rim;
    rim.cosine = std::cos(psi);
    rim.sine = std::sin(psi);
    const double q = std::sqrt(square(rim.cosine) + square(d_.u * rim.sine));
    const double perQ = q > 0 ? 1 / q : 0;
    rim.level = d_.cx * q * d_.nz;
    rim.whole = 0.5 * whole_ * d_.sx * d_.sy / (1 + d_.cx * q);
    rim.kx = d_.sy * d_.cx * d_.nx * rim.cosine * perQ;
    rim.ky = d_.sx * d_.cx * square(d_.u) * d_.ny * rim.sine * perQ;
    rim.kz = d_.sx * d_.sy * d_.nz;
    return rim;
  }

  /// M(x).
  double bend(double x) const noexcept {
    if (x <= -a_) return 0.5 * whole_ / (1 - x);
    const double drop = std::max(0.0, (1 - x) / (1 + a_));
    if (x > 0) {
      const double perDrop = drop > 0 ? -std::expm1(power_ * std::log1p(-drop)) / drop : power_;
      return whole_ * (perDrop / (1 + a_) - 0.5) / (1 + x);
    }
    const double below = std::pow((x + a_) / (1 + a_), power_);
    return whole_ * (0.5 - (below > 0 ? below / (1 + x) : 0)) / (1 - x);
  }

  /// Of the peak pi sx sy, for each panel; of a sliver, whose integrand is much larger than it, what its rounding
  /// leaves.
  static double toleranceOf(const DiskPose& d) noexcept {
    return std::max(kTolerance * kPi * d.sx * d.sy, 1e-14 * (d.sy * d.cx * d.nx + d.sx * d.ny));
  }

  static constexpr double kTolerance = 1e-10;
  static constexpr double kSmall = 1e-5;
  static constexpr int kMaxDepth = 24;
  static constexpr int kSamples = 16;

  DiskPose d_;
  double a_;
  double whole_;  // F
  double power_;
  double tolerance_;
};

}  // namespace

RgbD exactIrradiance(const DiskLight& light, Vec3 p, Vec3 n, float wrap) noexcept {
  const Vec3d normal = detail::directionOf(n);
  if (detail::dot(normal, normal) == 0 || detail::anyNan(light.radiance)) return {};
  const DiskPose pose = poseOf(light, p, normal);
  if (!pose.lit) return {};
  const double a = clampWrap(wrap);
  return light.radiance * (a == 0 ? lambertDisk(pose) : WrapContour(pose, a).irradiance());
}

}  // namespace rigel
