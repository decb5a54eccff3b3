// Where a light is, seen from the points that a rig serves and from its samples.
#pragma once

#include <rigel/light_bound.h>

namespace rigel {

using Triple = std::array<double, 3>;

/// A box, cut by a ball about its centre, as a light sees it.
struct Region {
  Triple towards{};  // from the light to the centre
  Triple half{};
  double radius = 0;
  Triple beyond{};    // from the box's nearest face to the light, along each axis
  double centre = 0;  // distances: to the centre,
  double box = 0;     // to the box, or less,
  double near = 0;    // to the nearest point, or less,
  double far = 0;     // to the farthest, or more
  double rounding = 0;
};

struct LightPlace {
  Triple position{};  // in the rig frame
  Region served;
  Region nodes;  // of the rig's samples
  bool valid = false;
};

/// In double: a light that touches the object must not move by the rounding of far-away coordinates. Distances are
/// shortened (near) or lengthened (far) by what the rounding of float positions can do.
LightPlace placeOf(const detail::BoundPlan& plan, const RigFrame& worldFromRig, Vec3 position) noexcept;

/// Unit vector; false where it has no direction.
bool unitOf(Vec3 v, Triple& unit) noexcept;

Triple inRigFrame(const RigFrame& worldFromRig, const Triple& vector) noexcept;

struct Interval {
  double lo = -1, hi = 1;
};

/// Cosines between `axis` (unit, rig frame) and the directions from a light of that radius to the region.
Interval cosines(const Region& region, const Triple& axis, double radius) noexcept;

/// What the light faces: a region that looks the same all around the direction to its nearest point. `distance` is not
/// positive where the light is inside.
struct Front {
  double cosAxis = 1;   // between `axis` and that direction
  double distance = 0;  // to the nearest point
  double far = 0;       // to the farthest
  bool ball = false;    // or all beyond the plane through the nearest point
};

/// The half space beyond the nearest point of the region's box.
Front frontOf(const Region& region, const Triple& axis) noexcept;
/// The region's ball.
Front frontOfBall(const Region& region, const Triple& axis) noexcept;

/// Distance to the nearest point of the region within the cone about `axis`, or less; infinite where the cone misses it
/// for certain.
double litDistance(const Region& region, const Triple& axis, double cosOuter) noexcept;

}  // namespace rigel
