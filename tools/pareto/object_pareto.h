// All configurations of one object, measured against one truth.
#pragma once

#include "pareto/configurations.h"
#include "pareto/pareto_data.h"
#include "report/measure/far_truth.h"
#include "report/measure/frame_errors.h"

#include <functional>

namespace rigel::tools {

class ObjectPareto {
 public:
  /// Builds every rig, on all cores; `step` is called now and then with the share done. `run`: wrap and samples. Error
  /// when the object has no area or a rig cannot be built for it.
  static Result<ObjectPareto> create(const SceneObject& object, const PosedObject& rest, const RunOptions& run,
                                     const std::vector<RigFamilyMember>& members,
                                     const std::function<void(double)>& step);

  const SceneObject& object() const { return *object_; }
  const SurfaceSet& surface() const { return surface_; }
  PosedObject& posed() { return posed_; }  // in world space; posed by the caller before each of these:

  /// Before the first frame: what some frames give the object, for the scale of errors that rigs aim at.
  void survey(const LightSet& lights);
  /// Errors in a frame, on all cores. Each frame stands for itself: nothing fades.
  void measure(const LightSet& lights);
  /// Times in a frame, one after another; the least of all calls with the same `slot` counts.
  void time(std::size_t slot, const LightSet& lights);

  /// Lights all rigs in the frame posed; for who looks at them next.
  void light(const LightSet& lights);

  /// One entry a point of the chart, in the order of members, settings and forms. GPU times are the caller's.
  std::vector<ParetoPoint> report() const;
  double meanIrradiance() const;

  /// The rig of an entry of report(), and the same rig without near lights (of an `auto` rig the first of its kind).
  const RigRunner& rigOf(std::size_t point) const { return runner(entries_[point]); }
  const RigRunner& plainRigOf(std::size_t point) const { return *lit_[entries_[point].lit].runners.front(); }

 private:
  struct Lit {
    RigFamilyMember what;
    std::vector<std::unique_ptr<RigRunner>> runners;  // one a setting of near lights
  };
  /// What is measured of one runner in one form and storage.
  struct Entry {
    std::size_t lit = 0, setting = 0;
    NearForm form = NearForm::exact;
    bool half = false;
    std::vector<FrameErrors> errors;
    double shVectors = 0, nearLights = 0, modelled = 0;  // sums over the frames
    std::size_t bytes = 0;
    std::vector<double> fit, shade;  // least of each timed frame [us]
  };
  struct Scratch {
    std::vector<RigRunner::Shaded> shaded, whole, formed;
    std::vector<Rgb> sh, rounded;
  };

  explicit ObjectPareto(const SceneObject& object) : object_(&object) {}
  void addEntries(std::size_t lit);
  void lightOne(RigRunner& runner, const LightSet& lights);
  void measureMember(std::size_t lit, const LightSet& lights);
  void timeMember(std::size_t lit, std::size_t slot, const LightSet& lights);
  ParetoPoint report(const Entry& entry) const;
  const RigRunner& runner(const Entry& entry) const { return *lit_[entry.lit].runners[entry.setting]; }

  const SceneObject* object_;
  SurfaceSet surface_;
  bool wraps_ = false;  // some of the surface
  std::vector<Lit> lit_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> firstEntry_;  // of each of lit_
  std::vector<double> surveyed_;
  std::vector<double> means_;  // per frame
  PosedObject posed_;
  Truth truth_;
  std::array<FarTruth, kMaxBands + 1> far_;
  std::vector<PointAndNormal> timedPoints_;
  std::vector<float> timedWrap_;
  std::vector<RigRunner::Shaded> timedShaded_;
};

}  // namespace rigel::tools
