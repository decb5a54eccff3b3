// Topology and orientation of sample meshes.
#pragma once

#include "scene/scene.h"

namespace rigel::tools::test {

/// Directed edges without a partner that runs the other way, vertices at the same place counted as one: 0 for a closed
/// surface. All primitives of the mesh together.
int openEdges(const Mesh& mesh);

/// By the divergence theorem: positive for a closed surface whose triangles face outwards.
double volume(const Mesh& mesh);

/// Share of the area whose vertex normals lie on the side the triangle faces.
double agreeingShare(const Primitive& primitive);

}  // namespace rigel::tools::test
