// One object in one frame as a camera sees it: cast once, shaded by the truth and by one rig after another.
#pragma once

#include "picture/raycast.h"
#include "report/run/object_run.h"
#include "report/run/run_options.h"

namespace rigel::tools {

/// A posed scene with its lights.
struct PosedScene {
  const Scene& scene;
  std::span<const SceneObject> objects;
  const ScenePose& pose;
  const LightSet& lights;
};

struct PictureSize {
  int width = 0, height = 0;
};

struct FrameLabel {
  std::size_t index = 0;  // among the frames of the run
  int number = 0;
  double time = 0;  // s
};

/// A rig's irradiance at every sample, and its error: (rig - truth) over the run's mean exact irradiance; 0 off the
/// object.
struct ShadedRig {
  std::vector<Rgb> irradiance, error;
};

class Photographer {
 public:
  /// Ray-casts `run`'s object, all others around it. Without an exposure it takes that of this picture.
  Photographer(const PosedScene& scene, const ObjectRun& run, std::optional<float> wrap, PictureSize size,
               std::optional<float> exposure = {});

  const VisibleSurface& surface() const { return surface_; }
  float exposure() const { return exposure_; }
  const std::vector<Rgb>& truth() const { return exact_; }

  /// A rig of the run, lit to this frame: clamped, scenery by the truth. Near lights that fade after a switch or a
  /// teleport are shown as they end up.
  ShadedRig shade(std::size_t rigIndex, std::size_t frame, const LightSet& lights) const;

  /// What the camera sees under this irradiance [W/(m2 sr)].
  Image radiance(std::span<const Rgb> irradiance) const;
  /// Radiance of all but the object.
  Image surroundings() const;
  /// The object's base colour / pi. Its coverage is the object's share of the pixel.
  Image reflectance() const;
  /// Mean over the object's share of each pixel, not premultiplied; coverage is that share.
  Image objectMean(std::span<const Rgb> values) const;

  /// Of the object's pixels, root mean square.
  double rms(std::span<const Rgb> error) const;
  /// The top of a scale of false colours for this error.
  float heatScaleOf(std::span<const Rgb> error) const;
  Image8 heat(std::span<const Rgb> error, float top) const;

 private:
  const ObjectRun& run_;
  PosedObject posed_;
  VisibleSurface surface_;
  std::vector<Rgb> exact_;  // all samples
  float exposure_ = 1;
  std::vector<std::size_t> objectSamples_;  // into surface_.samples; points_ and wraps_ are theirs
  std::vector<PointAndNormal> points_;
  std::vector<float> wraps_;
};

}  // namespace rigel::tools
