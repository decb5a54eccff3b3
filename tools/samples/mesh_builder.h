// Building blocks of the sample meshes: grids, lathes, rounded boxes, and normals with creases.
//
// Builders add positions and triangles (counter-clockwise from outside) and leave normals empty; finishNormals makes
// the primitive complete once all its parts are in.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <span>

namespace rigel::tools {

/// Adds the quads of a rows x columns grid of points; the outside is on the side of d/dcolumn x d/drow. `closed` joins
/// the last column to the first. A row whose points coincide makes a pole.
void addGrid(Primitive& out, int rows, int columns, bool closed, const std::function<glm::vec3(int, int)>& point);

/// Adds a surface of revolution about +y; `profile` holds (radius, height), upwards on the outside.
void addLathe(Primitive& out, std::span<const glm::vec2> profile, int segments);

/// Adds a closed cylinder along +y from height 0, its rims rounded by `bevel`.
void addCylinder(Primitive& out, float radius, float height, float bevel, int segments);

/// Adds a sphere about the origin of 2 segments^2 quads.
void addSphere(Primitive& out, float radius, int segments);

/// Adds a box about the origin with rounded edges; `steps` quads along each side of its six faces, denser at the
/// edges. With radius = half extents of a cube it is a sphere.
void addRoundedBox(Primitive& out, glm::vec3 half, float radius, int steps);

/// Adds a rectangle in the plane y = height, facing up.
void addFloor(Primitive& out, glm::vec2 minXz, glm::vec2 maxXz, float height);

/// Adds `part` under `transform` (rigid or uniformly scaled; influences and normals are carried along).
void append(Primitive& out, const Primitive& part, const glm::mat4& transform);

/// Welds coincident vertices, drops degenerate triangles and gives every corner the angle-weighted normal of the faces
/// around it that lie within `creaseAngle` [rad] of its own, splitting vertices where corners disagree. For primitives
/// without influences and targets. Returns, for each triangle kept, its index before.
std::vector<std::uint32_t> finishNormals(Primitive& mesh, float creaseAngle);

/// Angle-weighted normals of a mesh whose vertices stay as they are; for morph targets, which must share topology.
std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

}  // namespace rigel::tools
