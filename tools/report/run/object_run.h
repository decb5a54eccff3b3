// Measures all rigs of one object over the frames of a run.
#pragma once

#include "report/measure/exact_shares.h"
#include "report/measure/far_truth.h"
#include "report/measure/rig_tally.h"
#include "report/run/run_options.h"

namespace rigel::tools {

/// A frame of a run as its object sees it.
struct RunFrame {
  int number = 0;
  double time = 0;         // s
  bool followsOn = false;  // comes right after the last (Timeline::followsOn), so that what changed is movement
};

class ObjectRun {
 public:
  /// How a run of many frames, or of many objects, is measured.
  struct Setting {
    int timings = 1;      // of each frame: runs of few frames want several, for a median that means something
    bool shares = false;  // other objects want a share of --budget-us
  };

  /// Error when the object has no area or a rig cannot be built for it.
  static Result<ObjectRun> create(const SceneObject& object, const PosedObject& rest, const RunOptions& options,
                                  const Setting& setting);

  const SceneObject& object() const { return *object_; }

  /// In world space; whoever runs the frames poses it before `survey` and `measure`.
  PosedObject& posed() { return posed_; }

  /// The points at which errors are measured.
  const SurfaceSet& surface() const { return surface_; }

  /// For errors by body part: where the measured points belong.
  void setBodyParts(BodyParts parts) { bodyParts_ = std::move(parts); }

  /// Before the first frame is measured: what a few frames of the run give the object, for the scale of the errors that
  /// rigs expect and aim at.
  void survey(const LightSet& lights);

  /// Begins a frame, and compares all rigs but those that share the frame's time. Frames come in the order of time.
  void measure(const RunFrame& frame, const LightSet& lights);

  /// For FrameBudget, in a frame that has begun: pose, then the rig is lit, then compareShared with the error that it
  /// was lit to, which lights the rig once more for itself alone; then `timings` times pose, lit again with kNoTime,
  /// and time.
  void pose(std::size_t rig) { rigs_[rig].runner->pose(*object_, posed_); }
  void compareShared(std::size_t rig, const LightSet& lights, float granted);
  void time(std::size_t rig) { time(rigs_[rig]); }
  int timings() const { return setting_.timings; }
  float secondsAFrame() const { return static_cast<float>(1 / rate_); }
  /// Lighting a frame again, to time it with its data in the caches for all rigs alike, must not let anything fade.
  static constexpr float kNoTime = 1e-9f;

  /// The figures so far; `lights` in the order of the sets measured. Errors are relative to the mean exact irradiance
  /// of the run; where that is 0 (no light reaches the object) they are 0.
  ObjectReport report(std::span<const LightRow> lights) const;

  /// Index of the frame in which the rigs, taken together, are worst.
  std::size_t worstFrame() const;

  /// In the order of the options.
  std::size_t rigCount() const { return rigs_.size(); }
  RigRunner& rig(std::size_t i) const { return *rigs_[i].runner; }
  double meanIrradiance() const;

  /// Lights a rig as it was in a frame that was measured, by its index; what fades has arrived. report() reads nothing
  /// that this changes.
  void relight(std::size_t rig, std::size_t frame, const PosedObject& posed, const LightSet& lights) const;

 private:
  struct FrameTruth {
    double mean = 0;
    std::optional<double> movementSquares;
  };

  struct MeasuredRig {
    std::unique_ptr<RigRunner> runner;
    RigTally tally;
    std::string asked;                   // the options that govern its choices
    bool shares = false;                 // the frame's time
    std::unique_ptr<MeasuredRig> alone;  // the same rig with that time to itself; none where nobody else wants it
  };

  explicit ObjectRun(const SceneObject& object) : object_(&object) {}
  Result<MeasuredRig> makeRig(const RigSpec& spec, const PosedObject& rest, const RunOptions& options) const;
  void setReference();
  void lightByItself(MeasuredRig& rig, const LightSet& lights);
  void time(MeasuredRig& rig);
  void compare(MeasuredRig& rig, const LightSet& lights, std::optional<float> granted);
  std::span<const Rgb> shOfFarShares(const RigRunner& rig, const LightSet& lights);
  void splitError(MeasuredRig& rig, const LightSet& lights, std::span<const Rgb> farSh);
  RigReport report(const MeasuredRig& rig, std::span<const LightRow> lights) const;

  const SceneObject* object_;
  Setting setting_;
  int bands_ = 3;
  double rate_ = kDefaultRate;
  std::optional<float> budget_;  // us a frame
  SurfaceSet surface_;
  std::vector<double> surveyed_;
  std::vector<MeasuredRig> rigs_;  // in the order of the options
  std::vector<int> numbers_;       // per frame
  std::vector<double> times_;      // per frame
  std::vector<FrameTruth> frames_;
  PosedObject posed_;
  Truth truth_;
  bool followsOn_ = false;
  std::vector<RgbD> previousExact_;
  std::vector<RigRunner::Shaded> shaded_, half_;

  FarTruth far_;           // of frames in which a rig has a light near
  bool farBegun_ = false;  // in this frame
  std::vector<Rgb> farSh_;

  std::optional<BodyParts> bodyParts_;
  ExactShares exactShares_;
  bool exactBegun_ = false;  // in this frame
  std::vector<RgbD> nearExact_, farBands_, doubleRig_;
  std::vector<Rgb> highBand_;
};

}  // namespace rigel::tools
