#include "least_squares.h"

#include <rigel/rig_spec.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

constexpr int kMaxFunctions = kMaxLsqVectors;
constexpr int kMaxPoints = LeastSquares::kMaxPoints;
constexpr double kRidge = LeastSquares::kRidge;
constexpr double kLeastSquare = LeastSquares::kLeastSquare;
static_assert(kMaxPoints >= 2 * kMaxLsqVectors);

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxPoints, kMaxFunctions>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxFunctions, kMaxFunctions>;
using RightSide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxFunctions, kMaxPoints>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxFunctions, 1>;

}  // namespace

struct LeastSquares::Workspace {
  RowMatrix a;
  Square normal;
  RightSide right;
  Vector scale;
  Eigen::LLT<Square> factor;
};

LeastSquares::LeastSquares(int points, int functions) : work_(std::make_unique<Workspace>()) {
  work_->a.setZero(points, functions);
}
LeastSquares::~LeastSquares() = default;
LeastSquares::LeastSquares(LeastSquares&&) noexcept = default;

std::span<double> LeastSquares::row(int point) noexcept {
  return {&work_->a(point, 0), static_cast<std::size_t>(work_->a.cols())};
}

double LeastSquares::solve(std::span<const float> weights, std::span<const double> constant,
                           std::span<float> op) noexcept {
  auto& [a, normal, right, scale, factor] = *work_;
  const auto points = a.rows();
  const auto functions = a.cols();

  // Normal equations of the deviation from the mean sample: c = 1 * mean + delta, A delta ~ F - mean. Squaring the
  // condition number is harmless in double: bases are normalised to the box.
  right.resize(functions, points);
  for (Eigen::Index s = 0; s < points; ++s) right.col(s) = a.row(s).transpose() * static_cast<double>(weights[s]);
  normal.noalias() = right.lazyProduct(a);
  // Unit diagonal: neither ridge nor condition number depends on the functions' units. A function that is zero at every
  // point (a flat object) keeps coefficient 0.
  scale = normal.diagonal().unaryExpr([](double d) { return d > kLeastSquare ? 1 / std::sqrt(d) : 0.0; });
  for (Eigen::Index k = 0; k < functions; ++k) {
    for (Eigen::Index j = 0; j < functions; ++j) normal(j, k) *= scale(j) * scale(k);
    normal(k, k) = scale(k) > 0 ? 1 + kRidge : 1;
  }
  factor.compute(normal);

  // Row sums against the mean: (A^T W)(I - 1 w^T).
  const Vector total = right.rowwise().sum();
  for (Eigen::Index s = 0; s < points; ++s) right.col(s) -= total * static_cast<double>(weights[s]);
  for (Eigen::Index k = 0; k < functions; ++k) right.row(k) *= scale(k);
  factor.solveInPlace(right);
  for (Eigen::Index k = 0; k < functions; ++k)
    for (Eigen::Index s = 0; s < points; ++s)
      op[static_cast<std::size_t>(k * points + s)] =
          static_cast<float>(scale(k) * right(k, s) + constant[k] * static_cast<double>(weights[s]));

  return std::sqrt(1 / std::max(factor.rcond(), 1e-30));
}

}  // namespace rigel
