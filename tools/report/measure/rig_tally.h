// What one rig did over the frames of a run: errors, times, choices.
#pragma once

#include "report/measure/error_spread.h"
#include "report/measure/frame_errors.h"
#include "report/measure/light_log.h"
#include "report/measure/parts_tally.h"
#include "report/report_data.h"

namespace rigel::tools {

/// What a tally's figures are to be read against.
struct TallyContext {
  std::span<const double> times;  // of the frames, s
  std::span<const int> frames;    // their numbers
  std::span<const LightRow> lights;
  double meanIrradiance = 0;  // 0: errors are shown as 0
  const BodyParts* bodyParts = nullptr;
};

class RigTally {
 public:
  RigTally(const LightingOptions& asked, std::optional<float> budget) : asked_(asked), budget_(budget) {}

  void addTiming(const FitTimes& fit, double shadeMicroseconds);

  /// A frame that `rig` was just fitted to. `lights`: its promises; `sh`: what a perfect rig of the same bands and far
  /// shares gives.
  void addFrame(const RigRunner& rig, std::span<const LightVerdict> lights, std::span<const RigRunner::Shaded> shaded,
                const Truth& truth, std::span<const Rgb> sh, std::span<const float> wrap, bool followsOn);

  /// The last frame on the way from the truth to the rig.
  void addSteps(const ErrorSteps& steps) { parts_.add(steps); }

  /// The last frame with coefficients in half floats, beside the same in 32 bits.
  void addHalf(std::span<const RigRunner::Shaded> shaded, std::span<const RigRunner::Shaded> half);

  /// The error that the last frame's budget left the rig to aim at.
  void grant(float error) { frames_.back().granted = error; }
  std::optional<float> granted(std::size_t frame) const { return frames_[frame].granted; }

  /// Square root of the sum of a frame's squared total errors [W/m2].
  double totalError(std::size_t frame) const;

  RigReport report(const RigRunner& rig, const TallyContext& context) const;

 private:
  struct Frame {
    std::optional<double> halfSquares;  // of what half floats change
    FrameErrors errors;
    std::optional<float> estimate, totalEstimate, granted;
    std::optional<double> jump;
    int shVectors = 0;
    float modelledNanoseconds = 0;
    std::vector<int> near;
  };

  void addTimes(RigReport& out) const;
  void addFrames(RigReport& out, const TallyContext& context) const;

  LightingOptions asked_;
  std::optional<float> budget_;  // us a frame that the rig shares with other objects
  std::vector<Frame> frames_;
  LightLog lights_;
  PartsTally parts_;
  ErrorSpread spread_;
  std::vector<FitTimes> fitTimes_;
  std::vector<double> shadeTimes_;  // us, all samples
  double spatialMax_ = 0, totalMax_ = 0, halfMax_ = 0, condition_ = 1;
  std::size_t bytes_ = 0, samples_ = 0;
  std::vector<Rgb> error_, previousError_;  // clamped rig + near lights - exact
};

}  // namespace rigel::tools
