// The report's pictures of one object in one frame: the truth, every rig, and their differences.
#pragma once

#include "report/pictures/photographer.h"
#include "report/report_data.h"

#include <filesystem>

namespace rigel::tools {

/// Where pictures go and what their names begin with (pictureNamePrefix).
struct GalleryFiles {
  std::filesystem::path directory;
  std::string prefix;
};

/// Size of the pictures in files.
inline constexpr PictureSize kPictureSize{560, 420};

struct FramePictures {
  std::vector<Picture> pictures;  // truth first
  PixelFrame pixels;              // the same for the page
};

/// Shades `run`'s object with the truth and with every rig, and writes PREFIX..-NAME-frameN-RIG.png/.exr and their heat
/// maps (picture_names.h). In the .exr of the truth and of rigs, R, G, B and A are radiance [W/(m2 sr)] and coverage;
/// irradiance.R, .G and .B are the irradiance [W/m2] of the object, the mean over its share of the pixel. An -error.exr
/// holds the difference of two such irradiances over the mean exact irradiance of the run, and A = 1 where the object
/// is. Heat maps show the size of it. `exposure` holds for all of them; without one, that of the truth.
Result<FramePictures> photograph(const PosedScene& scene, const ObjectRun& run, FrameLabel frame,
                                 const RunOptions& options, std::optional<float> exposure, const GalleryFiles& files);

/// The page's part alone, smaller by `divisor` on each side and with fewer digits.
PixelFrame sketch(const PosedScene& scene, const ObjectRun& run, FrameLabel frame, const RunOptions& options,
                  int divisor);

}  // namespace rigel::tools
