// Monomials in the order in which light over a surface needs them.
#pragma once

#include <rigel/vec3.h>

#include <array>
#include <span>
#include <vector>

namespace rigel {

/// Mean and standard deviation of surface points along each axis [m].
struct SurfaceSpread {
  std::array<double, 3> mean{}, sigma{};

  double largest() const noexcept;  // sigma
};
SurfaceSpread spreadOf(std::span<const Vec3> surface);

using Exponents = std::array<int, 3>;  // of x, y, z

inline constexpr int kMaxMonomialDegree = 16;
inline constexpr int kMaxMonomials = 969;  // up to that degree

/// The first `terms` (at most kMaxMonomials) exponents by decreasing prod_a (sigma_a / (3 sigma_max))^e_a, how strongly
/// a monomial of ((p - mean)/sigma) is taken to occur in light; ties by degree, then x before y before z. Divisors come
/// before what they divide.
std::vector<Exponents> monomialOrder(const SurfaceSpread& spread, int terms);

}  // namespace rigel
