// With M the light's window and cone, phi its irradiance without them for one normal, P the rig's operator (a sum of
// weighted samples), the error of the rig is (I - P)(M phi). It is at most the least of
//
//   cap       what M phi and P(M phi) can differ by, given the range of phi over points and samples
//   max(M) |(I - P) phi| + |(I - P)((M - max M) phi)|
//
// where |(I - P) phi| <= sum over axes of (H |d phi|, D^2/8 |d^2 phi|, H^2/2 |d^2 phi|) for (constant, lattice,
// gradient) axes: P is the product of the axes' operators, those of lattice and constant axes have norm 1
// (cubic: 1.25), and I - P1 P2 P3 = (I - P1) + P1 (I - P2) + P1 P2 (I - P3). Derivatives are those of light_field.h at
// the point of the box nearest to the light, where they are largest. Over a ball the sums become integrals along the
// radius towards the light, in closed form. Each of these is a theorem, not a fit.
#include <rigel/light_bound.h>

#include "bound_plan.h"
#include "light_field.h"
#include "modulation_bound.h"

#include "../../lights/src/vec3d.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

using detail::BoundPlan;
using detail::Vec3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Positions are floats: what their rounding and that of the projections can do, relative to the sizes involved and to
// the light's peak.
constexpr double kPositionRounding = 2.4e-7;
constexpr double kValueRounding = 1e-6;

/// Where a light is, seen from the object.
struct Place {
  std::array<double, 3> beyond{};  // from the box to the light along each axis
  double box = 0;                  // distance to the box
  double near = 0;                 // distance to the nearest point served, or less
  double far = 0;                  // to the farthest, or more
  double node = 0;                 // to the nearest sample, or less
  double centre = 0;               // to the box's centre
};

double norm(double x, double y, double z) noexcept { return std::sqrt(x * x + y * y + z * z); }

Place placeOf(const BoundPlan& plan, const std::array<double, 3>& light, double rounding) noexcept {
  Place place;
  std::array<double, 3> off{}, nodeOff{}, span{};
  for (int a = 0; a < 3; ++a) {
    const double x = std::abs(light[a] - plan.centre[a]);
    off[a] = x;
    place.beyond[a] = std::max(0.0, x - plan.axis[a].half);
    nodeOff[a] = std::max(0.0, x - plan.axis[a].node);
    span[a] = x + plan.axis[a].half;
  }
  const auto distance = [&](const std::array<double, 3>& v) { return norm(v[0], v[1], v[2]); };
  const auto less = [&](double x) { return std::max(0.0, x - rounding); };
  place.centre = distance(off);
  place.box = less(distance(place.beyond));
  place.near = std::max(place.box, less(place.centre - plan.radius));
  place.far = std::min(distance(span), place.centre + plan.radius) + rounding;
  place.node = less(distance(nodeOff));
  return place;
}

/// |(I - P) phi| over the box from the derivatives at its nearest point; `slope` and `curvature`: more of both, in all
/// directions.
double boxError(const BoundPlan& plan, const Place& place, const LightField& field, double most, double slope,
                double curvature) noexcept {
  const double g = place.box;
  if (!(g > field.radius())) return kInfinite;
  const LightField::Slopes s = field.slopes(g);
  double sum = 0;
  double gradientSquare = 0, alongAll = 0, alongEach = 0;
  int gradients = 0;
  const double inverse = 1 / (g * g);
  for (int a = 0; a < 3; ++a) {
    const BoundPlan::Axis& axis = plan.axis[a];
    const double w2 = std::min(1.0, place.beyond[a] * place.beyond[a] * inverse);
    if (axis.first > 0) {
      const double along = s.first * s.first * w2 + s.firstAcross * s.firstAcross * (1 - w2);
      sum += axis.first * (most * std::sqrt(along) + slope);
    }
    sum += axis.second * (most * (s.second * w2 + s.secondAcross * (1 - w2)) + curvature);
    if (axis.gradient > 0) {
      const double square = axis.gradient * axis.half;
      ++gradients;
      gradientSquare += square;
      alongAll += w2;
      alongEach += w2 * square;
    }
  }
  if (gradients == 0) return sum;
  // Taylor's remainder with the slopes at the node: delta^T H delta / 2, (delta . w)^2 by Cauchy's inequality.
  const double along = std::min(gradientSquare * std::min(1.0, alongAll), gradients * alongEach);
  return sum +
         (most * (s.secondAcross * gradientSquare + (s.second - s.secondAcross) * along) + curvature * gradientSquare) /
             2;
}

