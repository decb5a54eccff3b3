// The human figure of `stage` and `corridor`: one skinned mesh, 1.8 m tall, facing +z, arms held 45 degrees down in the
// bind pose.
#pragma once

#include "samples/skeleton_builder.h"

namespace rigel::tools {

/// Joints of the figure, in the order of Skeleton::joints. `left` is +x; a limb's joint is left or right + limb.
struct FigureJoint {
  static constexpr int hips = 0, spine = 1, chest = 2, neck = 3, head = 4, left = 5, right = 13, count = 21;
  static constexpr int clavicle = 0, upperArm = 1, forearm = 2, hand = 3, fingers = 4, thigh = 5, shin = 6, foot = 7;
};

struct Figure {
  int node = -1;  // carries mesh and skin
  Skeleton skeleton;
};

/// Distance to the figure's head and neck in the bind pose, for others who want such a head; the neck ends at 1.46 m.
float figureHeadDistance(glm::vec3 p);

/// Adds the figure, standing at the origin, and its material to `scene`.
Figure addFigure(Scene& scene);

}  // namespace rigel::tools
