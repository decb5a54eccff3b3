// What an oracle would choose: the cheapest number of SH vectors and near lights that truly meets a target.
#pragma once

#include "study/study_frames.h"

#include <rigel/object_lighting.h>

namespace rigel::tools {

/// A choice of nested coefficients, near lights and high band, with its modelled cost.
struct OracleChoice {
  int vectors = 0, nearLights = 0;
  bool highBand = false;
  int correctors = 0;
  float nanoseconds = 0;
};

/// What an oracle may use beside SH vectors and near lights.
struct OracleTools {
  bool highBand = true;
  int correctors = 0;  // at most
};
inline constexpr float kCorrectorNanoseconds = 9;  // a directional near light and a polynomial

/// True errors of every choice in one frame, near lights taken in the order of their own error.
class NestedOracle {
 public:
  /// `rig` is an `auto` rig, posed.
  NestedOracle(const StudyFrame& frame, const Rig& rig, float wrap);

  int vectors() const { return vectors_; }
  int lights() const { return lights_; }
  /// Mean squares [W/m2]^2 over points and channels.
  double spatialSquare(int vectors, int nearLights) const;
  double totalSquare(int vectors, int nearLights, bool highBand, int correctors = 0) const;

  OracleChoice cheapestSpatial(double target, const CostModel& cost) const;
  OracleChoice cheapestTotal(double target, const CostModel& cost, OracleTools tools = {}) const;

  /// How many of the first `nearLights` a merging of compact groups (within `spread` of their distance from the object)
  /// could save at most.
  int mergeable(int nearLights, double spread) const;

 private:
  std::span<const float> rigRow(int vectors, int light) const;
  const StudyFrame& frame_;
  int vectors_ = 0, lights_ = 0;
  std::size_t row_ = 0;
  std::vector<float> rig_;        // (vectors + 1) x lights x row: irradiance of the rig with J vectors
  std::vector<float> high_;       // lights x row
  std::vector<float> corrector_;  // lights x row
  std::vector<int> spatialOrder_, totalOrder_;
  std::vector<double> exact_;
};

}  // namespace rigel::tools
