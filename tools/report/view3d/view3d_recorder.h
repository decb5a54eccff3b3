// Records what the page's 3-D view of an object shows.
#pragma once

#include "report/run/object_run.h"
#include "report/view3d/view3d_data.h"
#include "report/view3d/view3d_mesh.h"

namespace rigel::tools {

/// One object through the frames of a plan.
class ViewRecorder {
 public:
  /// At most `vertices` of the object, which is as authored in `rest`; `wrap`: in place of the materials'.
  ViewRecorder(const SceneObject& object, const PosedObject& rest, std::size_t vertices, std::optional<float> wrap);

  /// The next frame of the view, which is `frame` of the run. Rigs are lit anew: what fades has arrived.
  void record(const ObjectRun& run, std::size_t frame, const PosedObject& posed, const LightSet& lights,
              std::span<const ViewLight> shown);

  ObjectView take() && { return std::move(view_); }

 private:
  ObjectViewFrame::OfRig lit(RigRunner& rig, double meanIrradiance, std::span<const ViewLight> shown);

  std::vector<SurfacePoint> vertices_;
  std::vector<float> wrap_;
  ObjectView view_;
  std::vector<PointAndNormal> points_;
  std::vector<RigRunner::Shaded> shaded_;
};

}  // namespace rigel::tools
