// A disk light's bound: the error of a rig is linear in the light, so the theorems of light_bound.cpp hold for every
// emitter of the disk, and the sum over them is closed form (disk_field.h). At the disk's plane a one-sided field
// begins with a jump of its slope, and a two-sided one has a crease: chi |u.a| in direction u, a the axis, which a
// lattice of spacing D gets wrong by D/4 of it and a slope of reach H by H. Near the disk, where derivatives know
// nothing, the cap: ranges of the light over points and samples. For samples anywhere: sample_bound.cpp with the sphere
// that holds the disk, and the lobe.
#include <rigel/light_bound.h>
#include <rigel/project.h>

#include "disk_field.h"
#include "interpolation_bound.h"
#include "sample_bound.h"
#include "value_range.h"
#include "weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

using detail::BoundPlan;
using detail::SamplePlan;
using detail::SeenLight;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class DiskBound {
 public:
  DiskBound(const BoundPlan& plan, const SamplePlan& samples, const WrapField& wrap, const LightPlace& place,
            const Triple& axis, double radius, bool twoSided, const SeenLight* seen) noexcept
      : plan_(plan),
        samples_(samples),
        wrap_(wrap),
        place_(place),
        axis_(axis),
        seen_(seen),
        field_(wrap, radius, twoSided),
        served_(diskAspect(place.served, axis, radius, twoSided, kMargin * plan.radius)),
        nodes_(diskAspect(place.nodes, axis, radius, twoSided, kMargin * plan.radius)) {}

  LightBound operator()() noexcept {
    if (!(served_.share > 0)) return {0, 0, gap()};
    const double error = plan_.kind == BoundPlan::Kind::samples ? sampleError() : tensorError();
    const double vector = field_.vector(served_);
    const double peak = field_.perVector() * vector;
    const double whole = error + (kValueRounding + quadrature()) * plan_.lebesgue * peak;
    // Behind the plane there is no light, but an object that comes to it from there must be expected.
    const bool lit = served_.high > 0;
    return {heldBound(lit ? whole : served_.share * whole), lit ? heldBound(field_.exactPerVector() * vector) : 0,
            gap()};
  }

 private:
  // Of the object's radius: how far behind the plane its light is faded in.
  static constexpr double kMargin = 0.1;

  float gap() const noexcept {
    return plan_.radius > 0 ? static_cast<float>(served_.gap / plan_.radius) : LightBound().gap;
  }

  /// What `project` may be off by, relative to the peak (disk.h): it falls with the eighth power of the distance.
  double quadrature() const noexcept {
    constexpr double kAtTheRim = 1e-3;
    const double ratio = std::min(1.0, field_.radius() / served_.near);
    const double square = ratio * ratio;
    return kAtTheRim * square * square * square * square;
  }

  Range light(double vector) const noexcept { return {field_.lobe() * vector, field_.perVector() * vector}; }

  double sineTo(const Front& front) const noexcept {
    return std::sqrt(std::max(0.0, 1 - front.cosAxis * front.cosAxis));
  }
  DiskField::Means means(const Front& front) const noexcept { return field_.means(front.distance, sineTo(front)); }

  /// The slope jumps within the region,
  bool straddles() const noexcept { return served_.low < 0; }
  /// and at most over this height.
  double depth() const noexcept { return std::min(-served_.low, served_.high); }

  double tensorError() const noexcept {
    const double vector = field_.vector(nodes_);
    const Range rig = blended(light(vector), plan_.lebesgue);
    const double slopes = slopeRange(vector);
    const double cap = difference(light(field_.vector(served_)), {rig.down + slopes, rig.up + slopes});
    double plain = boxError();
    if (plan_.kind == BoundPlan::Kind::ball) plain = std::min(plain, ballError());
    // Slopes come in slowly at the plane (project.h).
    const double held = std::clamp(nodes_.cosine.lo / double{kMinGradientSine}, 0.0, 1.0);
    const double lost = plan_.numeric || !(held < 1) ? 0 : (1 - held) * slopes;
    return std::min(plain + secantError() + lost, cap);
  }

  /// What slopes add to the rig's values.
  double slopeRange(double vector) const noexcept {
    if (plan_.gradients == 0) return 0;
    const SlopeReach slopes = slopeReach(plan_);
    if (plan_.numeric) return slopes.halves * (field_.perVector() + field_.lobe()) * vector / (2 * kSecant);
    const double reach = plan_.kind == BoundPlan::Kind::ball ? plan_.radius : slopes.farthest;
    // No emitter is closer to a node than the disk's rim.
    const double clear = std::max(0.0, nodes_.near - field_.radius());
    const double cube = std::min(means(nodes_.front[0]).cube, 1 / (clear * clear * clear));
    const double smooth = field_.area() * field_.slope(nodes_.cosine) * cube;
    return nodes_.share * reach * std::min(smooth, field_.rimSlope(nodes_));
  }

  /// Over the box, from slopes and curvatures along its axes.
  double boxError() const noexcept {
    const DiskField::Means mean = means(served_.front[0]);
    if (!(mean.fourth < kInfinite)) return kInfinite;
    // Seen from other points of the disk the nearest point of the box is elsewhere.
    const double turn = field_.radius() / place_.served.box;
    double first = 0, second = 0, jump = 0, square = 0, alongAll = 0, alongEach = 0;
    for (int a = 0; a < 3; ++a) {
      const BoundPlan::Axis& axis = plan_.axis[a];
      const double w = place_.served.beyond[a] / place_.served.box;
      const double most = std::min(1.0, w + turn);
      if (axis.first > 0) first += axis.first * field_.slopeAlong(served_.cosine, std::clamp(w - turn, 0.0, 1.0), most);
      if (axis.second > 0) second += axis.second * field_.curvatureAlong(served_.cosine, most);
      jump += axis.kink * std::abs(axis_[a]);
      square += axis.gradient * axis.reach;
      alongAll += most * most;
      alongEach += axis.gradient * axis.reach * most * most;
    }
    if (square > 0) {
      // As in interpolation_bound.cpp.
      const double along = std::min(square * std::min(1.0, alongAll), plan_.gradients * alongEach);
      second += field_.curvature(served_.cosine, along, square) / 2;
    }
    return field_.area() * (first * mean.cube + second * mean.fourth) + creaseError(jump, mean);
  }

  double creaseError(double jump, const DiskField::Means& mean) const noexcept {
    if (!straddles() || !(jump > 0)) return 0;
    return std::min(jump, (1 + plan_.lebesgue) * depth()) * field_.kink() * mean.cube;
  }

  /// Over a ball about the only sample, as integrals along the radius towards the disk.
  double ballError() const noexcept {
    const double b = plan_.radius + place_.served.rounding;
    const double d = place_.served.centre;
    if (!(plan_.radius > 0)) return 0;
    const double sine = sineTo(served_.front[1]);
    const DiskField::Means near = field_.means(d - b, sine);
    if (!(near.fourth < kInfinite)) return kInfinite;
    const DiskField::Means far = field_.means(d, sine);
    // Far away the differences of nearly equal values lose their digits; the derivative at the near end is as good.
    constexpr double kFar = 1e-5;
    const bool distant = b < kFar * d;
    if (plan_.constant) {
      const double integral = distant ? b * near.cube : (near.square - far.square) / 2;
      return field_.area() * field_.slope(served_.cosine) * integral;
    }
    const double integral = distant ? b * b / 2 * near.fourth : (near.square - far.square - 2 * b * far.cube) / 6;
    return field_.area() * field_.curvature(served_.cosine) * integral + creaseError(b, near);
  }

  /// What secants in several directions add to the error of slopes.
  double secantError() const noexcept {
    if (!plan_.numeric || plan_.gradients < 2) return 0;
    const bool ball = nodes_.front[1].distance > nodes_.front[0].distance;
    const Front& front = nodes_.front[ball ? 1 : 0];
    const DiskField::Means mean = means(front);
    if (!(mean.fourth < kInfinite)) return kInfinite;
    const double nearest = front.distance - field_.radius() * sineTo(front);
    const double second = field_.area() * field_.curvature(served_.cosine) * mean.fourth;
    // Of emitters, whose lobes may be turned anywhere.
    constexpr ThirdDerivatives kEmitter{270, 24.0 * 24};
    const double third = field_.peakOfEmitter() * norm(kEmitter, plan_.gradients, place_.nodes);
    double jump = 0;
    for (int a = 0; a < 3; ++a) jump += plan_.axis[a].gradient * std::abs(axis_[a]);
    return secantReach(plan_, field_.area() * third * mean.fourth / nearest, second) + creaseError(jump, mean);
  }

  double sampleError() noexcept {
    const double error = plannedError();
    return seen_ ? std::min(error, seenError(*seen_, light(field_.vector(served_)), 0)) : error;
  }

  double plannedError() noexcept {
    // As strong as the disk, and around it.
    const LightField sphere(wrap_, field_.area(), field_.radius());
    const double corners = plan_.polynomial ? 0.0 : boxError();
    const SampleBound bound = sampleBound(plan_, samples_, wrap_, sphere, place_.position, place_.served.box, 0);
    const double boxVector = field_.vector(served_);
    served_.near = std::max({served_.near, bound.near, seen_ ? seen_->near : 0.0});
    const double enlarged = kDiskFootprint * bound.enlarged;
    const double peak = field_.perVector() * boxVector;
    const double span = difference(light(field_.vector(served_)), blended(light(boxVector), plan_.lebesgue));
    const double cap =
        std::min(span + plan_.offset * peak + enlarged, field_.perVector() * field_.vector(served_) + bound.cap);
    double error = field_.lobeStrength(served_.cosine) * bound.smooth + enlarged;
    if (straddles()) {
      const double sag = -served_.low * served_.high / (served_.high - served_.low) / 2;
      const double cube = means(served_.front[0]).cube;
      if (!(cube < kInfinite)) return cap;
      error += (1 + plan_.lebesgue) * sag * field_.kink() * cube;
    }
    if (!plan_.polynomial) error += (1 + plan_.lebesgue) * corners;
    return std::min(error, cap);
  }

  // What a disk loses by being as large as a footprint f, per its peak and (f / distance)^2.
  static constexpr double kDiskFootprint = 1.6;

  const BoundPlan& plan_;
  const SamplePlan& samples_;
  const WrapField& wrap_;
  const LightPlace& place_;
  const Triple& axis_;
  const SeenLight* seen_;
  DiskField field_;
  DiskAspect served_, nodes_;
};

}  // namespace

LightBound LightBounds::of(const DiskLight& light, const Seen* seen) const noexcept {
  const LightPlace place = placeOf(plan_, worldFromRig_, light.position);
  Triple direction;
  if (!place.valid || !(light.radius > 0) || !std::isfinite(light.radius) || !unitOf(light.direction, direction))
    return {};
  Triple axis = inRigFrame(worldFromRig_, direction);
  double height = 0;
  for (int a = 0; a < 3; ++a) height += place.served.towards[a] * axis[a];
  // Of two faces, that which looks at the object's centre.
  if (light.twoSided && height < 0)
    for (double& x : axis) x = -x;
  return DiskBound(plan_, samples_, wrap_, place, axis, light.radius, light.twoSided, seen)();
}

}  // namespace rigel
