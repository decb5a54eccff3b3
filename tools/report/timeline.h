// The moments of a run: which clip plays, for how long, and at which frames it is looked at.
#pragma once

#include "report/run_options.h"
#include "scene/scene.h"

namespace rigel::tools {

/// Frames count at 30 a second. The run lasts as long as the longer of the clip and the donor's lights; the shorter
/// loops.
struct Timeline {
  int clip = -1;             // index into Scene::animations, or kRestPose
  std::string clipName;      // "" for a still scene
  double clipDuration = 0;   // s
  double lightDuration = 0;  // s, of the donor's clip; 0 where the lights are the scene's own
  std::vector<int> frames;   // numbers of the frames to look at; at least one

  double time(int frame) const { return frame / kFramesPerSecond; }
  double clipTime(int frame) const { return looped(time(frame), clipDuration); }
  double lightTime(int frame) const { return looped(time(frame), lightDuration); }

 private:
  static double looped(double time, double duration);
};

/// One timeline for each clip that options.clip names. Errors: unknown clip (says which there are), empty frame range.
Result<std::vector<Timeline>> makeTimelines(const Scene& scene, const RunOptions& options, double lightDuration);

}  // namespace rigel::tools
