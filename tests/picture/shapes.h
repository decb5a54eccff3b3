// Posed objects of known shape for the picture tests.
#pragma once

#include "picture/raycast.h"

#include <vector>

namespace rigel::tools::test {

struct Shape {
  SceneObject object;
  PosedObject posed;
};

/// Triangles with one colour and wrap; `normals` may be zero vectors for flat shading.
inline Shape makeShape(std::vector<glm::vec3> positions, std::vector<glm::vec3> normals,
                       std::vector<glm::uvec3> triangles, glm::vec3 colour = glm::vec3(0.5f), float wrap = 0) {
  Shape shape;
  shape.object.triangles = std::move(triangles);
  shape.object.triangleColour.assign(shape.object.triangles.size(), colour);
  shape.object.triangleWrap.assign(shape.object.triangles.size(), wrap);
  shape.object.vertexCount = static_cast<int>(positions.size());
  shape.posed.positions = std::move(positions);
  shape.posed.normals = std::move(normals);
  return shape;
}

/// The square |x|, |y| <= half in the plane z, facing +z, its normals as given.
inline Shape makeSquare(float half, float z, glm::vec3 normal = {0, 0, 1}, glm::vec3 colour = glm::vec3(0.5f)) {
  return makeShape({{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
                   std::vector<glm::vec3>(4, normal), {{0, 1, 2}, {0, 2, 3}}, colour);
}

/// A camera at (0, 0, distance) that looks along -z with 90 degrees of view: a point (x, y, 0) appears at
/// (x, y)/distance of half the picture's height.
inline Camera lookDownZ(int width, int height, float distance) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.eye = {0, 0, distance};
  camera.tanHalfFov = 1;
  return camera;
}

}  // namespace rigel::tools::test
