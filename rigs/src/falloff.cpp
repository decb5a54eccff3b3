#include "falloff.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

// Pull of q towards 1, against a mean weight of 1 on the samples: a hundredth of what evenly lit samples say.
constexpr double kRidge = 1e-3;

// Light of this share of the mean is added to every sample, so that one without light does not ask for an infinite q.
constexpr double kLeastStrength = 1e-3;

// Least eigenvalue of the definite part, relative to the largest: it bounds how sharply 1/q may peak. Far above the
// rounding of ten float coefficients, far below the 1/D^2 that the curvature of a light D half extents away needs.
constexpr double kLeast = 1e-4;

// How much of q's constant may bend down to the box's circumscribed ball. Light from both ends leaves the middle dim
// and q concave, which no definite Q can be; 1/3 would let q reach 0 at the ball. Over tools/study/rig_ratios.py, error
// against poly:6: 0.80 for 0, 0.78 for 0.05 and 0.2.
constexpr double kBend = 0.2;

// Rounds of the alternating directions below, and how firmly each holds to the last. Where the samples leave a
// direction of q open (|u|^2 on a ball) it takes this many to find the positive q among those that fit as well;
// elsewhere 2 or 3.
constexpr int kRounds = 12;
constexpr double kHold = 1e-2;

using Vector10 = Eigen::Matrix<double, 10, 1>;
using Square10 = Eigen::Matrix<double, 10, 10>;

Vector10 monomials(Vec3 p) noexcept {
  const double x = static_cast<double>(p.x);
  const double y = static_cast<double>(p.y);
  const double z = static_cast<double>(p.z);
  Vector10 m;
  m << x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, 1;
  return m;
}

Eigen::Matrix4d symmetric(const Vector10& c) noexcept {
  Eigen::Matrix4d q;
  q << c(0), c(3) / 2, c(4) / 2, c(6) / 2,  //
      c(3) / 2, c(1), c(5) / 2, c(7) / 2,   //
      c(4) / 2, c(5) / 2, c(2), c(8) / 2,   //
      c(6) / 2, c(7) / 2, c(8) / 2, c(9);
  return q;
}

Vector10 coefficientsOf(const Eigen::Matrix4d& q) noexcept {
  Vector10 c;
  c << q(0, 0), q(1, 1), q(2, 2), 2 * q(0, 1), 2 * q(0, 2), 2 * q(1, 2), 2 * q(0, 3), 2 * q(1, 3), 2 * q(2, 3), q(3, 3);
  return c;
}

/// The nearest of the matrices D + tau diag(-1, -1, -1, 3) with D positive definite, tau >= 0 as large as q is concave.
/// At least `least` > 0, D's least eigenvalue, where |u|^2 <= 3, and so in the box. Every step is continuous in `q`.
Eigen::Matrix4d madePositive(Eigen::Matrix4d q, double& least) noexcept {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> curvature(q.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly);
  const double tau = std::clamp(-curvature.eigenvalues()(0), 0.0, kBend * std::max(q(3, 3), 0.0));
  const Eigen::Vector4d ball(-tau, -tau, -tau, 3 * tau);
  q.diagonal() -= ball;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(q);
  const double allowed = kLeast * eigen.eigenvalues().cwiseAbs().maxCoeff();
  least = std::max(allowed, eigen.eigenvalues()(0));
  q = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(allowed).asDiagonal() * eigen.eigenvectors().transpose();
  q.diagonal() += ball;
  return q;
}

}  // namespace

void Falloff::reset() noexcept {
  coefficient_ = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  least_ = 1;
}

void Falloff::fit(std::span<const Vec3> u, std::span<const float> weight, std::span<const double> strength) noexcept {
  reset();
  double mean = 0;
  for (std::size_t s = 0; s < u.size(); ++s) mean += static_cast<double>(weight[s]) * strength[s];
  if (!(mean > 0) || !std::isfinite(mean)) return;

  // Scaled so that q = 1 is right where the light is the mean.
  Square10 normal = Square10::Identity() * kRidge;
  Vector10 right = Vector10::Zero();
  right(9) = kRidge;
  for (std::size_t s = 0; s < u.size(); ++s) {
    const double g = strength[s] / mean + kLeastStrength;
    const double w = static_cast<double>(weight[s]);
    const Vector10 m = monomials(u[s]);
    normal.noalias() += (w * g * g) * m * m.transpose();
    right += (w * g) * m;
  }
  // The fit among the positive q: alternating direction method of multipliers (S. Boyd et al., "Distributed
  // Optimization and Statistical Learning via ADMM", 2011, section 5). A fixed number of continuous steps is
  // continuous.
  normal.diagonal().array() += kHold;
  const Eigen::LDLT<Square10> factor(normal);
  Vector10 c = Vector10::Zero();
  c(9) = 1;
  Vector10 gap = Vector10::Zero();
  double least = 1;
  for (int round = 0; round < kRounds; ++round) {
    const Vector10 solved = factor.solve(right + kHold * (c - gap));
    c = coefficientsOf(madePositive(symmetric(solved + gap), least));
    gap += solved - c;
  }
  if (!c.allFinite()) return;
  for (int i = 0; i < 10; ++i) coefficient_[i] = static_cast<float>(c(i));
  constexpr double kRounded = 0.99;  // ten coefficients as floats, against kLeast
  least_ = kRounded * least;
}

}  // namespace rigel
