#include "mesh_checks.h"

#include <glm/geometric.hpp>

#include <array>
#include <cstdlib>
#include <map>

namespace rigel::tools::test {

int openEdges(const Mesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<Place, int> places;
  std::map<std::pair<int, int>, int> balance;  // of edges from the smaller to the larger index
  for (const Primitive& p : mesh.primitives) {
    const auto place = [&](std::uint32_t vertex) {
      const glm::vec3 v = p.positions[vertex];
      // + 0 makes -0 the same place as 0.
      return places.try_emplace(Place{v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}, static_cast<int>(places.size()))
          .first->second;
    };
    for (const glm::uvec3 t : p.triangles) {
      for (int k = 0; k < 3; ++k) {
        const int a = place(t[k]), b = place(t[(k + 1) % 3]);
        if (a != b) balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
      }
    }
  }
  int open = 0;
  for (const auto& [edge, sum] : balance) open += std::abs(sum);
  return open;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Primitive& p : mesh.primitives) {
    for (const glm::uvec3 t : p.triangles) {
      const glm::dvec3 a = p.positions[t.x], b = p.positions[t.y], c = p.positions[t.z];
      sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
  }
  return sum;
}

double agreeingShare(const Primitive& primitive) {
  double agreeing = 0, all = 0;
  for (const glm::uvec3 t : primitive.triangles) {
    const glm::dvec3 a = primitive.positions[t.x], b = primitive.positions[t.y], c = primitive.positions[t.z];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double area = glm::length(n);
    all += area;
    bool isAgreeing = true;
    for (int k = 0; k < 3; ++k) isAgreeing = isAgreeing && glm::dot(glm::dvec3(primitive.normals[t[k]]), n) > 0;
    if (isAgreeing) agreeing += area;
  }
  return all > 0 ? agreeing / all : 0;
}

}  // namespace rigel::tools::test
