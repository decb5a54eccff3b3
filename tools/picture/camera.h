// A pinhole camera, and one that frames an object by itself.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace rigel::tools {

struct BoundingSphere {
  glm::vec3 centre{0};
  float radius = 0;
};

/// A sphere around all points, at most a few percent larger than the smallest (J. Ritter, "An Efficient Bounding
/// Sphere", Graphics Gems 1990). Empty input gives radius 0.
BoundingSphere boundingSphere(std::span<const glm::vec3> points);

/// Where to look from, relative to an object whose front is +z: yaw 0 sees it from the front, positive turns to its +x
/// side; positive pitch looks down. Radians.
struct View {
  float yaw = glm::radians(38.0f);
  float pitch = glm::radians(18.0f);
  float verticalFov = glm::radians(35.0f);
  float margin = 0.07f;  // share of the picture left free on each side
};

struct Camera {
  int width = 0, height = 0;
  glm::vec3 eye{0};
  glm::mat3 axes{1};  // columns right, up, back (world)
  float tanHalfFov = 0;
  float focus = 1;  // m, from the eye to the middle of what it looks at

  /// Unit direction through a point of the picture; (0, 0) is the top left corner, pixels are 1 wide.
  glm::vec3 direction(glm::vec2 pixel) const;

  /// The point of the picture at which a world point appears. It must lie in front of the eye.
  glm::vec2 project(glm::vec3 point) const;
};

/// The nearest camera of this view that holds all points, less `view.margin` on each side; frameSphere without any.
Camera framePoints(std::span<const glm::vec3> points, int width, int height, const View& view = {});

/// A camera that just holds the whole sphere, less `view.margin`, in a width x height picture. Radius 0 counts as 1 m.
Camera frameSphere(const BoundingSphere& sphere, int width, int height, const View& view = {});

}  // namespace rigel::tools
