// What a rig that samples anywhere leaves of one light at points of what it serves: no bound by itself, but what the
// bounds of sample_bound.cpp have to allow for between these points is far less than what they have to allow for
// without them.
#pragma once

#include "light_field.h"

#include <rigel/light.h>

namespace rigel {

/// Largest over the probed points and over all normals, or more (each band's own worst normal).
struct Probed {
  double error = 0;  // of the rig
  double value = 0;  // of the rig
};

/// Of an unmodulated sphere light of `field`'s radius and power, at `position` in the rig frame.
Probed probed(const detail::SamplePlan& samples, const WrapField& wrap, const LightField& field,
              const std::array<double, 3>& position) noexcept;

/// Of a disk light in the rig frame, of radiance 1.
Probed probed(const detail::SamplePlan& samples, const WrapField& wrap, const DiskLight& light) noexcept;

/// A light as the point served that is nearest to it sees it.
struct LightNearby {
  double peak = 0;      // largest irradiance
  double distance = 0;  // of its surface
  double leap = 0;      // 1 where it may pass through a sample and leap there, coming in from 0
};

/// What a rig leaves of a light anywhere: no more than `error`, which is known without probes. `tail`: of its degrees
/// that the rig's plan does not watch (SampleBound).
double probedBound(const detail::BoundPlan& plan, const detail::SamplePlan& samples, double tail, const Probed& probed,
                   const LightNearby& light, double error) noexcept;

}  // namespace rigel
