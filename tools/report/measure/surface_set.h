// Where an object's measured points and rig anchors are in a frame.
#pragma once

#include "scene/surface.h"

#include <rigel/rig_light.h>

#include <optional>
#include <vector>

namespace rigel::tools {

/// The node's frame without scale, shear and mirroring: metres, so that derivatives and extents mean what they say. x
/// is the node's x, y lies in the plane of its x and y, z completes a right-handed orthonormal basis; where the
/// transform leaves a column undefined, another axis takes its place.
RigFrame rigidFrame(const glm::mat4& worldFromNode);

/// Box of all posed vertices in the rig frame.
RigBox rigBox(const RigFrame& worldFromRig, const PosedObject& posed);

/// The points of one object: those at which errors are measured, and a second, independent set that rigs may choose
/// their anchors from (a rig must not be judged at the points it was fitted to).
struct SurfaceSet {
  std::vector<SurfacePoint> measured;
  std::vector<SurfacePoint> candidates;
  std::vector<float> wrap;  // per measured point
};

/// The wrap that most points have.
float commonWrap(std::span<const float> wraps);

inline constexpr int kRigCandidates = 1024;

Result<SurfaceSet> chooseSurface(const SceneObject& object, const PosedObject& rest, int measured,
                                 std::optional<float> wrap);

}  // namespace rigel::tools
