// A walk for the figure: feet that stay where they are set down.
#pragma once

#include "samples/animation_builder.h"
#include "samples/figure_mesh.h"

namespace rigel::tools {

struct Walk {
  float speed = 1.1f;    // m/s along +z
  float cycle = 1.0f;    // s, two steps
  float duration = 4;    // s
  glm::vec3 start{0};    // of the figure's feet at time 0
  float crouch = 0.05f;  // m that the hips hang below their height at rest, so that a stride reaches the ground
};

/// Adds channels for hips, trunk, arms and legs of a figure that stands at the origin. Legs are solved so that a foot
/// on the ground moves with it; speed times 0.6 cycle (one stance) must stay within reach of the legs, about 0.7 m.
void addWalk(AnimationBuilder& animation, const Scene& scene, const Figure& figure, const Walk& walk);

}  // namespace rigel::tools
