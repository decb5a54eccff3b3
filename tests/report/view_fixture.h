// A made-up 3-D view: an ellipsoid that breathes as it drives along, under lights of the report's kinds.
#pragma once

#include "report/report_data.h"
#include "report/view3d/view3d_data.h"

namespace rigel::tests {

/// `frames` frames, `rigs` rigs, `lights` lights.
tools::ObjectView madeUpView(std::size_t frames, std::size_t rigs, std::size_t lights);

/// Gives the first object of `scene` a view of five frames.
void addMadeUpView(tools::SceneReport& scene);

}  // namespace rigel::tests
