// Least squares over points on the object's own surface: how poly rigs, and tensor rigs @lsq, get their coefficients.
#pragma once

#include "least_squares.h"
#include "model.h"

namespace rigel {

class SurfaceFit {
 public:
  /// Chooses the anchors and sets up samples and (dense) operator of `model`, which has `constant.size()` SH vectors.
  /// `constant`: the coefficients of the function 1 in the model's basis. Two points a vector: as many points as
  /// vectors leave the fit at the mercy of each single point.
  SurfaceFit(Rig::Model& model, std::span<const Vec3> surface, std::vector<double> constant);

  /// Moves samples and operator to a pose; the model's basis must be that of the pose already.
  void setPose(Rig::Model& model, const RigPose& pose) noexcept;

 private:
  std::vector<float> shares_;  // of the surface's area, per anchor
  std::vector<double> constant_;
  LeastSquares leastSquares_;
};

}  // namespace rigel
