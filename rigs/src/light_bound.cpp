// With M the light's window and cone, phi its irradiance without them for one normal and P the rig's operator (a sum of
// weighted samples), the error of the rig is (I - P)(M phi). It is at most the least of
//
//   cap                                        what M phi and P(M phi) can differ by, given their ranges
//   m |(I - P) phi| + |(I - P)((M - m) phi)|   m a constant
//
// For samples at the corners or the centre of a box, |(I - P) phi| <= sum over axes of (H |d phi|, D^2/8 |d^2 phi|,
// H^2/2 |d^2 phi|) for (constant, lattice, gradient) axes: P is the product of the axes' operators, those of lattice
// and constant axes have norm 1 (cubic 1.25), and I - P1 P2 P3 = (I - P1) + P1 (I - P2) + P1 P2 (I - P3). Derivatives
// are those of light_field.h at the point of the box nearest to the light, where they are largest. Over a ball the sums
// become integrals along the radius towards the light, in closed form. All this is theorem, not fit. For samples
// anywhere, sample_bound.cpp.
#include <rigel/light_bound.h>

#include "bound_plan.h"
#include "cone_sweep.h"
#include "interpolation_bound.h"
#include "modulation_bound.h"
#include "sample_bound.h"
#include "value_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rigel {
namespace {

using detail::BoundPlan;
using detail::SamplePlan;
using detail::SeenLight;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class Bound {
 public:
  Bound(const BoundPlan& plan, const SamplePlan& samples, const WrapField& wrap, const LightPlace& place,
        const LightField& field, const SeenLight* seen) noexcept
      : plan_(plan),
        samples_(samples),
        wrap_(wrap),
        served_(place.served),
        nodes_(place.nodes),
        field_(field),
        seen_(seen) {
    position_ = place.position;
    near_ = served_.near;
    nodePeak_ = field.peak(nodes_.near);
  }

  /// `served`, `nodes`: the modulation over points and samples. `lit`: distance to the nearest point that it lights.
  /// `cone`, `fronts`: of a spot whose light varies over the object, and what it faces.
  LightBound operator()(const ModulationBound& served, const ModulationBound& nodes, double lit,
                        const SpotCone* cone = nullptr, std::span<const Front> fronts = {}) noexcept {
    LightBound out;
    if (!(served.most > 0)) return out;
    const double error = plan_.kind == BoundPlan::Kind::samples ? sampleError(served, lit)
                                                                : tensorError(served, nodes, lit, cone, fronts);
    const double reach = std::max(lit, near_);
    const double peak = field_.peak(reach);
    out.peak = heldBound(served.most * std::max(peak, field_.exactPeak(reach)));
    out.error = heldBound(error + kValueRounding * plan_.lebesgue * served.most * peak);
    return out;
  }

 private:
  Range light(double peak) const noexcept { return {wrap_.lobe * peak, peak}; }

  /// What slopes add to the rig's values where the light is modulated by up to `most` with slope `slope` at the nodes.
  double slopeRange(double most, double slope) const noexcept {
    if (plan_.gradients == 0) return 0;
    const SlopeReach slopes = slopeReach(plan_);
    if (plan_.numeric) return slopes.halves * most * (1 + wrap_.lobe) * nodePeak_ / (2 * kSecant);
    const bool ball = plan_.kind == BoundPlan::Kind::ball;
    const double reach = ball ? ballRadius() : slopes.farthest;
    return reach * (most * heldSlope() + slope * nodePeak_);
  }

  /// Of one sample the slope is known at its very distance; within the light it falls to 0 at the centre.
  double heldSlope() const noexcept {
    const double slope = field_.heldSlope(nodes_.near);
    const bool one = plan_.kind == BoundPlan::Kind::ball;
    return one && nodes_.far < field_.radius() ? slope * nodes_.far / field_.radius() : slope;
  }

  double tensorError(const ModulationBound& m, const ModulationBound& n, double lit, const SpotCone* cone,
                     std::span<const Front> fronts) const noexcept {
    const Range plainLight = light(field_.peak(near_));
    const double plainCap = difference(plainLight, rigRange(nodePeak_, slopeRange(1, 0)));
    const double secant = secantError(plan_, nodes_, field_);
    double plain = boxError(plan_, served_, field_);
    if (plan_.kind == BoundPlan::Kind::ball) plain = std::min(plain, ballError(plan_, served_, field_, plainCap));
    plain = std::min(plain + secant, plainCap);
    if (!(m.least < 1)) return plain;

    const double cap = difference(light(m.most * field_.peak(std::max(lit, near_))),
                                  rigRange(n.most * nodePeak_, slopeRange(n.most, n.slope)));
    double error = std::min(
        {cap, n.most * plain + swing(m, n, plainLight.up), m.most * plain + smoothVariation(m), centred(m, n, plain)});
    for (const Front& front : fronts) {
      // Comes in as the light goes out of what it faces.
      if (!(front.distance > 0)) continue;
      const double share = std::min(1.0, 2 * front.distance / field_.radius());
      error += share * (std::min(error, sweptError(ConeSweep(field_, *cone, front), n, plain, error)) - error);
    }
    return error;
  }

  /// From functions of window and cone swept over the region; no less than `enough` where that is all there is to know.
  double sweptError(const ConeSweep& sweep, const ModulationBound& n, double plain, double enough) const noexcept {
    const double peak = sweep.peak();
    const Range rig = rigRange(std::min(peak, n.most * nodePeak_), slopeRange(n.most, n.slope));
    const double error = difference(light(peak), rig);
    if (n.most * plain >= std::min(error, enough)) return error;
    const bool centred = plan_.kind == BoundPlan::Kind::ball && !plan_.numeric;
    return std::min(error, n.most * plain + (centred ? sweptVariation(sweep, n) : sweptSwing(sweep, n)));
  }

  /// Of the rig's values, from the largest at its samples and what slopes add.
  Range rigRange(double peak, double slopes) const noexcept {
    const Range values = blended(light(peak), plan_.lebesgue);
    return {values.down + slopes, values.up + slopes};
  }

  double ballRadius() const noexcept { return plan_.radius + served_.rounding; }

  /// (M - M(c)) phi - slopes of M, c the only sample.
  double sweptVariation(const ConeSweep& sweep, const ModulationBound& n) const noexcept {
    const double slopes = plan_.constant ? 0 : ballRadius() * n.slope * nodePeak_;
    return std::max(sweep.above(n.least), sweep.below(n.most)) + slopes;
  }

  /// |(I - P)((M - m) phi)|, m the largest M at the samples.
  double sweptSwing(const ConeSweep& sweep, const ModulationBound& n) const noexcept {
    return rest(n, sweep.above(n.most), sweep.below(n.most));
  }

  /// The same from the largest (M - m) phi and (m - M) phi.
  double rest(const ModulationBound& n, double above, double below) const noexcept {
    const double swung = n.most - n.least;
    const Range points{std::max(below, wrap_.lobe * above), std::max(above, wrap_.lobe * below)};
    Range rig = blended({swung * nodePeak_, swung * wrap_.lobe * nodePeak_}, plan_.lebesgue);
    const double slopes = slopeRange(swung, n.slope);
    return difference(points, {rig.down + slopes, rig.up + slopes});
  }

  /// From the ranges.
  double swing(const ModulationBound& m, const ModulationBound& n, double peak) const noexcept {
    return rest(n, peak * std::max(0.0, m.most - n.most), peak * std::max(0.0, n.most - m.least));
  }

  /// The same from slope and curvature of M, m the largest M.
  double smoothVariation(const ModulationBound& m) const noexcept {
    if (!(served_.box > field_.radius())) return kInfinite;
    const double first = field_.slopes(served_.box).first;
    const double peak = field_.peak(served_.box);
    return boxError(plan_, Roughness{m.slope * peak, 2 * m.slope * first + m.curvature * peak});
  }

  /// For one sample at the centre c, from
  ///   M phi - P(M phi) = M(c) (phi - P phi) + phi(c) (M - P M) + (M - M(c)) (phi - phi(c)) with slopes,
  ///                      M (phi - phi(c)) + phi(c) (M - M(c)) without.
  double centred(const ModulationBound& m, const ModulationBound& n, double plain) const noexcept {
    if (plan_.kind != BoundPlan::Kind::ball || plan_.numeric) return kInfinite;
    const double off = std::max(m.most - n.least, n.most - m.least);
    if (plan_.constant) return m.most * plain + nodePeak_ * off;
    const double b = ballRadius();
    const double remainder = std::min(b * b / 2 * m.curvature, off + b * n.slope);
    const double start = served_.centre - b;
    const double change = start > field_.radius() ? field_.change(start, served_.centre) : kInfinite;
    const double swing = (1 + wrap_.lobe) * field_.peak(near_);
    return n.most * plain + nodePeak_ * remainder + off * std::min(change, swing);
  }

  double sampleError(const ModulationBound& m, double lit) noexcept {
    const double corners = plan_.polynomial ? 0.0 : boxError(plan_, served_, field_);
    const SampleBound bound = sampleBound(plan_, samples_, wrap_, field_, position_, served_.box, corners);
    near_ = std::max({near_, bound.near, seen_ ? seen_->near : 0.0});
    const double boxPeak = field_.peak(served_.box);
    const double span =
        difference(light(field_.peak(near_)), blended(light(boxPeak), plan_.lebesgue)) + plan_.offset * boxPeak;
    const double peak = field_.peak(std::max(lit, near_));
    const double cap = std::min(span, peak + bound.cap);
    const double plain = std::min(bound.error, cap);
    double error = plain;
    if (m.least < 1)
      error = std::min(m.most * plain + std::min((m.most - m.least) * cap, linearVariation(m)), m.most * cap);
    return seen_ ? std::min(error, seenError(*seen_, light(m.most * peak), peak * unseenVariation(m))) : error;
  }

  /// What the modulation can do between the points seen.
  double unseenVariation(const ModulationBound& m) const noexcept {
    const double h = seen_->spacing;
    const double close = near_ > h ? h / near_ : 1.0;
    return std::min(m.most - m.least, h * (2 * close * m.slope + h / 2 * m.curvature));
  }

  /// The same as smoothVariation for rigs that span linear functions: Taylor's remainder at the centre of the box.
  double linearVariation(const ModulationBound& m) const noexcept {
    if (!plan_.linear || !(served_.box > field_.radius())) return kInfinite;
    const double curvature = 2 * m.slope * field_.slopes(served_.box).first + m.curvature * field_.peak(served_.box);
    double square = 0;
    for (const BoundPlan::Axis& axis : plan_.axis) square += axis.half * axis.half;
    return (1 + plan_.lebesgue) * square / 2 * curvature;
  }

  const BoundPlan& plan_;
  const SamplePlan& samples_;
  const WrapField& wrap_;
  const Region& served_;
  const Region& nodes_;
  const LightField& field_;
  const SeenLight* seen_;
  Triple position_;
  double near_;
  double nodePeak_;
};

template <class... Floats>
bool anyNan(Floats... values) noexcept {
  return ((values != values) || ...);
}

double pointRadius(float radius) noexcept { return std::max(radius, kMinPointRadius); }

}  // namespace

