// The least-squares operator of a rig: from values at S points to K coefficients, without allocation.
#pragma once

#include <memory>
#include <span>

namespace rigel {

/// Finds P that minimises sum_s w_s |sum_k A_sk (P F)_k - F_s|^2, with a slight pull of every coefficient's deviation
/// from the constant function. The pull keeps P finite and continuous in A where the points cannot tell basis functions
/// apart (a hard rank decision would make lighting jump), and it leaves constant light exact.
class LeastSquares {
 public:
  static constexpr int kMaxPoints = 128;  // at least two a function

  /// Pull per coefficient, on a normal matrix of unit diagonal. Its relative effect on a function that the basis spans
  /// is this times the squared condition number: 1e-4 for a condition of 10. It bounds the condition that can be seen
  /// at 1e3.
  static constexpr double kRidge = 1e-6;

  static constexpr double kLeastSquare = 1e-24;  // of a function's mean square below which it counts as zero

  LeastSquares(int points, int functions);
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;

  /// A_sk of one point, to be written before solve.
  std::span<double> row(int point) noexcept;

  /// `weights`: w_s, sum 1. `constant`: the coefficients of the function 1. Writes P, K rows of S. Returns the
  /// estimated condition number of the weighted A (2-norm).
  double solve(std::span<const float> weights, std::span<const double> constant, std::span<float> op) noexcept;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace rigel
