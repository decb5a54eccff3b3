#include "probe_patch.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace rigel {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void ProbePatch::hold(const Vector3d& x) noexcept {
  const double out = x.dot(shape_.inverse() * x);
  if (out > 1) shape_ += (1 - 1 / out) * x * x.transpose();
}

// For any unit u, u.x - sqrt(u^T M u) is no more than the distance. It is the distance for u along (M + mu)^-1 x, mu
// the root of |M^(1/2) (M + mu)^-1 x| = 1 (J. Moré, D. Sorensen 1983, whose Newton steps these are).
double ProbePatch::distance(const Vector3d& x) const noexcept {
  constexpr int kSteps = 4;
  double mu = std::max(0.0, std::sqrt(x.dot(shape_ * x)) - shape_.trace());
  Vector3d u;
  for (int step = 0;; ++step) {
    const Matrix3d inverse = (shape_ + mu * Matrix3d::Identity()).inverse();
    u = inverse * x;
    const Vector3d across = shape_ * u;
    const double size = std::sqrt(u.dot(across));
    if (step == kSteps) return std::max(0.0, (u.dot(x) - size) / u.norm());
    mu = std::max(0.0, mu + (size - 1) * size * size / across.dot(inverse * u));
  }
}

// Duality: for mu > 0 no more than the least of value + slope.x + x^T curvature x + mu (x^T shape^-1 x - 1), where
// x = -z shape / 2. As above, the best mu is a root of |shape^(-1/2) x| = 1.
double ProbePatch::least(double value, const Vector3d& slope, const Matrix3d& curvature) const noexcept {
  constexpr int kSteps = 6;
  constexpr double kLeastShare = 1e-4;
  const Matrix3d bent = shape_ * curvature * shape_;
  const Vector3d across = shape_ * slope;
  const double most = std::sqrt(slope.dot(across)) / 2;
  double least = 0;
  double mu = most;
  for (int step = 0; step < kSteps && mu > 0; ++step) {
    const Matrix3d inverse = (bent + mu * shape_).inverse();
    const Vector3d z = inverse * across;
    least = std::max(least, value - mu - across.dot(z) / 4);
    const Vector3d held = shape_ * z;
    const double size = std::sqrt(z.dot(held)) / 2;
    mu = std::clamp(mu + (size - 1) * size * size / (held.dot(inverse * held) / 4), kLeastShare * most, most);
  }
  return most > 0 ? least : value;
}

}  // namespace rigel
