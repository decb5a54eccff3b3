// Measures all rigs of one object over the frames of a run.
#pragma once

#include "report/report_data.h"
#include "report/rig_runner.h"
#include "report/run_options.h"

namespace rigel::tools {

class ObjectRun {
 public:
  /// Each frame is timed `timings` times: runs of few frames want several, for a median that means something. Error
  /// when the object has no area or a rig cannot be built for it.
  static Result<ObjectRun> create(const SceneObject& object, const PosedObject& rest, const RunOptions& options,
                                  int timings);

  /// Fits, evaluates and compares every rig in one frame. Frames come in the order of time; `followsOn` says that this
  /// one comes right after the last (Timeline::followsOn), so that what changed is movement.
  void measure(double time, bool followsOn, const PosedObject& posed, const LightSet& lights);

  /// The figures so far. Errors are relative to the mean exact irradiance of the run; where that is 0 (no light reaches
  /// the object) they are 0.
  ObjectReport report() const;

  /// Index of the frame in which the rigs, taken together, are worst.
  std::size_t worstFrame() const;

  const SceneObject& object() const { return *object_; }
  /// In the order of the options. May be fitted anew, to any frame: report() reads nothing that this changes.
  std::span<const std::unique_ptr<RigRunner>> rigs() const { return runners_; }
  double meanIrradiance() const;

 private:
  /// Sums of squared differences [W/m2]^2 of one rig, per frame, and their extremes.
  struct Tally {
    std::vector<double> spatialSquares, totalSquares;
    std::vector<FitTimes> fitTimes;
    std::vector<double> shadeTimes;
    double spatialMax = 0, totalMax = 0, condition = 1;
    std::optional<double> maxJump;
    std::vector<Rgb> error, previousError;  // clamped rig - exact at each point
  };
  struct FrameTruth {
    double time = 0, mean = 0;
    std::optional<double> movementSquares;
  };

  explicit ObjectRun(const SceneObject& object) : object_(&object) {}
  void compare(Tally& tally, std::span<const Rgb> shaded, bool followsOn) const;
  RigReport rigReport(std::size_t rig, double mean) const;

  const SceneObject* object_;
  int bands_ = 3;
  int timings_ = 1;
  SurfaceSet surface_;
  std::vector<std::unique_ptr<RigRunner>> runners_;
  std::vector<Tally> tallies_;
  std::vector<FrameTruth> frames_;
  Truth truth_;
  std::vector<RgbD> previousExact_;
  std::vector<Rgb> shaded_;
};

}  // namespace rigel::tools
