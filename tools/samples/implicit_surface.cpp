#include "samples/implicit_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

glm::vec3 gradient(const DistanceField& field, glm::vec3 p, float h) {
  return glm::vec3(field(p + glm::vec3(h, 0, 0)) - field(p - glm::vec3(h, 0, 0)),
                   field(p + glm::vec3(0, h, 0)) - field(p - glm::vec3(0, h, 0)),
                   field(p + glm::vec3(0, 0, h)) - field(p - glm::vec3(0, 0, h))) /
         (2 * h);
}

/// Mean of the points where the cell's edges cross the surface.
glm::vec3 meanCrossing(const std::array<float, 8>& value, glm::vec3 origin, float cell) {
  glm::vec3 sum{0};
  float count = 0;
  const auto corner = [&](int i) {
    return origin +
           cell * glm::vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2 & 1));
  };
  for (int a = 0; a < 8; ++a) {
    for (const int bit : {1, 2, 4}) {
      const int b = a | bit;
      if (b == a || (value[a] < 0) == (value[b] < 0)) continue;
      sum += glm::mix(corner(a), corner(b), value[a] / (value[a] - value[b]));
      count += 1;
    }
  }
  return sum / count;
}

/// Field at the grid's points. Blocks farther from the surface than twice their own half diagonal hold the value of
/// their centre: only the sign matters there, and most of a box around a thin body is such blocks.
std::vector<float> sampleField(const DistanceField& field, glm::vec3 origin, glm::ivec3 n, float cell) {
  constexpr int kBlock = 6;
  std::vector<float> value(static_cast<std::size_t>(n.x) * n.y * n.z);
  for (int bz = 0; bz < n.z; bz += kBlock) {
    for (int by = 0; by < n.y; by += kBlock) {
      for (int bx = 0; bx < n.x; bx += kBlock) {
        const glm::ivec3 low{bx, by, bz}, high = glm::min(low + kBlock, n);
        const float centre = field(origin + 0.5f * cell * glm::vec3(low + high - 1));
        const bool isFar = std::abs(centre) > 2 * 0.5f * cell * glm::length(glm::vec3(high - low));
        for (int z = low.z; z < high.z; ++z)
          for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
              value[static_cast<std::size_t>((z * n.y + y) * n.x + x)] =
                  isFar ? centre : field(origin + cell * glm::vec3(x, y, z));
      }
    }
  }
  return value;
}

}  // namespace

Primitive meshImplicit(const DistanceField& field, glm::vec3 boxMin, glm::vec3 boxMax, float cell) {
  return meshImplicit(field, boxMin, boxMax, cell, field);
}

Primitive meshImplicit(const DistanceField& field, glm::vec3 boxMin, glm::vec3 boxMax, float cell,
                       const DistanceField& normalField) {
  // A margin of one cell keeps the surface off the grid's border, so that the mesh is closed.
  const glm::vec3 origin = boxMin - cell;
  const glm::ivec3 n = glm::ivec3(glm::ceil((boxMax - boxMin) / cell)) + 3;
  const auto index = [&](int x, int y, int z) { return static_cast<std::size_t>((z * n.y + y) * n.x + x); };
  const std::vector<float> value = sampleField(field, origin, n, cell);

  Primitive mesh;
  std::vector<std::uint32_t> vertex(value.size(), 0);
  for (int z = 0; z + 1 < n.z; ++z) {
    for (int y = 0; y + 1 < n.y; ++y) {
      for (int x = 0; x + 1 < n.x; ++x) {
        std::array<float, 8> corner;
        int inside = 0;
        for (int i = 0; i < 8; ++i) {
          corner[i] = value[index(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2 & 1))];
          inside += corner[i] < 0;
        }
        if (inside == 0 || inside == 8) continue;
        vertex[index(x, y, z)] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(meanCrossing(corner, origin + cell * glm::vec3(x, y, z), cell));
      }
    }
  }

  // One quad for each grid edge that crosses the surface, between the four cells around it.
  for (int z = 1; z + 1 < n.z; ++z) {
    for (int y = 1; y + 1 < n.y; ++y) {
      for (int x = 1; x + 1 < n.x; ++x) {
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 step{0}, u{0}, v{0};
          step[axis] = 1;
          u[(axis + 1) % 3] = 1;
          v[(axis + 2) % 3] = 1;
          const bool from = value[index(x, y, z)] < 0;
          if (from == (value[index(x + step.x, y + step.y, z + step.z)] < 0)) continue;
          const glm::ivec3 p{x, y, z};
          const auto at = [&](glm::ivec3 q) { return vertex[index(q.x, q.y, q.z)]; };
          std::array<std::uint32_t, 4> q{at(p - u - v), at(p - v), at(p), at(p - u)};
          if (!from) std::swap(q[1], q[3]);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
      }
    }
  }

  // Two Newton steps along the gradient, held within the cell so that thin parts cannot fold over.
  const float h = 0.05f * cell;
  mesh.normals.reserve(mesh.positions.size());
  for (glm::vec3& p : mesh.positions) {
    for (int pass = 0; pass < 2; ++pass) {
      const glm::vec3 g = gradient(field, p, h);
      p -= std::clamp(field(p) / std::max(glm::dot(g, g), 0.25f), -0.4f * cell, 0.4f * cell) * g;
    }
    mesh.normals.push_back(glm::normalize(gradient(normalField, p, 0.25f * cell)));
  }
  return mesh;
}

float roundConeDistance(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb) {
  // The swept sphere nearest to p: d/dt (|p - c(t)| - r(t)) = 0 puts p - c(t) at sine (ra - rb)/length to the axis.
  const glm::vec3 axis = b - a;
  const float length = glm::length(axis);
  if (length <= std::abs(ra - rb)) return ra > rb ? glm::distance(p, a) - ra : glm::distance(p, b) - rb;
  const glm::vec3 d = axis / length;
  const float along = glm::dot(p - a, d);
  const float across = std::sqrt(std::max(glm::dot(p - a, p - a) - along * along, 0.0f));
  const float sine = (ra - rb) / length, cosine = std::sqrt(1 - sine * sine);
  const float t = std::clamp((along - across * sine / cosine) / length, 0.0f, 1.0f);
  return std::hypot(along - t * length, across) - glm::mix(ra, rb, t);
}

float ellipsoidDistance(glm::vec3 p, glm::vec3 centre, glm::vec3 radii) {
  const glm::vec3 q = (p - centre) / radii;
  const float k = glm::length(q);
  const float slope = glm::length(q / radii);
  return slope > 0 ? k * (k - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

float smoothUnion(float a, float b, float blend) {
  const float h = std::max(blend - std::abs(a - b), 0.0f) / blend;
  return std::min(a, b) - 0.25f * blend * h * h;
}

}  // namespace rigel::tools
