// The forms of near light at many points, for who compares them.
#pragma once

#include "pareto/configurations.h"
#include "report/measure/rig_runner.h"

namespace rigel::tools {

/// near = sum over `lights` by `form`, at points with their wraps; the rig's part stays.
void addNearLights(NearForm form, std::span<const NearLight> lights, std::span<const PointAndNormal> points,
                   std::span<const float> wrap, std::span<RigRunner::Shaded> shaded);

}  // namespace rigel::tools
