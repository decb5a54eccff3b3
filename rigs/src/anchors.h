// Sample points on an object's own surface.
#pragma once

#include <rigel/vec3.h>

#include <span>
#include <vector>

namespace rigel {

/// Points of the surface that represent it, and the share of its area that each stands for (sums to 1).
struct Anchors {
  std::vector<int> index;
  std::vector<float> share;
};

/// `count` medoids of a k-means clustering of `surface` (all of it when it has no more points than that).
/// Deterministic: starts from the farthest-point order. Cost count x points x iterations; allocates.
Anchors chooseAnchors(std::span<const Vec3> surface, int count);

}  // namespace rigel