/// The same over a ball about the centre, for one sample at its centre with or without slopes.
double ballError(const BoundPlan& plan, const Place& place, const LightField& field, double cap) noexcept {
  const double b = plan.radius;
  const double d = place.centre;
  const double r = field.radius();
  const double clearance = d - r;
  if (!(clearance > 0) || !std::isfinite(d)) return cap;
  const double near = std::max(d - b, r);
  const double inside = d - b < r ? field.changeInside(std::max(0.0, d - b)) : 0.0;
  const double depth = d - near;
  // Differences of nearly equal values far away, where the derivative at the near end is as good.
  constexpr double kFar = 1e-5;
  const LightField::Slopes s = field.slopes(std::max(near, r * (1 + 1e-9)));
  double error;
  if (plan.constant) {
    error = inside + (depth < kFar * d ? depth * s.first : field.change(near, d));
  } else {
    const double held = field.heldSlope(d);
    const double lost = std::max(0.0, field.slopes(d).first - held);
    error = inside + (depth < kFar * d ? depth * depth / 2 * s.second : field.remainder(near, d)) + depth * lost +
            (b - depth) * held;
  }
  // A light about to swallow the centre: over to the cap, which holds inside too.
  const double share = std::min(1.0, 4 * clearance / b);
  return b > 0 ? cap + share * (std::min(error, cap) - cap) : 0.0;
}

/// What field and rig can differ by. Values lie between -lobe and 1 times the peak.
struct Caps {
  double error = 0;
  double slope = 0;  // sum over gradient axes of half extent times slope, per unit of slope
};

}  // namespace

LightBounds::LightBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap, float radius) noexcept
    : worldFromRig_(worldFromRig), wrap_(wrapField(wrap)), plan_(boundPlan(rig, radius)) {}

