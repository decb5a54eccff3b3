// Exact irradiance of sphere lights. A sphere seen from outside is a cap of directions of half-angle alpha about w;
// seen from inside (continuous extension) it is everything but such a cap about -w, so that
//
//   E_inside(x) = pi L f_0(a) - E_cap(-x),   x = n.w
//
// and only caps of alpha <= pi/2 are left: closed forms for a = 0 and a = 1, otherwise one integral over the angle
// theta from the normal,
//
//   E = L int f(cos theta) 2 A(theta) sin(theta) dtheta,
//
// A(theta) being half the arc of the circle at theta that lies in the cap.
#include <rigel/exact.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "local_light.h"
#include "quadrature.h"
#include "zonal.h"

namespace rigel {
namespace {

using detail::SphereView;
using detail::Vec3d;

/// A cap of directions and a normal: cosine and sine of the angle between axis and normal, sine and cosine of the cap's
/// half-angle.
struct Cap {
  double x = 0;
  double sinNormal = 0;
  double s = 0;
  double c = 1;
};

/// Lambert, per unit radiance: pi s^2 x where the whole cap is above the horizon, 0 where it is below, and between them
/// the clipped form of B. Snyder, "Area Light Sources for Real-Time Graphics", 1996, rearranged: with t = x/s,
/// z = sqrt(1-t^2), v = s z/c
///   E = s^3 t atan2(z, -c t) + s^2 v - (v - atan v),
/// in which all terms are of the size s^3, whereas the published terms of size s cancel.
double lambertCap(const Cap& cap) noexcept {
  const double s = cap.s;
  if (cap.x >= s) return kPi * s * s * cap.x;
  if (cap.x <= -s) return 0;
  const double t = cap.x / s;
  const double z = std::sqrt((1 - t) * (1 + t));
  const double arc = s * s * s * t * std::atan2(z, -cap.c * t);
  const double sz = s * z;
  if (sz > 0.1 * cap.c) return std::max(0.0, arc - sz * cap.c + std::atan2(sz, cap.c));
  const double v = sz / cap.c;
  const double q = v * v;
  // (v - atan v) / v; the last term kept is 1e-16 of the first at v = 0.1.
  const double tail =
      q * (1.0 / 3 -
           q * (1.0 / 5 - q * (1.0 / 7 - q * (1.0 / 9 - q * (1.0 / 11 - q * (1.0 / 13 - q * (1.0 / 15 - q / 17)))))));
  return std::max(0.0, arc + v * (s * s - tail));
}

/// Half-Lambert, ((x+1)/2)^2: three bands hold it exactly, E = (pi/2) sum (2l+1) f_l g_l P_l(x). Any view, inside too.
double halfLambert(const SphereView& view, double x) noexcept {
  double k[3];
  detail::zonalFactors<3>(view.s2, view.c, view.inside, k);
  const double share = view.capSolidAngleShare();
  return share * (kPi / 2) * (4.0 / 3 * k[0] + 2 * k[1] * x + 2.0 / 3 * k[2] * (1.5 * x * x - 0.5));
}

/// Kernel and cap in the angle theta from the normal, for 0 < |a| < 1.
class WrapCap {
 public:
  WrapCap(const Cap& cap, double a) noexcept
      : a_(a),
        normalTheta_(std::atan2(cap.sinNormal, cap.x)),
        alpha_(std::atan2(cap.s, cap.c)),
        horizon_(std::acos(-a)),
        sinHalfAlpha_(std::sin(0.5 * alpha_)),
        peak_(kPi * cap.s * cap.s) {}

  double irradiance() const noexcept { return whole() + ring(); }

 private:
  // 2 pi int_{cos theta <= u} f = kFull (u+a)^(2+a).
  double antiderivativeScale() const noexcept { return 2 * kPi / ((2 + a_) * std::pow(1 + a_, 1 + a_)); }

  /// The circles that lie in the cap as a whole: those about the normal or about its antipode.
  double whole() const noexcept {
    double sum = 0;
    if (alpha_ > normalTheta_) {
      const double theta = std::min(alpha_ - normalTheta_, horizon_);
      const double sine = std::sin(0.5 * theta);
      const double drop = std::min(1.0, 2 * sine * sine / (1 + a_));  // 1 - (cos theta + a)/(1 + a)
      const double scale = 2 * kPi * (1 + a_) / (2 + a_);
      sum += drop < 1 ? -scale * std::expm1((2 + a_) * std::log1p(-drop)) : scale;
    }
    const double nearAntipode = 2 * kPi - normalTheta_ - alpha_;
    if (nearAntipode < horizon_) {
      sum += antiderivativeScale() * std::pow(std::max(0.0, std::cos(nearAntipode) + a_), 2 + a_);
    }
    return sum;
  }

  /// The circles that cross the rim of the cap. theta = mid + half sin(phi) removes the square roots of A at both ends.
  double ring() const noexcept {
    const bool holdsNormal = normalTheta_ < alpha_;
    const bool holdsAntipode = normalTheta_ + alpha_ > kPi;
    const double mid = holdsNormal ? alpha_ : holdsAntipode ? kPi - alpha_ : normalTheta_;
    const double half = holdsNormal ? normalTheta_ : holdsAntipode ? kPi - normalTheta_ : alpha_;
    if (!(half > 0) || mid - half >= horizon_) return 0;
    // theta - normalTheta is formed from its parts: theta would round away all digits of a tiny light.
    const double offset = mid - normalTheta_;
    const auto integrand = [&](double phi) noexcept {
      return atOffset(offset + half * std::sin(phi)) * half * std::cos(phi);
    };
    const double tolerance = kTolerance * peak_;
    const double top = 0.5 * kPi;
    if (mid + half <= horizon_) {
      if (!holdsNormal && !holdsAntipode) {
        // A vanishes as cos(phi) at both ends, so that the integrand continues to a smooth periodic function.
        const std::optional<double> sum = detail::integratePeriodic(integrand, -top, top, tolerance);
        if (sum) return *sum;
      }
      return detail::integrateAdaptive(integrand, -top, top, tolerance);
    }

    // Towards the horizon the kernel is (horizon - theta)^(1+a), a power that is no whole number: phi = end - width u^3
    // smooths it.
    const double end = std::asin(std::clamp((horizon_ - mid) / half, -1.0, 1.0));
    const double width = end + top;
    const auto graded = [&](double u) noexcept { return integrand(end - width * u * u * u) * 3 * width * u * u; };
    return detail::integrateAdaptive(graded, 0.0, 1.0, tolerance);
  }

