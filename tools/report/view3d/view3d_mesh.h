// A mesh for the page's 3-D view: the object's own, or fewer of its vertices where it has too many.
#pragma once

#include "scene/surface.h"

#include <array>
#include <cstdint>

namespace rigel::tools {

struct ViewMesh {
  std::vector<SurfacePoint> vertices;  // corners of the object's triangles, so that they follow every pose
  std::vector<std::array<std::uint16_t, 3>> triangles;
};

/// At most `most` (1 to 65535) vertices of `object`. Vertices at one place with one normal are one; where that leaves
/// too many, so are those that share a cell of a grid and the axis that their normals are nearest to (Rossignac, Borrel
/// 1993, with edges kept): the one nearest to their mean stands for all. Triangles that collapse go. Some 100 ns a
/// triangle and attempt, at most ten attempts.
ViewMesh viewMesh(const SceneObject& object, const PosedObject& rest, std::size_t most);

}  // namespace rigel::tools
