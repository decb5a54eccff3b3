// What the bounds of light_bound.h need of a rig in a pose, found once a frame.
#pragma once

#include <rigel/light_bound.h>

namespace rigel {

detail::BoundPlan boundPlan(const Rig& rig, float radius, detail::SamplePlan& samples) noexcept;

}  // namespace rigel
