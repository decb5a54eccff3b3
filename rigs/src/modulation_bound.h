// Between which values a light's range window and spot cone vary over an object, and how fast.
#pragma once

#include "light_place.h"

#include <algorithm>
#include <cmath>

namespace rigel {

/// Over a region: smallest and largest value, largest slope [1/m] and curvature [1/m2] in any direction.
struct ModulationBound {
  double least = 1, most = 1;
  double slope = 0, curvature = 0;
};

/// Of the product of two factors.
inline ModulationBound operator*(const ModulationBound& a, const ModulationBound& b) noexcept {
  return {a.least * b.least, a.most * b.most, a.slope * b.most + a.most * b.slope,
          a.curvature * b.most + 2 * a.slope * b.slope + a.most * b.curvature};
}

/// clamp(1-(d/R)^4, 0, 1)^2 over distances from near to far.
inline ModulationBound windowBound(double range, double near, double far) noexcept {
  if (!(range > 0)) return {0, 0, 0, 0};
  if (range == static_cast<double>(kNoRange)) return {};
  const auto factor = [](double x) { return 1 - x * x * x * x; };
  const double x0 = std::min(near / range, 1.0);
  const double x1 = std::min(far / range, 1.0);
  // Slope 8 x^3 (1 - x^4) / R, largest at x^4 = 3/7. Curvature, radial: 8 x^2 |7 x^4 - 3| / R^2, which has a local
  // maximum of 6.05 at x = .61; across: slope / d, less than 3.08 / R^2.
  constexpr double kSteepest = 0.8091067115702212;
  constexpr double kSlope = 2.4214, kCurve = 6.06;
  const auto slopeAt = [&](double x) { return 8 * x * x * x * factor(x); };
  const double slope = x1 < kSteepest ? slopeAt(x1) : x0 > kSteepest ? slopeAt(x0) : kSlope;
  const double square = x1 * x1;
  const double curve = std::max(std::min(24 * square, kCurve), 8 * square * (7 * square * square - 3));
  const double most = factor(x0);
  const double least = factor(x1);
  return {least * least, most * most, slope / range, curve / (range * range)};
}

/// smoothstep((cosine - outer) / width) where the cosine lies in `cosine`, at distances of at least `near` from the
/// centre of a light of that radius.
inline ModulationBound coneBound(double cosOuter, double width, Interval cosine, double near, double radius) noexcept {
  const auto ramp = [&](double x) { return std::clamp((x - cosOuter) / width, 0.0, 1.0); };
  const double t0 = ramp(cosine.lo);
  const double t1 = ramp(cosine.hi);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double steepest = std::clamp(0.5, t0, t1);
  const double slope = 6 * steepest * (1 - steepest) / width;
  const double curve = 6 * std::max(std::abs(1 - 2 * t0), std::abs(1 - 2 * t1)) / (width * width);

  // Slope of the cosine: sine / distance; of its second derivative the norm is at most 2/sqrt(3) / distance^2. Inside
  // the light the cosine is along the axis / radius.
  const double from = std::max(cosine.lo, cosOuter);
  const double flattest = std::clamp(0.0, from, std::max(from, std::min(cosine.hi, cosOuter + width)));
  const double sine = std::max(std::sqrt(std::max(0.0, 1 - flattest * flattest)), std::min(1.0, radius / near));
  const double reach = std::max(near, radius);
  const double perMetre = sine / reach;
  return {smooth(t0), smooth(t1), slope * perMetre, curve * perMetre * perMetre + slope * 1.1548 / (reach * reach)};
}

}  // namespace rigel
