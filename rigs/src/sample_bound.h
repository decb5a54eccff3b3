// The error of rigs that sample values anywhere (poly, rbf, @lsq, @gauss), about one light without window and cone.
#pragma once

#include "light_field.h"
#include "value_range.h"

#include <span>

namespace rigel {

struct SampleBound {
  double near = 0;      // distance to the nearest point served, or less
  double error = 0;     // of footprints and of the distance between light and span, times the rig's own amplification
  double smooth = 0;    // its part without footprints and `boxError`
  double enlarged = 0;  // sum of weights times power / distance^4 times (footprint^2 - radius^2)
  double cap = 0;       // largest value of the rig
};

/// `light`: its position in the rig frame. `box`: distance to the box; `boxError`: |(I - P) phi| of the same axes with
/// samples at their corners, for rigs that span no polynomials.
SampleBound sampleBound(const detail::BoundPlan& plan, const detail::SamplePlan& samples, const WrapField& wrap,
                        const LightField& field, const std::array<double, 3>& light, double box,
                        double boxError) noexcept;

namespace detail {

/// One of many points at which a rig is compared with a light. [W/m2], largest over all normals, or
/// more.
struct SeenPoint {
  float error = 0;         // |rig - light|
  float down = 0, up = 0;  // the rig's values are between -down and up
  float crease = 0;        // of a disk: what the bend of its light at its plane adds about the point
  float close = 0;         // spacing of the points over the distance to the light's surface, held to 1
};

/// What a rig makes of one light at points that it serves.
struct SeenLight {
  std::span<const SeenPoint> points;
  double between = 1;  // how much larger than at the points errors and values can be between them
  double spacing = 0;  // m; nothing served is farther from all of the points
  double near = 0;     // m from the light's centre to the nearest point served, or less
  double missing = 0;  // [W/m2] what the rig lacks of its samples' light in what the points hold
};

}  // namespace detail

/// Of a rig that has been compared with the light at points. `light`: of its values at points served; `variation`: what
/// window and cone can do between the points.
double seenError(const detail::SeenLight& seen, Range light, double variation) noexcept;

}  // namespace rigel
