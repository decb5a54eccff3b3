// Which part of an object each point of its surface belongs to: a glTF node, or the joint that moves it most.
#pragma once

#include "scene/surface.h"

#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

struct BodyParts {
  static constexpr std::size_t kMost = 16;
  static constexpr int kLeastSamples = 8;  // fewer say little

  struct Part {
    std::string name;  // of the node; "node 12" where it has none. Untrusted, as all of a file's names
    int parent = -1;   // index of the part that it hangs from, which comes before it
    int nodes = 1;     // with surface of their own, taken together
  };
  std::vector<Part> parts;    // at most kMost
  std::vector<int> ofSample;  // per sample
};

/// One part for each node or joint with samples, named after it. While there are too many, or one has fewer than
/// kLeastSamples, the smallest of those from which no other hangs goes to what it hangs from in the node hierarchy, and
/// with it those that are as deep and about as large on other branches: feet go together.
/// Of a skinned triangle the joint counts that has the largest weight at the point.
BodyParts findBodyParts(const Scene& scene, const SceneObject& object, std::span<const SurfacePoint> samples);

}  // namespace rigel::tools
