#include "report/run/timeline.h"

#include "scene/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Numbers of the frames of `range` up to `end`, or empty where there are more than kMaxFrames of them.
std::vector<int> framesOf(const FrameRange& range, double end) {
  const double last = range.last ? std::min<double>(end, *range.last) : end;
  const double count = std::floor((last - range.first) / range.step) + 1;
  std::vector<int> frames;
  if (count > kMaxFrames || last > std::numeric_limits<int>::max()) return frames;
  // Counted, not stepped: the frame after the last may not be an int.
  for (int i = 0; i < static_cast<int>(count); ++i) frames.push_back(range.first + i * range.step);
  return frames;
}

}  // namespace

Timeline::Looped Timeline::looped(double time, double duration) const {
  if (duration <= 0) return {0, 0};
  // Every lap ends with the clip's end: its start, where loops are seamless, is the same moment.
  const double lap = std::max(0.0, std::ceil((time - kFrameSlack / rate) / duration) - 1);
  return {std::clamp(time - lap * duration, 0.0, duration), lap};
}

bool Timeline::followsOn(std::size_t index) const {
  if (index == 0 || frames[index] - frames[index - 1] != 1) return false;
  const auto sameLap = [&](double duration) {
    return looped(time(frames[index - 1]), duration).lap == looped(time(frames[index]), duration).lap;
  };
  return sameLap(clipDuration) && sameLap(lightDuration) && std::ranges::all_of(loops, sameLap);
}

Result<Timelines> makeTimelines(const Scene& scene, const RunOptions& options, double lightDuration) {
  const auto clips = clipsOf(scene, options.clip);
  if (!clips) return clips.error();
  Timelines timelines;
  std::optional<Error> tooShort;
  for (int clip : *clips) {
    Timeline timeline;
    timeline.rate = options.rate;
    timeline.clip = clip;
    timeline.lightDuration = lightDuration;
    timeline.loops = options.loops;
    if (clip != kRestPose) {
      timeline.clipName = scene.animations[clip].name;
      timeline.clipDuration = scene.animations[clip].duration;
    }
    const std::string label = timeline.clipName.empty() ? "" : "clip '" + timeline.clipName + "'";
    const std::string place = scene.name + (label.empty() ? "" : ": " + label);
    const double duration = std::max(timeline.clipDuration, lightDuration);
    const double end = std::floor(duration * options.rate + kFrameSlack);
    if (options.frames.first > end) {
      const std::string why = fmt::format("frame {} is past the end (the last is {:.0f})", options.frames.first, end);
      if (!tooShort) tooShort = Error{why, place};
      timelines.notes.push_back(label + " is left out: " + why);
      continue;
    }
    timeline.frames = framesOf(options.frames, end);
    if (timeline.frames.empty())
      return Error{fmt::format("lasts {:.4g} s, which at {:g} frames a second is more than the {} frames of a report "
                               "(choose some: --frames 0:1000)",
                               duration, options.rate, kMaxFrames),
                   place};
    timelines.all.push_back(std::move(timeline));
  }
  if (timelines.all.empty()) return *tooShort;
  return timelines;
}

}  // namespace rigel::tools
