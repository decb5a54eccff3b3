// A skeleton described as bones with thickness: makes the joint nodes, the skin and smooth weights.
#pragma once

#include "scene/scene.h"

#include <span>

namespace rigel::tools {

/// A joint at `head`, moving the sphere-swept segment from `head` to `tail` (bind pose, in the space of the root's
/// parent). `parent` precedes it in the list; -1 for the root.
struct Bone {
  std::string name;
  int parent = -1;
  glm::vec3 head, tail;
  float headRadius = 0, tailRadius = 0;
};

struct Skeleton {
  std::vector<int> joints;  // node of each bone
  int skin = -1;
};

/// Adds joint nodes (unrotated in the bind pose) below `parent` and the skin over them.
Skeleton addSkeleton(Scene& scene, std::string name, int parent, std::span<const Bone> bones);

/// Four influences a vertex from the distances to the bones' surfaces, falling to 0 `blend` metres beyond the nearest
/// one: continuous in position, so that skin stretches evenly.
void bindToBones(Primitive& mesh, std::span<const Bone> bones, float blend);

/// Binds all vertices of `mesh` to one bone: rigid parts such as eyes.
void bindToBone(Primitive& mesh, int bone);

}  // namespace rigel::tools
