// Least squares over points on the object's own surface: how poly rigs, and tensor rigs @lsq, get their coefficients.
#pragma once

#include "least_squares.h"
#include "model.h"

namespace rigel {

class SurfaceFit {
 public:
  /// Sets up samples and (dense) operator of `model`, which has `constant.size()` SH vectors. `constant`: the
  /// coefficients of the function 1 in the model's basis. At most LeastSquares::kMaxPoints anchors.
  SurfaceFit(Rig::Model& model, const Anchors& anchors, std::vector<double> constant);

  /// Moves samples and operator to a pose; the model's basis must be that of the pose already.
  void setPose(Rig::Model& model, const RigPose& pose) noexcept;

  /// Makes the operator that of basis functions divided by `q` (at each anchor, > 0), which is what the model's basis
  /// is from now to the next pose.
  void rescale(Rig::Model& model, std::span<const float> q) noexcept;

  std::span<const float> shares() const noexcept { return shares_; }

 private:
  std::vector<float> shares_;   // of the surface's area, per anchor
  std::vector<float> weights_;  // of rescale
  std::vector<double> constant_;
  LeastSquares leastSquares_;
};

}  // namespace rigel
