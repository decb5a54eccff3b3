// A built-in scene in motion at any rate, and how far a rig's light leaps from frame to frame.
#pragma once

#include "report/measure/rig_runner.h"
#include "scene/gltf_load.h"

#include <string>

namespace rigel::tests {

/// The first moving object of a built-in scene, in its first clip.
class Motion {
 public:
  Motion(const std::string& sample, int samples);

  double duration() const { return scene_.animations.at(0).duration; }
  /// Poses object and lights, and measures the truth, at a time of the clip.
  void show(double seconds);

  const tools::SceneObject& object() const { return objects_[moving_]; }
  const tools::PosedObject& posed() const { return posed_; }
  const tools::PosedObject& rest() const { return rest_; }
  const tools::SurfaceSet& surface() const { return surface_; }
  const tools::Truth& truth() const { return truth_; }
  const LightSet& lights() const { return lights_.set; }

 private:
  tools::Scene scene_;
  std::vector<tools::SceneObject> objects_;
  std::size_t moving_ = 0;
  tools::SurfaceSet surface_;
  tools::ScenePose pose_;
  tools::PosedObject posed_, rest_;
  tools::PosedLights lights_;
  tools::Truth truth_;
};

/// Largest changes between frames that follow on each other, over samples and channels [W/m2].
struct Leap {
  double error = 0;  // of clamped rig + near lights - exact: max_jump of the report
  double rig = 0;    // of the rig's part alone, clamped
};

class LeapMeter {
 public:
  void add(std::span<const tools::RigRunner::Shaded> shaded, const tools::Truth& truth);
  Leap largest() const { return largest_; }

 private:
  Leap largest_;
  std::vector<std::array<double, 3>> error_, rig_;  // of the last frame
};

/// What is wrong with near lights elsewhere: the `slots` lights with the largest bounds are evaluated exactly, all
/// others stay in the rig, from one frame to the next. `rig` was just fitted to the frame with its bounds.
void shadeWithHardSwitch(const tools::RigRunner& rig, int slots, const Motion& motion,
                         std::span<tools::RigRunner::Shaded> out);

}  // namespace rigel::tests
