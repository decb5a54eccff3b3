#include "light_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

constexpr double kPositionRounding = 2.4e-7;  // relative to the largest size involved: two float roundings

double dotOf(const Triple& a, const Triple& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double lengthOf(const Triple& v) noexcept { return std::sqrt(dotOf(v, v)); }

Region regionOf(const Triple& towards, const Triple& half, double radius, double rounding) noexcept {
  Region region{towards, half, radius};
  Triple span{};
  for (int a = 0; a < 3; ++a) {
    const double x = std::abs(towards[a]);
    region.beyond[a] = std::max(0.0, x - half[a]);
    span[a] = x + half[a];
  }
  region.centre = lengthOf(towards);
  region.box = std::max(0.0, lengthOf(region.beyond) - rounding);
  region.near = std::max(region.box, region.centre - radius - rounding);
  region.rounding = rounding;
  region.far = std::min(lengthOf(span), region.centre + radius) + rounding;
  return region;
}

/// From the light to the nearest node of a lattice about the centre.
double nodeDistance(const detail::BoundPlan& plan, const Triple& towards) noexcept {
  Triple offset = towards;
  for (int a = 0; a < 3; ++a) {
    const detail::BoundPlan::Axis& axis = plan.axis[a];
    if (!(axis.spacing > 0)) continue;
    const double last = std::round(2 * axis.node / axis.spacing);
    const double nearest = std::clamp(std::round((towards[a] + axis.node) / axis.spacing), 0.0, last);
    offset[a] += axis.node - nearest * axis.spacing;
  }
  return lengthOf(offset);
}

/// Cosine of max(0, alpha - beta), from the cosines of both.
double cosineOfLess(double alpha, double beta) noexcept {
  if (alpha >= beta) return 1;
  return alpha * beta + std::sqrt(std::max(0.0, (1 - alpha * alpha) * (1 - beta * beta)));
}

/// Cosines of directions within the angle `beta` of one that is `alpha` from the axis.
Interval within(double alpha, double beta) noexcept { return {-cosineOfLess(-alpha, beta), cosineOfLess(alpha, beta)}; }

void narrow(Interval& interval, const Interval& by) noexcept {
  interval.lo = std::max(interval.lo, by.lo);
  interval.hi = std::min(interval.hi, by.hi);
}

/// Cosine between `axis` and the direction from the light to the box along `a`.
double cosineAlong(const Region& region, const Triple& axis, int a) noexcept {
  return std::clamp(region.towards[a] > 0 ? axis[a] : -axis[a], -1.0, 1.0);
}

}  // namespace

bool unitOf(Vec3 v, Triple& unit) noexcept {
  const Triple wide{v.x, v.y, v.z};
  const double length = lengthOf(wide);
  if (!(length > 0) || !std::isfinite(length)) return false;
  for (int a = 0; a < 3; ++a) unit[a] = wide[a] / length;
  return true;
}

Triple inRigFrame(const RigFrame& frame, const Triple& v) noexcept {
  const auto along = [&](Vec3 axis) { return dotOf({axis.x, axis.y, axis.z}, v); };
  return {along(frame.x), along(frame.y), along(frame.z)};
}

LightPlace placeOf(const detail::BoundPlan& plan, const RigFrame& frame, Vec3 position) noexcept {
  LightPlace place;
  Triple offset{}, half{}, node{}, towards{};
  double size = plan.radius;
  for (int a = 0; a < 3; ++a) {
    const double world = position[a];
    const double origin = frame.origin[a];
    offset[a] = world - origin;
    half[a] = plan.axis[a].half;
    node[a] = plan.axis[a].node;
    size = std::max({size, std::abs(world), std::abs(origin), std::abs(plan.centre[a])});
  }
  place.position = inRigFrame(frame, offset);
  for (int a = 0; a < 3; ++a) towards[a] = plan.centre[a] - place.position[a];
  place.served = regionOf(towards, half, plan.radius, kPositionRounding * size);
  place.nodes = regionOf(towards, node, plan.nodeRadius, kPositionRounding * size);
  const bool lattice = std::ranges::any_of(plan.axis, [](const auto& axis) { return axis.spacing > 0; });
  if (lattice) place.nodes.near = std::max(place.nodes.near, nodeDistance(plan, towards) - 2 * place.nodes.rounding);
  place.valid = std::isfinite(place.served.centre);
  return place;
}

Interval cosines(const Region& region, const Triple& axis, double radius) noexcept {
  Interval out;
  if (!(region.near > 0)) return out;
  // Along the axis the region lies between two planes.
  const double middle = dotOf(region.towards, axis);
  double reach = 0;
  for (int a = 0; a < 3; ++a) reach += region.half[a] * std::abs(axis[a]);
  reach = std::min(reach, region.radius);
  const double lo = middle - reach;
  const double hi = middle + reach;
  narrow(out, {lo / (lo > 0 ? region.far : region.near), hi / (hi > 0 ? region.near : region.far)});

  // It lies behind the faces of the box that look at the light.
  for (int a = 0; a < 3; ++a)
    if (region.beyond[a] > 0) narrow(out, within(cosineAlong(region, axis, a), region.beyond[a] / region.far));

  // It lies in the cone about its ball. That opens to a half space as the light reaches the ball, and to everything
  // within: fade it out before.
  const double diagonal = lengthOf(region.half);
  const double sine = std::min(region.radius, diagonal) / region.centre;
  if (sine < 1) {
    const Interval ball = within(std::clamp(middle / region.centre, -1.0, 1.0), std::sqrt(1 - sine * sine));
    const double fade = std::min(1.0, 6 * (1 - sine));
    narrow(out, {-1 + fade * (ball.lo + 1), 1 + fade * (ball.hi - 1)});
  }
  // Within the light the cosine shrinks to 0 at its centre.
  if (region.near < radius) {
    const double shrink = region.near / radius;
    out = {std::min(out.lo, out.lo * shrink), std::max(out.hi, out.hi * shrink)};
  }
  return {std::min(out.lo, out.hi), out.hi};
}

Front frontOf(const Region& region, const Triple& axis) noexcept {
  double dot = 0, square = 0;
  for (int a = 0; a < 3; ++a) {
    dot += region.beyond[a] * (region.towards[a] > 0 ? axis[a] : -axis[a]);
    square += region.beyond[a] * region.beyond[a];
  }
  return {square > 0 ? dot / std::sqrt(square) : 1, region.box, region.far, false};
}

Front frontOfBall(const Region& region, const Triple& axis) noexcept {
  const double ball = region.radius + region.rounding;
  return {dotOf(region.towards, axis) / region.centre, region.centre - ball, region.centre + ball, true};
}

double litDistance(const Region& region, const Triple& axis, double cosOuter) noexcept {
  double distance = region.near;
  for (int a = 0; a < 3; ++a) {
    if (!(region.beyond[a] > 0)) continue;
    const double steepest = cosineOfLess(cosineAlong(region, axis, a), cosOuter);
    const double least = std::max(0.0, region.beyond[a] - region.rounding);
    distance = std::max(distance, steepest > 0 ? least / steepest : std::numeric_limits<double>::infinity());
  }
  return distance;
}

}  // namespace rigel
