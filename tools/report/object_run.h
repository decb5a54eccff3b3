// Measures all rigs of one object over the frames of a run.
#pragma once

#include "report/rig_tally.h"
#include "report/run_options.h"

namespace rigel::tools {

/// A frame of a run as its object sees it.
struct RunFrame {
  int number = 0;
  double time = 0;         // s
  bool followsOn = false;  // comes right after the last (Timeline::followsOn), so that what changed is movement
};

class ObjectRun {
 public:
  /// Each frame is timed `timings` times: runs of few frames want several, for a median that means something. Error
  /// when the object has no area or a rig cannot be built for it.
  static Result<ObjectRun> create(const SceneObject& object, const PosedObject& rest, const RunOptions& options,
                                  int timings);

  /// Before the first frame is measured: what a few frames of the run give the object, for the scale of the errors that
  /// rigs expect and aim at.
  void survey(const PosedObject& posed, const LightSet& lights);

  /// Fits, evaluates and compares every rig in one frame. Frames come in the order of time.
  void measure(const RunFrame& frame, const PosedObject& posed, const LightSet& lights);

  /// The figures so far; `lights` in the order of the sets measured. Errors are relative to the mean exact irradiance
  /// of the run; where that is 0 (no light reaches the object) they are 0.
  ObjectReport report(std::span<const LightRow> lights) const;

  /// Index of the frame in which the rigs, taken together, are worst.
  std::size_t worstFrame() const;

  const SceneObject& object() const { return *object_; }
  /// In the order of the options. May be fitted anew, to any frame: report() reads nothing that this changes.
  std::span<const std::unique_ptr<RigRunner>> rigs() const { return runners_; }
  double meanIrradiance() const;

 private:
  struct FrameTruth {
    double mean = 0;
    std::optional<double> movementSquares;
  };

  explicit ObjectRun(const SceneObject& object) : object_(&object) {}
  void setReference();
  void measureRig(std::size_t rig, float seconds, bool followsOn, const PosedObject& posed, const LightSet& lights);
  std::span<const Rgb> shOfFarShares(const RigRunner& rig, const LightSet& lights);

  const SceneObject* object_;
  int bands_ = 3;
  int timings_ = 1;
  double rate_ = kDefaultRate;
  SurfaceSet surface_;
  std::vector<double> surveyed_;
  std::vector<std::unique_ptr<RigRunner>> runners_;
  std::vector<RigTally> tallies_;
  std::vector<std::string> asked_;  // per rig, the options that govern its choices
  std::vector<int> numbers_;        // per frame
  std::vector<double> times_;       // per frame
  std::vector<FrameTruth> frames_;
  Truth truth_;
  std::vector<RgbD> previousExact_;
  std::vector<RigRunner::Shaded> shaded_;

  LightSet far_;  // working memory of shOfFarShares
  std::vector<NearLight> near_;
  std::vector<float> weights_;
  std::vector<Rgb> farSh_;
};

}  // namespace rigel::tools
