// What an oracle would choose: the cheapest number of SH vectors and near lights that truly meets a target.
#pragma once

#include "study/study_frames.h"

#include <rigel/object_lighting.h>

namespace rigel::tools {

/// A choice of nested coefficients, near lights and high band, with its modelled cost.
struct OracleChoice {
  int vectors = 0, nearLights = 0;
  bool highBand = false;
  float nanoseconds = 0;
};

/// True errors of every choice in one frame, near lights taken in the order of their own error.
class NestedOracle {
 public:
  /// `rig` is an `auto` rig, posed.
  NestedOracle(const StudyFrame& frame, const Rig& rig, float wrap);

  int vectors() const { return vectors_; }
  int lights() const { return lights_; }
  /// Mean squares [W/m2]^2 over points and channels.
  double spatialSquare(int vectors, int nearLights) const;
  double totalSquare(int vectors, int nearLights, bool highBand) const;

  OracleChoice cheapestSpatial(double target, const CostModel& cost) const;
  OracleChoice cheapestTotal(double target, const CostModel& cost) const;

 private:
  std::span<const float> rigRow(int vectors, int light) const;
  template <class Square>
  OracleChoice cheapest(double target, const CostModel& cost, int variants, Square square) const;

  const StudyFrame& frame_;
  int vectors_ = 0, lights_ = 0;
  std::size_t row_ = 0;
  std::vector<float> rig_;   // (vectors + 1) x lights x row: irradiance of the rig with J vectors
  std::vector<float> high_;  // lights x row
  std::vector<int> spatialOrder_, totalOrder_;
  std::vector<double> exact_;
};

}  // namespace rigel::tools
