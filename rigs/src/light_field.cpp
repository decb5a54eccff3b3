#include "light_field.h"

#include <rigel/project.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

// Where v and h change sign: c^2 = 1/3 and 6 c^4 - 5/2 c^2 - 1/2 = 0, as rho/r = 1/sqrt(1-c^2).
constexpr double kSlopeTurn = 1.224744871391589;
constexpr double kCurveTurn = 1.5150358561575787;

/// Largest of value * P2(x).
double largestP2(double value) noexcept { return std::max(value, -0.5 * value); }

/// Largest of e0 + e1 x + e2 P2(x), x in [-1, 1].
double largestOverNormals(double e0, double e1, double e2) noexcept {
  const double ends = e0 + e2 + std::abs(e1);
  if (e2 >= 0 || std::abs(e1) >= -3 * e2) return ends;
  return std::max(ends, e0 - 0.5 * e2 - e1 * e1 / (6 * e2));
}

}  // namespace

WrapField wrapField(float wrap) noexcept {
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  WrapField w;
  w.s0 = 0.5 * f[0];
  w.s1 = 1.5 * f[1];
  w.s2 = 2.5 * f[2];
  w.fullSphere = f[0];
  const double e0 = w.s0 / 2;
  const double e1 = w.s1 / 2;
  const double e2 = w.s2 / 2;
  const double peak = e0 + e1 + e2;
  w.across = std::sqrt((e1 + 3 * e2) * peak);
  w.lobe = std::max(0.0, -(e0 - 0.5 * e2 - e1 * e1 / (6 * e2))) / peak;

  // Inside, at distance r sqrt(1 - gamma^2) from the centre.
  constexpr int kSteps = 32;
  constexpr double kBetweenSteps = 1.002;
  for (int i = 0; i <= kSteps; ++i) {
    const double gamma = static_cast<double>(i) / kSteps;
    const double share = 1 - gamma * gamma;
    w.inside = std::max(w.inside, largestOverNormals(w.s0 * (1 + gamma), e1 * share, -e2 * gamma * share));
  }
  w.inside *= kBetweenSteps;
  return w;
}

double LightField::cosine(double rho) const noexcept { return std::sqrt((rho - r_) * (rho + r_)) / rho; }

LightField::Bands LightField::values(double rho) const noexcept {
  const double unit = a_ / (rho * rho);
  const double c = cosine(rho);
  return {unit * w_->s0 / (1 + c), unit * w_->s1 / 2, unit * w_->s2 * c / 2};
}

LightField::Bands LightField::radialSlopes(double rho) const noexcept {
  const double unit = a_ / (rho * rho * rho);
  const double c = cosine(rho);
  return {unit * w_->s0 / c, unit * w_->s1, unit * w_->s2 * (3 * c - 1 / c) / 2};
}

double LightField::peak(double rho) const noexcept {
  if (rho >= r_) {
    const Bands e = values(rho);
    return e.e0 + e.e1 + e.e2;
  }
  // Between the surface and rho: e0 grows inwards, e1 and |e2| shrink.
  const double share = rho / r_;
  const double gamma = std::sqrt(1 - share * share);
  return a_ / (r_ * r_) * std::min(w_->s0 * (1 + gamma) + w_->s1 / 2, w_->inside);
}

double LightField::exactPeak(double rho) const noexcept {
  // The kernel is at most 1, so irradiance is at most the solid angle times L, and never more than a full sphere's.
  if (rho < r_) return a_ / (r_ * r_) * w_->fullSphere;
  return a_ / (rho * rho) * std::min(2 / (1 + cosine(rho)), w_->fullSphere * (rho * rho) / (r_ * r_));
}

LightField::Slopes LightField::slopes(double rho) const noexcept {
  const double unit = a_ / (rho * rho);
  const double c = cosine(rho);
  const double v = (3 * c - 1 / c) / 2;
  const double h = 6 * c - (2.5 + 0.5 / (c * c)) / c;
  const auto& [s0, s1, s2, across, lobe, inside, fullSphere] = *w_;
  const double radial = s0 / c + s1 + s2 * largestP2(v);
  const double curve = s0 * (1 + 2 * c * c) / (c * c * c) + 3 * s1 + s2 * largestP2(h);
  const double rotation = s1 / 2 + 1.5 * s2 * c;
  return {unit * radial / rho, unit * std::max(across / c, radial / 2) / rho, unit * curve / (rho * rho),
          unit * (radial + rotation) / (rho * rho)};
}

double LightField::heldSlope(double rho) const noexcept {
  const double reach = std::max(rho, r_);
  // Inside, |c| grows again and the slope falls with the distance from the centre: largest at the surface.
  const double c = cosine(reach);
  const double held = std::max<double>(c, kMinGradientCosine);
  const double radial = w_->s0 / held + w_->s1 + w_->s2 * largestP2((3 * c * c - 1) / (2 * held));
  return a_ / (reach * reach * reach) * radial;
}

double LightField::change(double near, double far) const noexcept {
  // P = -e0' - e1' - e2' where v > 0, and -e0' - e1' + e2'/2 closer than that.
  const Bands a = values(near);
  const Bands b = values(far);
  const double turn = std::clamp(kSlopeTurn * r_, near, far);
  const double e2Turn = turn > near ? values(turn).e2 : a.e2;
  return (a.e0 - b.e0) + (a.e1 - b.e1) + 0.5 * (e2Turn - a.e2) + (e2Turn - b.e2);
}

double LightField::remainder(double near, double far) const noexcept {
  const double span = far - near;
  const Bands a = values(near);
  const Bands b = values(far);
  const Bands slope = radialSlopes(far);
  const double smooth = (a.e0 - b.e0 - span * slope.e0) + (a.e1 - b.e1 - span * slope.e1);
  // Band 2: h > 0 beyond the turn, closer h counts as -h/2.
  const double turn = std::clamp(kCurveTurn * r_, near, far);
  if (!(turn > near)) return smooth + (a.e2 - b.e2 - span * slope.e2);
  const Bands t = values(turn);
  const Bands tSlope = radialSlopes(turn);
  const double beyond = (t.e2 - b.e2 - (far - turn) * slope.e2) + (turn - near) * (tSlope.e2 - slope.e2);
  const double before = a.e2 - t.e2 - (turn - near) * tSlope.e2;
  return smooth + beyond - 0.5 * before;
}

double LightField::changeInside(double rho) const noexcept {
  const double share = std::min(rho / r_, 1.0);
  const double gamma = std::sqrt(1 - share * share);
  // gamma (1 - gamma^2) of band 2 rises to 0.385 at gamma = 0.577 and falls again; the turning of its axis adds as
  // much.
  const double band2 = 2 * std::min(gamma, 0.77);
  return a_ / (r_ * r_) * (w_->s0 * gamma + w_->s1 / 2 * gamma * gamma + w_->s2 / 2 * band2);
}

}  // namespace rigel
