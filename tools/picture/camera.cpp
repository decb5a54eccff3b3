#include "picture/camera.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

namespace {

/// All of a view's camera but its place.
Camera orient(int width, int height, const View& view) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.tanHalfFov = std::tan(0.5f * view.verticalFov);
  const float cp = std::cos(view.pitch), sp = std::sin(view.pitch);
  const glm::vec3 back{cp * std::sin(view.yaw), sp, cp * std::cos(view.yaw)};
  const glm::vec3 right{std::cos(view.yaw), 0, -std::sin(view.yaw)};
  camera.axes = {right, glm::cross(back, right), back};
  return camera;
}

float aspectOf(const Camera& camera) { return static_cast<float>(camera.width) / static_cast<float>(camera.height); }

}  // namespace

Camera framePoints(std::span<const glm::vec3> points, int width, int height, const View& view) {
  const BoundingSphere sphere = boundingSphere(points);
  if (!(sphere.radius > 0)) return frameSphere(sphere, width, height, view);
  Camera camera = orient(width, height, view);
  const float tanY = camera.tanHalfFov * (1 - 2 * view.margin), tanX = tanY * aspectOf(camera);
  // Seen along the axes: point (x, y, z) is held by an eye at (ex, ey, ez) when |x - ex| <= tanX (ez - z) and likewise
  // in y. Each side of the picture asks for the largest of x + tanX z, -x + tanX z, ... over all points.
  constexpr float kNone = -std::numeric_limits<float>::infinity();
  float right = kNone, left = kNone, top = kNone, bottom = kNone;
  for (const glm::vec3 p : points) {
    const glm::vec3 q = glm::transpose(camera.axes) * (p - sphere.centre);
    right = std::max(right, q.x + tanX * q.z);
    left = std::max(left, -q.x + tanX * q.z);
    top = std::max(top, q.y + tanY * q.z);
    bottom = std::max(bottom, -q.y + tanY * q.z);
  }
  const float distance = std::max((right + left) / (2 * tanX), (top + bottom) / (2 * tanY));
  camera.eye = sphere.centre + camera.axes * glm::vec3(0.5f * (right - left), 0.5f * (top - bottom), distance);
  camera.focus = distance;
  return camera;
}

Camera frameSphere(const BoundingSphere& sphere, int width, int height, const View& view) {
  Camera camera = orient(width, height, view);
  // The sphere's outline, seen from d, is a cone of half angle asin(r/d); it has to fit the narrower field of view.
  const float narrow = std::atan(camera.tanHalfFov * std::min(1.0f, aspectOf(camera)) * (1 - 2 * view.margin));
  const float radius = sphere.radius > 0 ? sphere.radius : 1.0f;
  camera.focus = radius / std::sin(narrow);
  camera.eye = sphere.centre + camera.axes[2] * camera.focus;
  return camera;
}

}  // namespace rigel::tools