namespace {

double capOf(const BoundPlan& plan, const detail::WrapField& wrap, const Place& place, const LightField& field,
             double peak, double nodePeak) noexcept {
  double cap = plan.lebesgue > 1 ? (1 + plan.lebesgue) / 2 * (1 + wrap.lobe) * peak : peak + wrap.lobe * nodePeak;
  double gradients = 0;
  for (const BoundPlan::Axis& axis : plan.axis) gradients += axis.gradient;
  if (gradients > 0) {
    cap += plan.numeric
               ? gradients > 0
                     ? (1 + wrap.lobe) * nodePeak / (2 * 0.77459667) *
                           ((plan.axis[0].gradient > 0) + (plan.axis[1].gradient > 0) + (plan.axis[2].gradient > 0)) *
                           plan.lebesgue
                     : 0
               : gradients * field.heldSlope(place.node);
  }
  return cap;
}

/// More error of secants than of slopes: h^2/6 times the third derivative, or h/2 times the second.
double secantError(const BoundPlan& plan, const Place& place, const LightField& field, double curvature,
                   double most) noexcept {
  const double g = place.node;
  if (!(g > field.radius())) return kInfinite;
  const double c = std::sqrt((g - field.radius()) * (g + field.radius())) / g;
  const double third = 24 * field.peak(g) / (g * g * g) / (c * c * c * c * c);
  const double second = field.slopes(g).second;
  double sum = 0;
  for (const BoundPlan::Axis& axis : plan.axis) {
    const double h = axis.node;
    if (axis.gradient > 0)
      sum += axis.gradient * (most * std::min(h * h / 6 * third, h / 2 * second) + h / 2 * curvature);
  }
  return sum;
}

LightBound boundOf(const BoundPlan& plan, const detail::WrapField& wrap, const Place& place, const LightField& field,
                   const ModulationBound& m) noexcept {
  const double peak = field.peak(place.near);
  const double most = m.most;
  LightBound out;
  if (!(most > 0) || !(peak > 0)) return out;
  constexpr double kLargest = std::numeric_limits<float>::max();
  constexpr double kLeast = std::numeric_limits<float>::min();
  const auto held = [=](double x) { return static_cast<float>(std::clamp(x, kLeast, kLargest)); };
  out.peak = held(most * std::max(peak, field.exactPeak(place.near)));

  const double nodePeak = std::min(peak, field.peak(place.node));
  const double plainCap = capOf(plan, wrap, place, field, peak, nodePeak);
  double cap = most * plainCap;
  double error = plainCap;
  double vary = 0;
  if (plan.kind == BoundPlan::Kind::surface) {
    out.error = held(4 * cap);
    return out;
  }
  if (plan.kind == BoundPlan::Kind::ball) error = ballError(plan, place, field, plainCap);
  double secant = 0;
  if (plan.numeric) secant = secantError(plan, place, field, 0, 1);
  error = std::min(error + secant, std::min(plainCap, boxError(plan, place, field, 1, 0, 0) + secant));
  if (m.most > m.least) {
    double slopes = 0;
    if (!plan.numeric)
      for (const BoundPlan::Axis& axis : plan.axis) slopes += axis.gradient * nodePeak * m.slope;
    cap += slopes;
    const double swing = (m.most - m.least) * (plan.constant ? nodePeak : plainCap) + slopes;
    const double first = place.box > field.radius() ? field.slopes(place.box).first : kInfinite;
    double smooth = kInfinite;
    if (place.box > field.radius()) {
      const double curvature = 2 * m.slope * first + m.curvature * peak;
      smooth = boxError(plan, place, field, 0, m.slope * peak, curvature);
      if (plan.numeric) smooth += secantError(plan, place, field, curvature, 0);
    }
    vary = std::min(swing, smooth);
  }
  out.error = held(std::min(most * error + vary, cap) + kValueRounding * most * peak);
  return out;
}

/// In double: a light close to the object must not move by the rounding of far-away coordinates.
std::array<double, 3> inRigFrame(const RigFrame& frame, Vec3d v) noexcept {
  return {dot(detail::widen(frame.x), v), dot(detail::widen(frame.y), v), dot(detail::widen(frame.z), v)};
}

struct Local {
  Place place;
  std::array<double, 3> position;
  bool valid = false;
};

Local localOf(const BoundPlan& plan, const RigFrame& frame, Vec3 position) noexcept {
  Local local;
  const Vec3d offset = detail::widen(position) - detail::widen(frame.origin);
  local.position = inRigFrame(frame, offset);
  double size = plan.radius;
  for (int a = 0; a < 3; ++a)
    size = std::max({size, std::abs(static_cast<double>(position[a])), std::abs(static_cast<double>(frame.origin[a])),
                     std::abs(plan.centre[a])});
  local.place = placeOf(plan, local.position, kPositionRounding * size);
  local.valid = std::isfinite(local.place.centre);
  return local;
}

/// Cosines between the spot's axis and the directions to the points served.
Interval cosines(const BoundPlan& plan, const Local& local, const std::array<double, 3>& axis, double radius) noexcept {
  const Place& place = local.place;
  if (!(place.near > 0)) return {-1, 1};
  double middle = 0, reach = 0;
  for (int a = 0; a < 3; ++a) {
    middle += (plan.centre[a] - local.position[a]) * axis[a];
    reach += plan.axis[a].half * std::abs(axis[a]);
  }
  reach = std::min(reach, plan.radius);
  const double lo = middle - reach;
  const double hi = middle + reach;
  Interval out{std::max(-1.0, lo / (lo > 0 ? place.far : place.near)),
               std::min(1.0, hi / (hi > 0 ? place.near : place.far))};

  // The same from the cone that holds the ball; faded out before the light reaches the ball.
  const double sine = plan.radius / place.centre;
  if (sine < 1) {
    const double cosine = std::sqrt(1 - sine * sine);
    const double towards = std::clamp(middle / place.centre, -1.0, 1.0);
    const double across = std::sqrt(1 - towards * towards);
    const double fade = std::clamp((1 - sine) * 6, 0.0, 1.0);
    const double ballHi = towards >= cosine ? 1 : towards * cosine + across * sine;
    const double ballLo = -towards >= cosine ? -1 : towards * cosine - across * sine;
    out.hi = std::min(out.hi, 1 + fade * (ballHi - 1));
    out.lo = std::max(out.lo, -1 + fade * (ballLo + 1));
  }
  // Within the light the cosine shrinks to 0 at its centre.
  if (place.near < radius) {
    const double shrink = place.near / radius;
    out.lo = std::min(out.lo, out.lo * shrink);
    out.hi = std::max(out.hi, out.hi * shrink);
  }
  return {std::min(out.lo, out.hi), out.hi};
}

double pointRadius(float radius) noexcept { return std::max(radius, kMinPointRadius); }

}  // namespace

