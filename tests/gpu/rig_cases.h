// Rigs of every kind on bodies of every shape, near the origin and far from it, and points to evaluate them at.
#pragma once

#include "lights/random.h"

#include <rigel/gpu_rig.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rigel::test {

struct RigBody {
  std::string name;
  std::vector<Vec3> surface;
  RigBox box;
};

/// An ordinary body, a cube's ball, a plate without thickness, a thread, a single point.
const std::vector<RigBody>& rigBodies();

/// A random rotation, `distance` from the origin.
RigFrame randomFrame(Random& random, double distance);

/// The distances at which frames are tried [m].
inline constexpr double kFrameDistances[] = {0, 3, 1e4, 3e6};

/// With a random falloff where the spec has one.
Rig rigOn(const std::string& spec, const RigBody& body, Random& random);

/// World points in the box, outside it (up to three half extents from its centre), on its corners and faces, between
/// nodes, at its centre, and without a number.
std::vector<Vec3> rigPoints(const RigBox& box, const RigFrame& frame, int count, Random& random);

template <int B>
std::vector<RadianceSH<B>> randomCoefficients(int count, double scale, Random& random) {
  std::vector<RadianceSH<B>> out(count);
  for (auto& sh : out)
    for (Rgb& c : sh.c) c = {random.uniformf(-1, 1), random.uniformf(-1, 1), random.uniformf(-1, 1)};
  for (auto& sh : out) sh = sh * static_cast<float>(scale);
  return out;
}

}  // namespace rigel::test
