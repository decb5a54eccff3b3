#include "picture/camera.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {

BoundingSphere boundingSphere(std::span<const glm::vec3> points) {
  if (points.empty()) return {};
  const auto farthestFrom = [&](glm::vec3 from) {
    return *std::max_element(points.begin(), points.end(), [from](glm::vec3 a, glm::vec3 b) {
      return glm::dot(a - from, a - from) < glm::dot(b - from, b - from);
    });
  };
  const glm::vec3 a = farthestFrom(points.front()), b = farthestFrom(a);
  BoundingSphere sphere{0.5f * (a + b), 0.5f * glm::distance(a, b)};
  for (const glm::vec3 p : points) {
    const float d = glm::distance(p, sphere.centre);
    if (d <= sphere.radius) continue;
    const float grown = 0.5f * (sphere.radius + d);
    sphere.centre += (p - sphere.centre) * ((d - grown) / d);
    sphere.radius = grown;
  }
  return sphere;
}

glm::vec3 Camera::direction(glm::vec2 pixel) const {
  const float w = static_cast<float>(width), h = static_cast<float>(height);
  const float scale = 2 * tanHalfFov / h;
  return glm::normalize(axes * glm::vec3((pixel.x - 0.5f * w) * scale, (0.5f * h - pixel.y) * scale, -1));
}

glm::vec2 Camera::project(glm::vec3 point) const {
  const glm::vec3 local = glm::transpose(axes) * (point - eye);
  const float scale = 0.5f * static_cast<float>(height) / (tanHalfFov * -local.z);
  return {0.5f * static_cast<float>(width) + local.x * scale, 0.5f * static_cast<float>(height) - local.y * scale};
}

Camera frameSphere(const BoundingSphere& sphere, int width, int height, const View& view) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.tanHalfFov = std::tan(0.5f * view.verticalFov);
  const float cp = std::cos(view.pitch), sp = std::sin(view.pitch);
  const glm::vec3 back{cp * std::sin(view.yaw), sp, cp * std::cos(view.yaw)};
  const glm::vec3 right{std::cos(view.yaw), 0, -std::sin(view.yaw)};
  camera.axes = {right, glm::cross(back, right), back};
  // The sphere's outline, seen from d, is a cone of half angle asin(r/d); it has to fit the narrower field of view.
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const float narrow = std::atan(camera.tanHalfFov * std::min(1.0f, aspect) * (1 - 2 * view.margin));
  const float radius = sphere.radius > 0 ? sphere.radius : 1.0f;
  camera.eye = sphere.centre + back * (radius / std::sin(narrow));
  return camera;
}

}  // namespace rigel::tools
