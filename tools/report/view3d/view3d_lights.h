// The lights that 3-D views draw.
#pragma once

#include "report/report_data.h"
#include "report/view3d/view3d_data.h"

#include <span>

namespace rigel::tools {

/// Indices of at most `most` of `count` lights, rising: those that any rig of the objects has near come first, then
/// those with the largest share of an object's light.
std::vector<int> foremostLights(std::span<const ObjectReport> objects, std::size_t count, std::size_t most);

std::vector<ViewLight> viewLights(const LightSet& lights, std::span<const int> indices);
std::vector<ViewLightPlace> lightPlaces(const LightSet& lights, std::span<const ViewLight> shown);

}  // namespace rigel::tools
