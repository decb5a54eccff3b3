#include "nested_fit.h"

#include "row_kernels.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

// Square of the share of a function that its predecessors do not span, at which it counts half.
constexpr double kDamping = 1e-5;

}  // namespace

NestedFit::NestedFit(int points, int functions)
    : points_(points),
      functions_(functions),
      phi_(static_cast<std::size_t>(points) * functions),
      basis_(phi_.size()),
      toGiven_(static_cast<std::size_t>(functions) * functions),
      steps_(phi_.size()),
      analysis_(phi_.size()),
      fitted_(phi_.size()),
      given_(toGiven_.size()),
      damping_(functions) {}

std::span<double> NestedFit::row(int point) noexcept {
  return {&phi_[static_cast<std::size_t>(point) * functions_], static_cast<std::size_t>(functions_)};
}

void NestedFit::factor(std::span<const float> shares) noexcept {
  for (int s = 0; s < points_; ++s) {
    const double root = std::sqrt(static_cast<double>(shares[s]));
    const auto phi = row(s);
    for (int k = 0; k < functions_; ++k) function(k)[s] = phi[k] * root;
  }
  orthonormalise();
  joinSteps();
  for (int j = 0; j < functions_; ++j) {
    const double scale = damped(j);
    for (int k = 0; k < functions_; ++k)
      given_[static_cast<std::size_t>(k) * functions_ + j] = static_cast<float>(given(j)[k] * scale);
  }
}

/// What function k takes over its coefficient, which is scaled to the energy that is taken (`analyse`).
double NestedFit::damped(int k) const noexcept {
  const auto d = static_cast<double>(damping_[k]);
  return std::sqrt(d / (2 - d));
}

void NestedFit::orthonormalise() noexcept {
  const std::size_t count = points_;
  std::ranges::fill(toGiven_, 0.0);
  for (int k = 0; k < functions_; ++k) {
    double* own = function(k);
    given(k)[k] = 1;
    const double norm = std::sqrt(rowkernels::product(own, own, count));
    // Twice is enough: what rounding leaves after the first pass is taken out by the second.
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < k; ++j) {
        const double along = static_cast<double>(damping_[j]) * rowkernels::product(function(j), own, count);
        rowkernels::addScaled(-along, function(j), count, own);
        rowkernels::addScaled(-along, given(j), static_cast<std::size_t>(j) + 1, given(k));
      }
    }
    const double rest = std::sqrt(rowkernels::product(own, own, count));
    const double share = norm > 0 ? rest / norm : 0;
    damping_[k] = static_cast<float>(share * share / (share * share + kDamping));
    // A column that is nothing but rounding has no direction.
    const double scale = share > 1e-9 ? 1 / rest : 0;
    for (int s = 0; s < points_; ++s) own[s] *= scale;
    for (int i = 0; i <= k; ++i) given(k)[i] *= scale;
  }
}

/// The analysis takes function after function from the values r: a_k = q_k.r, r -= d_k a_k q_k. Only what the damped
/// function takes: the direction of one that is nothing but rounding is random, and must not hide its part of the light
/// from the functions after it. Of the values before the first step that is a_k = u_k.v, with
///   u_k = q_k - sum_{j<k} d_j (q_j.q_k) u_j, and what is left in the end v - sum_k d_k q_k (u_k.v).
void NestedFit::joinSteps() noexcept {
  const std::size_t count = points_;
  for (int k = 0; k < functions_; ++k) {
    double* step = &steps_[static_cast<std::size_t>(k) * count];
    std::copy_n(function(k), count, step);
    for (int j = 0; j < k; ++j) {
      const double along = static_cast<double>(damping_[j]) * rowkernels::product(function(j), function(k), count);
      rowkernels::addScaled(-along, &steps_[static_cast<std::size_t>(j) * count], count, step);
    }
    const auto d = static_cast<double>(damping_[k]);
    const double energy = std::sqrt(d * (2 - d)), taken = damped(k);
    for (std::size_t s = 0; s < count; ++s) {
      analysis_[static_cast<std::size_t>(k) * count + s] = static_cast<float>(energy * step[s]);
      fitted_[s * static_cast<std::size_t>(functions_) + k] = static_cast<float>(taken * function(k)[s]);
    }
  }
}

void NestedFit::analyse(const float* values, int width, float* coefficients, float* residuals) const noexcept {
  const std::size_t functions = functions_, points = points_;
  rowkernels::multiply(analysis_.data(), functions, points, values, width, coefficients);
  rowkernels::subtractProduct(values, fitted_.data(), points, functions, coefficients, width, residuals);
}

void NestedFit::synthesise(const float* coefficients, int stride, int width, std::span<const float> weights,
                           float* out) const noexcept {
  const int count = static_cast<int>(weights.size());
  for (int k = 0; k < count; ++k) {
    float* c = out + static_cast<std::size_t>(k) * width;
    std::fill_n(c, width, 0.0f);
    for (int j = k; j < count; ++j) {
      const float g = given_[static_cast<std::size_t>(k) * functions_ + j] * weights[j];
      const float* a = coefficients + static_cast<std::size_t>(j) * stride;
      for (int i = 0; i < width; ++i) c[i] += g * a[i];
    }
  }
}

}  // namespace rigel
