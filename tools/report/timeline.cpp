#include "report/timeline.h"

#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

/// Key times such as 0.8333333 for 25/30 must not lose their last frame to rounding.
constexpr double kFrameSlack = 1e-3;

Result<std::vector<int>> clipsOf(const Scene& scene, const std::string& wanted) {
  const int count = static_cast<int>(scene.animations.size());
  std::vector<int> clips;
  if (wanted.empty()) {
    clips.push_back(count > 0 ? 0 : kRestPose);
  } else if (wanted == "all") {
    for (int i = 0; i < count; ++i) clips.push_back(i);
    if (clips.empty()) clips.push_back(kRestPose);
  } else {
    std::string known;
    for (int i = 0; i < count; ++i) {
      if (scene.animations[i].name == wanted) clips.push_back(i);
      known += (i > 0 ? ", " : "") + scene.animations[i].name;
    }
    if (clips.empty())
      return Error{"no clip '" + wanted + "' " + (count > 0 ? "(there are: " + known + ")" : "(the scene is still)"),
                   scene.name};
  }
  return clips;
}

}  // namespace

double Timeline::looped(double time, double duration) {
  if (duration <= 0) return 0;
  // The last frame of a clip is its end, not its start again.
  if (time <= duration + kFrameSlack / kFramesPerSecond) return std::min(time, duration);
  return std::fmod(time, duration);
}

Result<std::vector<Timeline>> makeTimelines(const Scene& scene, const RunOptions& options, double lightDuration) {
  const auto clips = clipsOf(scene, options.clip);
  if (!clips) return clips.error();
  std::vector<Timeline> timelines;
  for (int clip : *clips) {
    Timeline timeline;
    timeline.clip = clip;
    timeline.lightDuration = lightDuration;
    if (clip != kRestPose) {
      timeline.clipName = scene.animations[clip].name;
      timeline.clipDuration = scene.animations[clip].duration;
    }
    const double duration = std::max(timeline.clipDuration, lightDuration);
    const int end = static_cast<int>(std::floor(duration * kFramesPerSecond + kFrameSlack));
    const int last = std::min(end, options.frames.last.value_or(end));
    for (int f = options.frames.first; f <= last; f += options.frames.step) timeline.frames.push_back(f);
    if (timeline.frames.empty())
      return Error{"frame " + std::to_string(options.frames.first) + " is past the end (the last is " +
                       std::to_string(end) + ")",
                   scene.name + (timeline.clipName.empty() ? "" : ": clip '" + timeline.clipName + "'")};
    timelines.push_back(std::move(timeline));
  }
  return timelines;
}

}  // namespace rigel::tools