LightBounds::LightBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap, float radius) noexcept
    : worldFromRig_(worldFromRig), wrap_(wrapField(wrap)), plan_(boundPlan(rig, radius, samples_)) {}

LightBound LightBounds::operator()(const DirectionalLight& light) const noexcept {
  Triple axis;
  if (!unitOf(light.direction, axis)) return {};
  // The kernel's own largest value, and that of its three bands.
  return {0, static_cast<float>(std::max(1.0, (wrap_.s0 + wrap_.s1 + wrap_.s2) / 2))};
}

LightBound LightBounds::of(const PointLight& light, const Seen* seen) const noexcept {
  const LightPlace place = placeOf(plan_, worldFromRig_, light.position);
  if (!place.valid || anyNan(light.radius, light.range)) return {};
  const LightField field(wrap_, 1, pointRadius(light.radius));
  Bound bound(plan_, samples_, wrap_, place, field, seen);
  return bound(windowBound(light.range, place.served.near, place.served.far),
               windowBound(light.range, place.nodes.near, place.nodes.far), place.served.near);
}

LightBound LightBounds::of(const SpotLight& light, const Seen* seen) const noexcept {
  const LightPlace place = placeOf(plan_, worldFromRig_, light.position);
  Triple direction;
  const double cosOuter = std::cos(static_cast<double>(light.outerAngle));
  const double width = std::max<double>(std::cos(static_cast<double>(light.innerAngle)) - cosOuter, kMinConeWidth);
  if (!place.valid || anyNan(light.radius, light.range) || anyNan(cosOuter, width)) return {};
  if (!unitOf(light.direction, direction)) return {};
  const Triple axis = inRigFrame(worldFromRig_, direction);
  const double radius = pointRadius(light.radius);
  const LightField field(wrap_, 1, radius);

  // The part of the region within the cone may be farther than its nearest point, or beyond its end: fade out there.
  const double lit = litDistance(place.served, axis, cosOuter);
  constexpr double kFade = 0.05;
  const double beyond = lit / place.served.far - 1;
  if (!(beyond < kFade)) return {};
  const auto over = [&](const Region& region, double near) {
    // A sample's footprint acts as a larger radius.
    const double size = std::max(radius, static_cast<double>(samples_.footprint));
    return windowBound(light.range, near, region.far) *
           coneBound(cosOuter, width, cosines(region, axis, size), near, radius);
  };
  ModulationBound served = over(place.served, lit);
  if (beyond > 0) served.most *= 1 - beyond / kFade;
  Bound bound(plan_, samples_, wrap_, place, field, seen);
  const ModulationBound nodes = over(place.nodes, place.nodes.near);
  if (plan_.kind == BoundPlan::Kind::samples || !(served.least < 1)) return bound(served, nodes, lit);
  const SpotCone cone{light.range, cosOuter, width, cosines(place.served, axis, radius)};
  const std::array fronts{frontOf(place.served, axis), frontOfBall(place.served, axis)};
  const bool knowsBall = plan_.kind == BoundPlan::Kind::ball;
  return bound(served, nodes, lit, &cone, std::span(fronts).first(knowsBall ? 2 : 1));
}

LightBound LightBounds::of(const SphereLight& light, const Seen* seen) const noexcept {
  const LightPlace place = placeOf(plan_, worldFromRig_, light.position);
  if (!place.valid || !(light.radius > 0)) return {};
  const double radius = light.radius;
  const LightField field(wrap_, kPi * radius * radius, radius);
  Bound bound(plan_, samples_, wrap_, place, field, seen);
  return bound({}, {}, place.served.near);
}

}  // namespace rigel
