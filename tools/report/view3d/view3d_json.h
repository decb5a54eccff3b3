// The 3-D views as the page reads them: JSON that holds no name, and most numbers deflated (view3d_pack.h).
#pragma once

#include "report/report_data.h"
#include "report/view3d/view3d_data.h"

namespace rigel::tools {

/// An object's view in at most `bytes`: with fewer frames where it is larger, "" where one is too many. Numbers that
/// are not finite are written as 0: they end the report elsewhere.
std::string packedView(const ObjectView& view, std::size_t bytes);

/// The frames and lights that the views of a scene's objects share.
std::string packedScene(const SceneView& view);

/// {"scenes": [...], "objects": [...]} in the order of report.json, null for those without a view; "" where no object
/// has one.
std::string view3dJson(const Report& report);

}  // namespace rigel::tools
