// The report's pictures of one object in one frame: the truth, every rig, and their differences.
#pragma once

#include "report/object_run.h"
#include "report/run_options.h"

#include <filesystem>

namespace rigel::tools {

/// Where pictures go and what their names begin with (pictureNamePrefix).
struct GalleryFiles {
  std::filesystem::path directory;
  std::string prefix;
};

struct FrameLabel {
  std::size_t index = 0;  // among the frames of the run
  int number = 0;
  double time = 0;  // s
};

/// Ray-casts `run`'s object in the posed scene (all other `objects` around it), shades it with the truth and with
/// every rig, and writes PREFIX..-NAME-frameN-RIG.png/.exr and their heat maps (picture_names.h). Truth first. Heat
/// maps show |rig - truth| over the mean exact irradiance of the covered pixels.
Result<std::vector<Picture>> photograph(const Scene& scene, std::span<const SceneObject> objects, const ScenePose& pose,
                                        const LightSet& lights, const ObjectRun& run, FrameLabel frame,
                                        const RunOptions& options, const GalleryFiles& files);

}  // namespace rigel::tools
