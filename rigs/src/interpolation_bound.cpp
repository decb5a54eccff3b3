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
      square += axis.gradient * axis.reach;
      alongAll += w2;
      alongEach += axis.gradient * axis.reach * w2;
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
    sum += axis.first * roughness.slope + (axis.second + axis.gradient * axis.reach / 2) * roughness.curvature;
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
  // 1/c^5: how the third grows towards a sphere, from that of a small light.
  const double c = std::sqrt((g - field.radius()) * (g + field.radius())) / g;
  constexpr ThirdDerivatives kSmall{120, 24.0 * 24};
  const double third = norm(kSmall, plan.gradients, nodes) * field.peak(g) / (g * g * g * c * c * c * c * c);
  return secantReach(plan, third, field.slopes(g).second);
}

double norm(const ThirdDerivatives& squares, int axes, const Region& nodes) noexcept {
  // Along each axis where it is steepest: squares of cosines that sum to 1 at the centre, and to more nearer by.
  const double ratio = nodes.centre / nodes.near;
  const double along = std::min<double>(axes, ratio * ratio);
  return std::sqrt(axes * squares.across + (squares.along - squares.across) * along);
}

double secantReach(const BoundPlan& plan, double third, double second) noexcept {
  // Slopes along an axis are off by h^2/6 times the third derivative, and by h/2 times the second.
  double square = 0, sum = 0, longest = 0;
  for (const BoundPlan::Axis& axis : plan.axis) {
    if (!(axis.gradient > 0)) continue;
    const double cube = axis.gradient * axis.node * axis.node;
    square += cube * cube;
    sum += axis.gradient * axis.node;
    longest = std::max(longest, axis.node);
  }
  const double box = std::min(std::sqrt(square) * third / 6, sum * second / 2);
  if (plan.kind != BoundPlan::Kind::ball) return box;
  // Over a ball all components of the way from its centre cannot be largest at once.
  const double ball = plan.radius * longest * std::min(longest * third / 6, std::sqrt(plan.gradients) * second / 2);
  return std::min(box, ball);
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
