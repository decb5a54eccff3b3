// The surface about a probe: an ellipsoid that holds it, flat where the surface is.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace rigel {

/// Points x about a probe with x^T shape^-1 x <= 1.
class ProbePatch {
 public:
  ProbePatch() = default;
  explicit ProbePatch(const Eigen::Matrix3d& shape) noexcept : shape_(shape) {}

  const Eigen::Matrix3d& shape() const noexcept { return shape_; }

  /// The patch is in a ball of this radius.
  double radius() const noexcept { return std::sqrt(shape_.trace()); }

  /// Enlarged until it holds x.
  void hold(const Eigen::Vector3d& x) noexcept;

  /// Distance from `x` to the patch, or less; continuous.
  double distance(const Eigen::Vector3d& x) const noexcept;

  /// The same from the way to the probe alone.
  double distanceAlong(const Eigen::Vector3d& x) const noexcept {
    const double square = x.squaredNorm();
    return square > 0 ? std::max(0.0, std::sqrt(square) - std::sqrt(x.dot(shape_ * x) / square)) : 0;
  }

  /// The least that value + slope.x + x^T curvature x can be over the patch, or less; continuous.
  double least(double value, const Eigen::Vector3d& slope, const Eigen::Matrix3d& curvature) const noexcept;

 private:
  Eigen::Matrix3d shape_ = Eigen::Matrix3d::Zero();
};

}  // namespace rigel
