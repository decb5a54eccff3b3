#include "interpolation_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {

using detail::BoundPlan;

double boxError(const BoundPlan& plan, const Region& served, const LightField& field) noexcept {
  const double g = served.box;
  if (!(g > field.radius())) return std::numeric_limits<double>::infinity();
  const LightField::Slopes s = field.slopes(g);
  double sum = 0, square = 0, alongAll = 0, alongEach = 0;
  int gradients = 0;
  for (int a = 0; a < 3; ++a) {
    const BoundPlan::Axis& axis = plan.axis[a];
    const double w = served.beyond[a] / g;
    const double w2 = std::min(1.0, w * w);
    if (axis.first > 0)
      sum += axis.first * std::sqrt(s.first * s.first * w2 + s.firstAcross * s.firstAcross * (1 - w2));
    sum += axis.second * (s.second * w2 + s.secondAcross * (1 - w2));
    if (axis.gradient > 0) {
      ++gradients;
      square += axis.gradient * axis.half;
      alongAll += w2;
      alongEach += axis.gradient * axis.half * w2;
    }
  }
  if (gradients == 0) return sum;
  // Taylor's remainder, delta^T H delta / 2 <= (A (delta.w)^2 + B (delta^2 - (delta.w)^2)) / 2, with Cauchy's
  // inequality for (delta.w)^2. Secants along a single axis do no worse: their Peano kernel is positive.
  const double along = std::min(square * std::min(1.0, alongAll), gradients * alongEach);
  return sum + (s.secondAcross * square + (s.second - s.secondAcross) * along) / 2;
}

double boxError(const BoundPlan& plan, const Roughness& roughness) noexcept {
  double sum = 0;
  for (const BoundPlan::Axis& axis : plan.axis)
    sum += axis.first * roughness.slope + (axis.second + axis.gradient * axis.half / 2) * roughness.curvature;
  if (plan.numeric && plan.gradients > 1)
    for (const BoundPlan::Axis& axis : plan.axis)
      if (axis.gradient > 0) sum += axis.gradient * axis.node / 2 * roughness.curvature;
  return sum;
}

double ballError(const BoundPlan& plan, const Region& served, const LightField& field, double cap) noexcept {
  const double b = plan.radius + served.rounding;
  const double d = served.centre;
  const double r = field.radius();
  const double clearance = d - r;
  if (!(plan.radius > 0)) return 0;
  if (!(clearance > 0)) return cap;
  const double near = std::max(d - b, r);
  const double depth = d - near;
  // Far away the differences of nearly equal values lose their digits; the derivative at the near end is as good there.
  constexpr double kFar = 1e-5;
  const bool far = depth < kFar * d;
  double error = d - b < r ? field.changeInside(std::max(0.0, d - b)) : 0.0;
  if (plan.constant) {
    error += far ? depth * field.slopes(near).first : field.change(near, d);
  } else {
    const double held = field.heldSlope(d);
    error += far ? depth * depth / 2 * field.slopes(near).second : field.remainder(near, d);
    error += depth * std::max(0.0, field.slopes(d).first - held) + (b - depth) * held;
  }
  const double share = std::min(1.0, 4 * clearance / b);
  return cap + share * (std::min(error, cap) - cap);
}

double secantError(const BoundPlan& plan, const Region& nodes, const LightField& field) noexcept {
  if (!plan.numeric || plan.gradients < 2) return 0;
  const double g = nodes.near;
  if (!(g > field.radius())) return std::numeric_limits<double>::infinity();
  // The slopes are off by h^2/6 times the third derivative, and by h/2 times the second. 1/c^5: how the third grows
  // towards a sphere, from 24 E/g^3 of a small light.
  const double c = std::sqrt((g - field.radius()) * (g + field.radius())) / g;
  const double third = 24 * field.peak(g) / (g * g * g * c * c * c * c * c);
  const double second = field.slopes(g).second;
  double sum = 0;
  for (const BoundPlan::Axis& axis : plan.axis)
    if (axis.gradient > 0) sum += axis.gradient * std::min(axis.node * axis.node / 6 * third, axis.node / 2 * second);
  return sum;
}

SlopeReach slopeReach(const BoundPlan& plan) noexcept {
  SlopeReach reach;
  double square = 0;
  for (const BoundPlan::Axis& axis : plan.axis) {
    if (!(axis.gradient > 0)) continue;
    reach.halves += axis.gradient / axis.half;
    square += axis.gradient * axis.gradient;
  }
  reach.farthest = std::sqrt(square);
  return reach;
}

}  // namespace rigel