  /// f(cos theta) 2 A(theta) sin(theta) at theta = normalTheta + delta.
  double atOffset(double delta) const noexcept {
    const double theta = normalTheta_ + delta;
    const double kernel = wrapKernel(std::cos(theta), a_);
    if (!(kernel > 0)) return 0;
    // Half-angle formula of the spherical triangle with the sides alpha, theta, normalTheta, its four sines paired:
    // tan^2(A/2) = (sin^2(alpha/2) - sin^2((theta-normalTheta)/2)) / (sin^2((theta+normalTheta)/2) - sin^2(alpha/2)).
    const double difference = std::sin(0.5 * delta);
    const double sum = std::sin(0.5 * (theta + normalTheta_));
    const double above = (sinHalfAlpha_ - difference) * (sinHalfAlpha_ + difference);
    const double below = (sum - sinHalfAlpha_) * (sum + sinHalfAlpha_);
    const double halfArc = 2 * std::atan2(std::sqrt(std::max(0.0, above)), std::sqrt(std::max(0.0, below)));
    return 2 * halfArc * kernel * std::sin(theta);
  }

  static constexpr double kTolerance = 1e-9;  // of the peak pi s^2

  double a_;
  double normalTheta_;
  double alpha_;
  double horizon_;
  double sinHalfAlpha_;
  double peak_;
};

double capIrradiance(const Cap& cap, double a) noexcept {
  return a == 0 ? lambertCap(cap) : WrapCap(cap, a).irradiance();
}

/// Irradiance per unit radiance at unit normal `n`.
double sphereIrradiance(const SphereView& view, Vec3d n, double a) noexcept {
  const double x = std::clamp(detail::dot(n, view.w), -1.0, 1.0);
  if (a == 1) return halfLambert(view, x);
  const Vec3d side = detail::cross(n, view.w);
  const Cap cap{view.inside ? -x : x, std::sqrt(detail::dot(side, side)), std::sqrt(view.s2), std::abs(view.c)};
  const double capped = capIrradiance(cap, a);
  return view.inside ? std::max(0.0, kPi * 2 * (1 + a) / (2 + a) - capped) : capped;
}

/// Irradiance of a point, spot or sphere light of the given colour.
RgbD localIrradiance(const detail::LocalTerm& term, Rgb colour, Vec3 n, float wrap) noexcept {
  const Vec3d normal = detail::directionOf(n);
  if (!term.view.valid || !(term.modulation.value > 0) || detail::dot(normal, normal) == 0) return {};
  const double perRadiance = sphereIrradiance(term.view, normal, clampWrap(wrap));
  const double perFlux = perRadiance / (2 * kPi * term.view.capSolidAngleShare());
  const double scale = term.fluxScale * term.modulation.value * perFlux;
  return {colour.r * scale, colour.g * scale, colour.b * scale};
}

}  // namespace

RgbD exactIrradiance(const DirectionalLight& light, Vec3, Vec3 n, float wrap) noexcept {
  if (detail::anyNan(light.direction) || detail::anyNan(light.irradiance)) return {};
  const Vec3d normal = detail::directionOf(n);
  const Vec3d direction = detail::directionOf(light.direction);
  if (detail::dot(normal, normal) == 0 || detail::dot(direction, direction) == 0) return {};
  return light.irradiance * wrapKernel(std::min(1.0, -detail::dot(normal, direction)), clampWrap(wrap));
}

RgbD exactIrradiance(const PointLight& light, Vec3 p, Vec3 n, float wrap) noexcept {
  return localIrradiance(detail::localTerm(light, p), light.intensity, n, wrap);
}

RgbD exactIrradiance(const SpotLight& light, Vec3 p, Vec3 n, float wrap) noexcept {
  return localIrradiance(detail::localTerm(light, p), light.intensity, n, wrap);
}

RgbD exactIrradiance(const SphereLight& light, Vec3 p, Vec3 n, float wrap) noexcept {
  return localIrradiance(detail::localTerm(light, p), light.radiance, n, wrap);
}

RgbD exactIrradiance(const LightSet& lights, Vec3 p, Vec3 n, float wrap) noexcept {
  RgbD sum;
  for (int i = 0; i < lights.directionalCount(); ++i) sum += exactIrradiance(lights.directional(i), p, n, wrap);
  for (int i = 0; i < lights.pointCount(); ++i) sum += exactIrradiance(lights.point(i), p, n, wrap);
  for (int i = 0; i < lights.spotCount(); ++i) sum += exactIrradiance(lights.spot(i), p, n, wrap);
  for (int i = 0; i < lights.sphereCount(); ++i) sum += exactIrradiance(lights.sphere(i), p, n, wrap);
  for (int i = 0; i < lights.diskCount(); ++i) sum += exactIrradiance(lights.disk(i), p, n, wrap);
  return sum;
}

}  // namespace rigel
