#include "nested_fit.h"

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
      basis_(static_cast<std::size_t>(points) * functions),
      toGiven_(static_cast<std::size_t>(functions) * functions),
      orthonormal_(basis_.size()),
      given_(toGiven_.size()),
      damping_(functions) {}

std::span<double> NestedFit::row(int point) noexcept {
  return {&basis_[static_cast<std::size_t>(point) * functions_], static_cast<std::size_t>(functions_)};
}

void NestedFit::factor(std::span<const float> shares) noexcept {
  const int n = functions_;
  const auto at = [&](int point, int k) -> double& { return basis_[static_cast<std::size_t>(point) * n + k]; };
  const auto given = [&](int k, int j) -> double& { return toGiven_[static_cast<std::size_t>(k) * n + j]; };
  const auto columnNorm = [&](int k) {
    double sum = 0;
    for (int s = 0; s < points_; ++s) sum += at(s, k) * at(s, k);
    return std::sqrt(sum);
  };
  for (int s = 0; s < points_; ++s) {
    const double root = std::sqrt(static_cast<double>(shares[s]));
    for (int k = 0; k < n; ++k) at(s, k) *= root;
  }
  std::ranges::fill(toGiven_, 0.0);
  for (int k = 0; k < n; ++k) {
    given(k, k) = 1;
    const double norm = columnNorm(k);
    // Twice is enough: what rounding leaves after the first pass is taken out by the second.
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < k; ++j) {
        double along = 0;
        for (int s = 0; s < points_; ++s) along += at(s, j) * at(s, k);
        along *= static_cast<double>(damping_[j]);
        for (int s = 0; s < points_; ++s) at(s, k) -= along * at(s, j);
        for (int i = 0; i <= j; ++i) given(i, k) -= along * given(i, j);
      }
    }
    const double rest = columnNorm(k);
    const double own = norm > 0 ? rest / norm : 0;
    damping_[k] = static_cast<float>(own * own / (own * own + kDamping));
    // A column that is nothing but rounding has no direction.
    const double scale = own > 1e-9 ? 1 / rest : 0;
    for (int s = 0; s < points_; ++s) at(s, k) *= scale;
    for (int i = 0; i <= k; ++i) given(i, k) *= scale;
  }
  for (int k = 0; k < n; ++k) {
    for (int s = 0; s < points_; ++s)
      orthonormal_[static_cast<std::size_t>(k) * points_ + s] = static_cast<float>(at(s, k));
    // Back from coefficients that are scaled to the energy they take (`analyse`).
    for (int j = 0; j < n; ++j) {
      const auto d = static_cast<double>(damping_[j]);
      given_[static_cast<std::size_t>(k) * n + j] = static_cast<float>(given(k, j) * std::sqrt(d / (2 - d)));
    }
  }
}

void NestedFit::analyse(const float* values, int width, float* coefficients, float* residuals) const noexcept {
  std::copy_n(values, static_cast<std::size_t>(points_) * width, residuals);
  for (int k = 0; k < functions_; ++k) {
    float* a = coefficients + static_cast<std::size_t>(k) * width;
    const float* q = &orthonormal_[static_cast<std::size_t>(k) * points_];
    std::fill_n(a, width, 0.0f);
    for (int s = 0; s < points_; ++s) {
      const float* r = residuals + static_cast<std::size_t>(s) * width;
      for (int i = 0; i < width; ++i) a[i] += q[s] * r[i];
    }
    // Only what the damped function takes: the direction of one that is nothing but rounding is random, and must not
    // hide its part of the light from the functions after it.
    for (int s = 0; s < points_; ++s) {
      float* r = residuals + static_cast<std::size_t>(s) * width;
      const float taken = damping_[k] * q[s];
      for (int i = 0; i < width; ++i) r[i] -= taken * a[i];
    }
    const float energy = std::sqrt(damping_[k] * (2 - damping_[k]));
    for (int i = 0; i < width; ++i) a[i] *= energy;
  }
}

void NestedFit::synthesise(const float* coefficients, int width, std::span<const float> weights,
                           float* out) const noexcept {
  const int count = static_cast<int>(weights.size());
  for (int k = 0; k < count; ++k) {
    float* c = out + static_cast<std::size_t>(k) * width;
    std::fill_n(c, width, 0.0f);
    for (int j = k; j < count; ++j) {
      const float g = given_[static_cast<std::size_t>(k) * functions_ + j] * weights[j];
      const float* a = coefficients + static_cast<std::size_t>(j) * width;
      for (int i = 0; i < width; ++i) c[i] += g * a[i];
    }
  }
}

}  // namespace rigel
