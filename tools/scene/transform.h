// Small pieces of affine maths shared by the scene sources.
#pragma once

#include "scene/scene.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel::tools {

inline glm::mat4 composeTransform(const glm::vec3& translation, const glm::quat& rotation, const glm::vec3& scale) {
  const glm::mat3 r = glm::mat3_cast(rotation);
  return {glm::vec4(r[0] * scale.x, 0), glm::vec4(r[1] * scale.y, 0), glm::vec4(r[2] * scale.z, 0),
          glm::vec4(translation, 1)};
}

/// The matrix that carries normals: inverse transpose times |det|, without the inverse, hence finite where M collapses.
inline glm::mat3 normalMatrix(const glm::mat3& m) {
  const glm::mat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::dot(m[0], cofactor[0]) < 0 ? -cofactor : cofactor;
}

/// Unit vector along `v`, however small, or zero where it has no direction.
inline glm::vec3 normalizeOrZero(const glm::vec3& v) {
  const float largest = std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
  if (!(largest > 0) || !(largest <= std::numeric_limits<float>::max())) return glm::vec3(0);
  const glm::vec3 scaled = v / largest;
  return scaled / glm::length(scaled);
}

/// For each node, whether it hangs below one of the scene's roots.
std::vector<bool> nodesInScene(const Scene& scene);

}  // namespace rigel::tools
