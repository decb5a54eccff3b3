// Least squares in a nested family: the first J functions, fitted alone, have the same coefficients for every J.
#pragma once

#include <span>
#include <vector>

namespace rigel {

/// Orthonormal functions over weighted points, from given functions by Gram-Schmidt in their order. What a light adds
/// to each, and what it leaves beyond all of them, are then plain rows that add up from light to light. A function that
/// its predecessors nearly span is faded out (`damping`), not dropped: nothing jumps as a pose passes through such a
/// case.
class NestedFit {
 public:
  NestedFit(int points, int functions);

  int points() const noexcept { return points_; }
  int functions() const noexcept { return functions_; }

  /// phi_k of one point, to be written before `factor`.
  std::span<double> row(int point) noexcept;

  /// `shares` of the surface that the points stand for, sum 1. Allocates nothing.
  void factor(std::span<const float> shares) noexcept;

  /// Splits values at the points (`width` floats a point, already times sqrt(share)) into the coefficients of the
  /// orthonormal functions (functions x width) and what is left (points x width); the two hold all energy of the
  /// values. A damped function takes its share of the energy and leaves the rest.
  void analyse(const float* values, int width, float* coefficients, float* residuals) const noexcept;

  /// Coefficients of the first `count` given functions for orthonormal coefficients times `weights`. Rows of
  /// `coefficients` are `stride` floats apart; `out` has count x width floats.
  void synthesise(const float* coefficients, int stride, int width, std::span<const float> weights,
                  float* out) const noexcept;

  /// In [0, 1]: how much of its coefficient each orthonormal function takes.
  std::span<const float> damping() const noexcept { return damping_; }

 private:
  int points_, functions_;
  double* function(int k) noexcept { return &basis_[static_cast<std::size_t>(k) * points_]; }
  double* given(int j) noexcept { return &toGiven_[static_cast<std::size_t>(j) * functions_]; }
  void orthonormalise() noexcept;
  void joinSteps() noexcept;
  double damped(int k) const noexcept;

  std::vector<double> phi_;      // points x functions
  std::vector<double> basis_;    // functions x points: phi, then orthonormal, times sqrt(share)
  std::vector<double> toGiven_;  // functions x functions: orthonormal j is sum_k toGiven[j][k] phi_k
  std::vector<double> steps_;    // functions x points: what the steps before leave of each function
  std::vector<float> analysis_;  // functions x points: coefficients from the points' values
  std::vector<float> fitted_;    // points x functions: from coefficients, what they take of the values
  std::vector<float> given_;     // toGiven_ times damping, in float: of function k, for each orthonormal one
  std::vector<float> damping_;
};

}  // namespace rigel
