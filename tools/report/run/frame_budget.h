// --budget-us: a frame's time for all objects of a scene together.
#pragma once

#include "report/run/object_run.h"

namespace rigel::tools {

/// What is evaluated counts whole vectors and lights, where the choice blends between them: a frame this little over
/// the budget is not over.
inline constexpr double kBudgetSlack = 0.05;

/// One kind of rig on all objects of a scene, through the frames of a run.
class FrameBudget {
 public:
  /// `rig`: index into the rigs of every run.
  FrameBudget(float microseconds, std::size_t rig) : budget_(microseconds), rig_(rig) {}

  /// Lights and compares the rig in the frame that every run has begun.
  void measure(std::span<ObjectRun> runs, const LightSet& lights);

  SharedBudget report(const RunOptions& options) const;

 private:
  float budget_;
  std::size_t rig_;
  std::vector<double> used_;  // us, per frame
};

}  // namespace rigel::tools
