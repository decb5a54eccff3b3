// Nodes along one axis of the box that suit the object's own surface, and the polynomials through them.
#pragma once

#include <rigel/vec3.h>

#include <span>
#include <vector>

namespace rigel {

/// The Gauss quadrature of the surface's distribution along one axis. Interpolation at these nodes is exact for
/// polynomials of their number, and its error is orthogonal to half as many more: of all nodes they are about the best
/// for the error that the surface sees.
struct GaussAxis {
  std::vector<double> node;    // in [-1, 1], ascending
  std::vector<double> weight;  // share of the surface; sums to 1
  std::vector<double> spread;  // mean square distance of the surface that is nearest to the node

  /// `coordinates` of surface points in [-1, 1]; count >= 1. A hundredth of the measure is spread evenly over the axis,
  /// so that there are `count` nodes whatever the surface (a box has points at -1 and 1 alone).
  GaussAxis(std::span<const double> coordinates, int count);

  /// Lagrange polynomials at u: `out` has an entry a node; they sum to 1. Cost 3 products a node.
  void lagrange(float u, std::span<float> out) const noexcept;

  /// The nodes, and 1 / prod_{j != i} (node_i - node_j) for each, in float.
  std::span<const float> nodes() const noexcept { return node_; }
  std::span<const float> inverseScales() const noexcept { return inverseScale_; }

 private:
  std::vector<float> node_;
  std::vector<float> inverseScale_;
};

}  // namespace rigel
