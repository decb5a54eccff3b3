// The error of rigs that sample values anywhere (poly, rbf, @lsq, @gauss), about one light without window and cone.
#pragma once

#include "light_field.h"

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

}  // namespace rigel
