// The moments of a run: which clip plays, for how long, and at which frames it is looked at.
#pragma once

#include "report/run/run_options.h"
#include "scene/scene.h"

namespace rigel::tools {

/// Above this a report would neither be finished nor read.
inline constexpr int kMaxFrames = 100'000;

/// Frames count at `rate` a second. The run lasts as long as the longer of the clip and the donor's lights; the shorter
/// loops.
struct Timeline {
  double rate = kDefaultRate;
  int clip = -1;              // index into Scene::animations, or kRestPose
  std::string clipName;       // "" for a still scene
  double clipDuration = 0;    // s
  double lightDuration = 0;   // s, of the donor's clip; 0 where the lights are the scene's own
  std::vector<double> loops;  // s, of clocks that ran when the scene was captured
  std::vector<int> frames;    // numbers of the frames to look at, rising; at least one

  double time(int frame) const { return frame / rate; }
  double clipTime(int frame) const { return looped(time(frame), clipDuration).time; }
  double lightTime(int frame) const { return looped(time(frame), lightDuration).time; }

  /// Does frames[index] come right after frames[index - 1], as a viewer would see it: numbered one more, and neither
  /// clock starting over in between? Only then is a difference of the two a movement.
  bool followsOn(std::size_t index) const;

 private:
  struct Looped {
    double time;  // within the loop
    double lap;   // loops completed before it
  };
  Looped looped(double time, double duration) const;
};

struct Timelines {
  std::vector<Timeline> all;       // at least one
  std::vector<std::string> notes;  // clips left out because they are too short for options.frames
};

/// One timeline for each clip that options.clip names. Errors: unknown clip (says which there are), no clip long enough
/// for the frame range, more than kMaxFrames frames.
Result<Timelines> makeTimelines(const Scene& scene, const RunOptions& options, double lightDuration);

}  // namespace rigel::tools
