// The 3-D views of one scene and clip, once it has been measured.
#pragma once

#include "report/run/loaded_scene.h"
#include "report/run/object_run.h"
#include "report/view3d/view3d_plan.h"

namespace rigel::tools {

/// Fills in `view3d` of `report` and its objects, which are those of `runs`.
void addViews(const LoadedScene& scene, const Timeline& timeline, Stage& stage, std::vector<ObjectRun>& runs,
              const RunOptions& options, const ViewBudget& budget, SceneReport& report);

}  // namespace rigel::tools
