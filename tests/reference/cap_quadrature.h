// Integrals over a cap of directions by product quadrature, in double: the check of the closed formulas.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace rigel::reference {

struct Direction {
  double x = 0, y = 0, z = 0;
};

/// Directions of a cap and their solid angles. Exact for polynomials of degree < 30 in the direction.
struct CapNode {
  Direction direction;
  double solidAngle = 0;
};

/// The cap of half-angle `alpha` in [0, pi] about the unit vector `axis`: Gauss-Legendre in the cosine, evenly spaced
/// in azimuth.
std::vector<CapNode> capNodes(const Direction& axis, double alpha);

}  // namespace rigel::reference
