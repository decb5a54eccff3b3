// Sample points on an object's own surface.
#pragma once

#include <rigel/vec3.h>

#include <span>
#include <vector>

namespace rigel {

/// Points of the surface that represent it, each for the patch of points nearest to it.
struct Anchors {
  std::vector<int> index;
  std::vector<float> share;   // of the surface's area; sums to 1
  std::vector<float> radius;  // of a disc with the patch's spread: sqrt(2) times its rms distance from the anchor
};

/// Whether the ends of the surface, its extreme points along the axes, are anchors whatever their share.
enum class SurfaceEnds {
  represented,  // by the anchor of their patch: the best points for a fit
  anchored,  // themselves: for who judges a fit by its anchors and must not have surface beyond them; an end takes the
             // place of the cluster whose seed it would have been, so that up to six fewer anchors come out
};

/// `count` medoids of a k-means clustering of `surface` (all of it when it has no more points than that).
/// Deterministic: starts from the farthest-point order. Cost count x points x iterations; allocates.
Anchors chooseAnchors(std::span<const Vec3> surface, int count, SurfaceEnds ends = SurfaceEnds::represented);

/// The points `index` of `surface`, each with the patch of points nearest to it. One that coincides with an earlier one
/// is left out.
Anchors patchesOf(std::span<const Vec3> surface, std::span<const int> index);

/// The first and last points along each axis, each once; not more than `most`.
std::vector<int> endsOf(std::span<const Vec3> surface, int most);

}  // namespace rigel
