// After A. Sommariva, M. Vianello, "Computing approximate Fekete points by QR factorizations of Vandermonde matrices",
// 2009.
#include "fekete.h"

#include "monomials.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

// As many as points would place each for its own interpolation; least squares wants them to resist what it leaves out.
constexpr int kFunctionsPerPoint = 2;

// Of the largest square; below it a point's values are nothing but rounding of those of the points before.
constexpr double kLostSquare = 1e-24;

/// Function major: row k holds monomial k at every point.
std::vector<double> vandermonde(std::span<const Vec3> surface, int functions) {
  const SurfaceSpread spread = spreadOf(surface);
  const double largest = spread.largest();
  const double scale = largest > 0 ? 1 / (3 * largest) : 0;
  const std::vector<Exponents> order = monomialOrder(spread, functions);
  std::vector<double> rows(order.size() * surface.size());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    std::array<std::array<double, kMaxMonomialDegree + 1>, 3> power;
    for (int a = 0; a < 3; ++a) {
      const double u = (static_cast<double>(surface[i][a]) - spread.mean[a]) * scale;
      power[a][0] = 1;
      for (int e = 1; e <= kMaxMonomialDegree; ++e) power[a][e] = u * power[a][e - 1];
    }
    for (std::size_t k = 0; k < order.size(); ++k)
      rows[k * surface.size() + i] = power[0][order[k][0]] * power[1][order[k][1]] * power[2][order[k][2]];
  }
  return rows;
}

/// What is left of every point's values beyond the points chosen so far.
class Remainders {
 public:
  Remainders(std::span<const Vec3> surface, int functions)
      : points_(surface.size()), rows_(vandermonde(surface, functions)), square_(points_), along_(points_) {
    for (std::size_t r = 0; r < rows_.size(); r += points_)
      for (std::size_t i = 0; i < points_; ++i) square_[i] += rows_[r + i] * rows_[r + i];
  }

  std::span<const double> squares() const noexcept { return square_; }

  /// Takes the direction of `point` out of all.
  void take(std::size_t point) {
    const double own = square_[point];
    std::ranges::fill(along_, 0.0);
    for (std::size_t r = 0; r < rows_.size(); r += points_) {
      const double d = rows_[r + point] / own;
      for (std::size_t i = 0; i < points_; ++i) along_[i] += d * rows_[r + i];
    }
    std::ranges::fill(square_, 0.0);
    for (std::size_t r = 0; r < rows_.size(); r += points_) {
      const double d = rows_[r + point];
      for (std::size_t i = 0; i < points_; ++i) {
        rows_[r + i] -= d * along_[i];
        square_[i] += rows_[r + i] * rows_[r + i];
      }
    }
  }

 private:
  std::size_t points_;
  std::vector<double> rows_;
  std::vector<double> square_, along_;
};

}  // namespace

std::vector<int> feketePoints(std::span<const Vec3> surface, int count, std::span<const int> first) {
  Remainders remainders(surface, kFunctionsPerPoint * count);
  const double least = kLostSquare * std::ranges::max(remainders.squares());
  std::vector<int> chosen;
  while (static_cast<int>(chosen.size()) < count) {
    const bool given = chosen.size() < first.size();
    const auto next =
        given ? static_cast<std::size_t>(first[chosen.size()])
              : static_cast<std::size_t>(std::ranges::max_element(remainders.squares()) - remainders.squares().begin());
    const bool independent = remainders.squares()[next] > least;
    if (!given && !independent) break;
    chosen.push_back(static_cast<int>(next));
    if (independent) remainders.take(next);
  }
  return chosen;
}

Anchors feketeAnchors(std::span<const Vec3> surface, int count, SurfaceEnds ends) {
  std::vector<int> first;
  if (ends == SurfaceEnds::anchored) first = endsOf(surface, count / 2);
  return patchesOf(surface, feketePoints(surface, count, first));
}

}  // namespace rigel
