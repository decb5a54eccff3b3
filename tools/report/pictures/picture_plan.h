// Which frames of a run get pictures: one in full, others smaller for playing, as far as the page may grow.
#pragma once

#include "report/pictures/gallery.h"
#include "report/run/loaded_scene.h"

namespace rigel::tools {

/// Bytes of all packed pictures of a report; a third more in the page, where they are in base64.
inline constexpr std::size_t kPagePictureBytes = 4'200'000;
/// Pixels times lights of all pictures for playing: about ten seconds of one core for the truth under disks and
/// spheres.
inline constexpr double kPlayedPairs = 20e6;

/// What the frames of an object look like, in the order of time.
struct ObjectPictures {
  std::vector<Picture> pictures;
  std::vector<PixelFrame> frames;
};

/// Takes pictures of `run`'s object: in full of its worst frame, which has files; others spread over the timeline, so
/// that the page's part stays near `bytes`, and the time they take within the same share of kPlayedPairs. Where not
/// even one in full fits, the page gets a small one of the same frame.
Result<ObjectPictures> takePictures(const LoadedScene& scene, const Timeline& timeline, Stage& stage,
                                    const ObjectRun& run, const RunOptions& options, const GalleryFiles& files,
                                    std::size_t bytes, const std::function<void(double)>& progress);

}  // namespace rigel::tools
