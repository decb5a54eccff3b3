// Sample points that tell polynomials apart: approximate Fekete points of an object's surface.
#pragma once

#include "anchors.h"

namespace rigel {

/// Pivots of a QR factorisation of the transposed Vandermonde matrix: each next point is the one whose values of the
/// monomials are farthest from the span of those of the points before it. Monomials of (p - mean)/(3 sigma_max), twice
/// as many as points, in `monomialOrder`: the scale makes a monomial as large as it is likely to occur in light, so
/// that those beyond a rig's own, which would disturb its fit, count for what they do.
/// `first` are chosen before all others. Fewer than `count` points where the surface does not tell more apart.
/// Deterministic. Cost 4 x points x count^2 multiplications (2 ms for 1024 and 32); allocates.
std::vector<int> feketePoints(std::span<const Vec3> surface, int count, std::span<const int> first = {});

/// `feketePoints`, each with the patch of points nearest to it.
Anchors feketeAnchors(std::span<const Vec3> surface, int count, SurfaceEnds ends = SurfaceEnds::represented);

}  // namespace rigel
