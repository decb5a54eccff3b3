// What became of each light in each frame, and why, for one rig of one object.
#pragma once

#include "report/report_data.h"

#include <span>

namespace rigel::tools {

/// "culled", "far", "blended" or "near".
const char* roleName(LightRole role);

/// What the sentences about a light need to know of the run.
struct LightLogContext {
  std::span<const LightRow> lights;  // in the order of the verdicts
  std::span<const int> frames;       // numbers of the frames, in the order in which they were added
  double meanIrradiance = 0;         // that bounds are relative to [W/m2]
  LightingOptions asked;
  std::optional<float> budget;  // us a frame that the rig shares with other objects
};

class LightLog {
 public:
  void add(std::span<const LightVerdict> verdicts);

  /// One entry a light. Where any light is near at times, bounds frame by frame are kept for those that are and for the
  /// kKept others with the largest; else for none: a report of hundreds of lights must still open.
  std::vector<LightReport> uses(const LightLogContext& context) const;
  static constexpr std::size_t kKept = 10;

 private:
  std::vector<std::vector<LightVerdict>> frames_;
};

}  // namespace rigel::tools
