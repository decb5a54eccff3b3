// Vertices that no triangle uses. Exporters leave them behind (one vertex buffer for many primitives, deleted faces):
// nobody sees them, but a rig's box, a camera's framing and a transplant's scale would reach for them.
#include "scene/gltf_import.h"

#include <algorithm>

namespace rigel::tools {
namespace {

constexpr glm::uint kStray = ~glm::uint{0};

/// Moves the entries that stay to the front, in their order; arrays that are absent (empty) stay so.
template <class T>
void keepUsed(std::vector<T>& perVertex, const std::vector<glm::uint>& newIndex, glm::uint kept) {
  if (perVertex.empty()) return;
  for (std::size_t v = 0; v < newIndex.size(); ++v) {
    if (newIndex[v] != kStray) perVertex[newIndex[v]] = perVertex[v];
  }
  perVertex.resize(kept);
  perVertex.shrink_to_fit();
}

void dropStrayVertices(Primitive& primitive) {
  std::vector<glm::uint> newIndex(primitive.positions.size(), kStray);
  for (const glm::uvec3& t : primitive.triangles) newIndex[t.x] = newIndex[t.y] = newIndex[t.z] = 0;
  glm::uint kept = 0;
  for (glm::uint& index : newIndex) {
    if (index != kStray) index = kept++;
  }
  if (kept == newIndex.size()) return;
  for (glm::uvec3& t : primitive.triangles) t = {newIndex[t.x], newIndex[t.y], newIndex[t.z]};
  keepUsed(primitive.positions, newIndex, kept);
  keepUsed(primitive.normals, newIndex, kept);
  keepUsed(primitive.influences, newIndex, kept);
  for (MorphTarget& target : primitive.targets) {
    keepUsed(target.positions, newIndex, kept);
    keepUsed(target.normals, newIndex, kept);
  }
}

}  // namespace

void dropStrayVertices(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) dropStrayVertices(primitive);
  }
}

}  // namespace rigel::tools
