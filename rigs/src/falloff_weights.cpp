#include "falloff_weights.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

using Point = std::array<double, 3>;

constexpr int kDegrees = detail::SamplePlan::kMaxDegree + 1;

/// Of (c + h v)^m, the coefficients of v.
class Expansion {
 public:
  Expansion(double c, double h, int degree) noexcept {
    at_[0][0] = 1;
    for (int m = 1; m <= degree; ++m) {
      at_[m][0] = c * at_[m - 1][0];
      for (int i = 1; i < m; ++i) at_[m][i] = c * at_[m - 1][i] + h * at_[m - 1][i - 1];
      at_[m][m] = h * at_[m - 1][m - 1];
    }
  }
  double operator()(int m, int i) const noexcept { return at_[m][i]; }

 private:
  double at_[kDegrees][kDegrees];
};

}  // namespace

FalloffWeights::FalloffWeights(const Falloff& falloff) noexcept : floor_(falloff.least()) {
  const auto& [xx, yy, zz, xy, xz, yz, x, y, z, one] = falloff.coefficients();
  square_ = {xx, yy, zz};
  cross_ = {yz, xz, xy};
  linear_ = {x, y, z};
  one_ = one;
}

double FalloffWeights::q(const Point& u) const noexcept {
  double sum = one_;
  for (int a = 0; a < 3; ++a)
    sum += u[a] * (linear_[a] + square_[a] * u[a]) + cross_[a] * u[(a + 1) % 3] * u[(a + 2) % 3];
  return std::max(sum, floor_);
}

Point FalloffWeights::slope(const Point& u) const noexcept {
  Point g;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    g[a] = linear_[a] + 2 * square_[a] * u[a] + cross_[c] * u[b] + cross_[b] * u[c];
  }
  return g;
}

double FalloffWeights::leastOver(const WeightCell& cell) const noexcept {
  const Point g = slope(cell.centre);
  double least = q(cell.centre);
  for (int a = 0; a < 3; ++a) {
    // Along the axis alone: down to the vertex, where that is within the cell.
    const double h = cell.half[a];
    const double vertex = square_[a] > 0 ? std::min(h, std::abs(g[a]) / (2 * square_[a])) : h;
    least += vertex * (square_[a] * vertex - std::abs(g[a]));
    least -= std::abs(cross_[a]) * cell.half[(a + 1) % 3] * cell.half[(a + 2) % 3];
  }
  return std::max(least, floor_);
}

WeightCell FalloffWeights::halved(const WeightCell& cell, double side) const noexcept {
  const Point g = slope(cell.centre);
  Point fall;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    fall[a] = cell.half[a] * (std::abs(g[a]) + std::abs(square_[a]) * cell.half[a] +
                              std::abs(cross_[c]) * cell.half[b] + std::abs(cross_[b]) * cell.half[c]);
  }
  const auto axis = std::ranges::max_element(fall) - fall.begin();
  WeightCell part = cell;
  ++part.halvings;
  part.half[axis] /= 2;
  part.centre[axis] += side * cell.half[axis];
  return part;
}

template <class Float>
double FalloffWeights::raise(const WeightCell& part, const Polynomials<Float>& g,
                             std::span<Float> most) const noexcept {
  constexpr int kMax = detail::SamplePlan::kMaxSamples;
  const double inverse = 1 / leastOver(part);
  const auto columns = static_cast<std::size_t>(g.columns);
  std::array<Float, kMax> size, coefficient;  // of the columns
  std::fill_n(size.begin(), columns, Float{});
  int degree = 0;
  for (const Degrees& m : g.monomials) degree = std::max<int>(degree, std::ranges::max(m));
  const Expansion x(part.centre[0], part.half[0], degree);
  const Expansion y(part.centre[1], part.half[1], degree);
  const Expansion z(part.centre[2], part.half[2], degree);
  for (const Degrees& alpha : g.monomials) {
    std::fill_n(coefficient.begin(), columns, Float{});
    for (std::size_t k = 0; k < g.monomials.size(); ++k) {
      const Degrees& m = g.monomials[k];
      if (m[0] < alpha[0] || m[1] < alpha[1] || m[2] < alpha[2]) continue;
      const double factor = inverse * x(m[0], alpha[0]) * y(m[1], alpha[1]) * z(m[2], alpha[2]);
      const auto f = static_cast<Float>(factor);
      const Float* row = g.coefficients.data() + k * columns;
      for (std::size_t s = 0; s < columns; ++s) coefficient[s] += f * row[s];
    }
    for (std::size_t s = 0; s < columns; ++s) size[s] += std::abs(coefficient[s]);
  }
  double sum = 0;
  for (std::size_t s = 0; s < columns; ++s) {
    most[s] = std::max(most[s], size[s]);
    sum += static_cast<double>(size[s]);
  }
  return sum;
}

template double FalloffWeights::raise(const WeightCell&, const Polynomials<float>&, std::span<float>) const noexcept;
template double FalloffWeights::raise(const WeightCell&, const Polynomials<double>&, std::span<double>) const noexcept;

}  // namespace rigel
