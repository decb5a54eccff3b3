// Which effects a scene calls for: what it lacks is neither computed nor loaded.
#pragma once

#include "report/report_data.h"
#include "scene/pose.h"

#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// Names such as "light.spot", "light.near.spot", "light.near.wrap", "material.wrap", "rig.auto" or "rig.high_band",
/// sorted; empty kinds are absent, and so is everything near where no light was near in any frame.
std::vector<std::string> effectsOf(const LightSet& lights, std::span<const float> wraps, std::span<const RigSpec> rigs,
                                   std::span<const ObjectReport> objects);

}  // namespace rigel::tools
