// Which effects a scene calls for: what it lacks is neither computed nor loaded.
#pragma once

#include "scene/pose.h"

#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// Names such as "light.spot" or "material.wrap", sorted; empty kinds are absent.
std::vector<std::string> effectsOf(const LightSet& lights, std::span<const float> wraps);

}  // namespace rigel::tools
