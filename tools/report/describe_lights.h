// Lights as the report lists them, and the scale of --exposure.
#pragma once

#include "report/report_data.h"
#include "scene/pose.h"

namespace rigel::tools {

/// Multiplies all lights of a scene: --exposure, for files whose photometric values are far from 1.
void scaleLights(Scene& scene, float factor);

/// One row per light for the report's table.
std::vector<LightRow> describeLights(const PosedLights& lights);

}  // namespace rigel::tools
