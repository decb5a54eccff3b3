#include "monomials.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rigel {
namespace {

constexpr int kMaxDegree = kMaxMonomialDegree;
static_assert((kMaxDegree + 1) * (kMaxDegree + 2) * (kMaxDegree + 3) / 6 == kMaxMonomials);

}  // namespace

double SurfaceSpread::largest() const noexcept { return std::max({sigma[0], sigma[1], sigma[2]}); }

SurfaceSpread spreadOf(std::span<const Vec3> surface) {
  SurfaceSpread spread;
  const auto count = static_cast<double>(surface.size());
  for (int a = 0; a < 3; ++a) {
    for (Vec3 p : surface) spread.mean[a] += static_cast<double>(p[a]);
    spread.mean[a] /= count;
    double square = 0;
    for (Vec3 p : surface) {
      const double d = static_cast<double>(p[a]) - spread.mean[a];
      square += d * d;
    }
    spread.sigma[a] = std::sqrt(square / count);
  }
  return spread;
}

std::vector<Exponents> monomialOrder(const SurfaceSpread& spread, int terms) {
  const double largest = spread.largest();
  std::array<double, 3> logScale{};
  // An axis hundreds of times thinner than the longest carries nothing; the floor keeps logarithms finite.
  for (int a = 0; a < 3; ++a) logScale[a] = std::log(std::max(largest > 0 ? spread.sigma[a] / largest : 1.0, 1e-9) / 3);

  std::vector<Exponents> all;
  for (int x = 0; x <= kMaxDegree; ++x)
    for (int y = 0; x + y <= kMaxDegree; ++y)
      for (int z = 0; x + y + z <= kMaxDegree; ++z) all.push_back({x, y, z});
  const auto rank = [&](const Exponents& e) {
    const double score = e[0] * logScale[0] + e[1] * logScale[1] + e[2] * logScale[2];
    return std::tuple(-score, e[0] + e[1] + e[2], -e[0], -e[1]);
  };
  std::ranges::stable_sort(all, {}, rank);
  all.resize(static_cast<std::size_t>(std::min(terms, kMaxMonomials)));
  return all;
}

}  // namespace rigel