LightBound LightBounds::operator()(const DirectionalLight& light) const noexcept {
  const Vec3d axis = detail::directionOf(light.direction);
  if (detail::dot(axis, axis) == 0) return {};
  // Two and three bands of a delta: the SH peak, and the kernel's own 1.
  return {0, static_cast<float>(std::max(1.0, wrap_.s0 / 2 + wrap_.s1 / 2 + wrap_.s2 / 2))};
}

LightBound LightBounds::operator()(const PointLight& light) const noexcept {
  if (detail::anyNan(light.radius, light.range)) return {};
  const Local local = localOf(plan_, worldFromRig_, light.position);
  if (!local.valid) return {};
  const LightField field(wrap_, 1, pointRadius(light.radius));
  return boundOf(plan_, wrap_, local.place, field, windowBound(light.range, local.place.near, local.place.far));
}

LightBound LightBounds::operator()(const SpotLight& light) const noexcept {
  if (detail::anyNan(light.radius, light.range) || detail::anyNan(light.innerAngle, light.outerAngle)) return {};
  const Vec3d direction = detail::directionOf(light.direction);
  const Local local = localOf(plan_, worldFromRig_, light.position);
  if (!local.valid || detail::dot(direction, direction) == 0) return {};
  const double cosOuter = std::cos(static_cast<double>(light.outerAngle));
  const double width = std::max<double>(std::cos(static_cast<double>(light.innerAngle)) - cosOuter, kMinConeWidth);
  if (detail::anyNan(cosOuter, width)) return {};
  const double radius = pointRadius(light.radius);
  const LightField field(wrap_, 1, radius);
  const Interval cosine = cosines(plan_, local, inRigFrame(worldFromRig_, direction), radius);
  const ModulationBound window = windowBound(light.range, local.place.near, local.place.far);
  return boundOf(plan_, wrap_, local.place, field,
                 window * coneBound(cosOuter, width, cosine, local.place.near, radius));
}

LightBound LightBounds::operator()(const SphereLight& light) const noexcept {
  if (!(light.radius > 0)) return {};
  const Local local = localOf(plan_, worldFromRig_, light.position);
  if (!local.valid) return {};
  const double radius = light.radius;
  return boundOf(plan_, wrap_, local.place, LightField(wrap_, kPi * radius * radius, radius), {});
}

}  // namespace rigel
