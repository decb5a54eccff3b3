// The true picture: exact irradiance at every visible sample.
#pragma once

#include "picture/raycast.h"

namespace rigel::tools {

/// Scenery is shown at this share of its radiance, so that the object stands out.
inline constexpr float kSceneryDimming = 0.6f;

/// Exact irradiance [W/m2] at each sample, with its own wrap; 0 for samples of lights. Uses all cores.
std::vector<Rgb> exactIrradiance(const VisibleSurface& surface, const LightSet& lights);

/// Outgoing radiance of each sample for the given irradiance, scenery dimmed. The emission of lights is multiplied by
/// `lightScale`: 1/exposure shows them at the brightness that addLights was given, whatever the exposure.
std::vector<Rgb> shade(const VisibleSurface& surface, std::span<const Rgb> irradiance, float lightScale = 1);

}  // namespace rigel::tools
