// Lights as the report lists them, and the scale of --exposure.
#pragma once

#include "report/report_data.h"
#include "scene/pose.h"

#include <optional>

namespace rigel::tools {

/// Multiplies all lights of a scene: --exposure, for files whose photometric values are far from 1. Error naming the
/// first light that becomes brighter than a float holds.
std::optional<Error> scaleLights(Scene& scene, float factor);

/// One row per light for the report's table.
std::vector<LightRow> describeLights(const PosedLights& lights);

}  // namespace rigel::tools
