// The paper's figure 1: a car with small lights just off the corners of its box and its roof. The samples of a corner
// lattice stand too close to those lights; the mixed rig's, on the axes of the box, do not. Spatial RMS as measured by
// `rigel report sample:figure1`: mixed:l3,g,c 51 %, lattice:3x2x2 218 %, lattice:8x4x2 55 %. With
// lights farther off, or brighter ones over the roof, the 64 samples win.
#include "samples/car_mesh.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"

#include <glm/geometric.hpp>

namespace rigel::tools {
namespace {

// Distances from the box, in object sizes (the box's diagonal, 5.1 m): figure 1 holds at 0.10 to 0.15.
constexpr float kCornerDistance = 0.10f;  // along the box's diagonal, outwards
constexpr float kRoofDistance = 0.15f;    // straight up
constexpr float kRoofSpread = 0.35f;      // of the roof lights along the car, as a share of its length
constexpr float kLightRadius = 0.06f;     // m
constexpr Rgb kCornerIntensity[4] = {{1.4f, 1.1f, 0.7f}, {0.75f, 1.0f, 1.4f}, {1.3f, 1.1f, 0.9f}, {0.9f, 1.15f, 1.2f}};
constexpr Rgb kRoofIntensity{0.72f, 0.7f, 0.65f};

}  // namespace

Scene makeFigure1() {
  Scene scene;
  scene.name = "figure1";
  addCar(scene, {0.62f, 0.6f, 0.56f});
  Primitive floor;
  addFloor(floor, {-7, -7}, {7, 7}, 0);
  finishNormals(floor, 0);
  addScenery(scene, "floor", std::move(floor), addMaterial(scene, "floor", {0.25f, 0.25f, 0.25f}));

  const glm::vec3 half{kCarWidth / 2, kCarHeight / 2, kCarLength / 2}, centre{0, kCarHeight / 2, 0};
  const float size = 2 * glm::length(half);
  const glm::vec3 corners[] = {{1, 1, 1}, {-1, 1, 1}, {1, 1, -1}, {-1, 1, -1}};
  const char* const names[] = {"front left", "front right", "rear left", "rear right"};
  for (int i = 0; i < 4; ++i) {
    const glm::vec3 corner = corners[i] * half;
    // Off the corner itself along the mean of its three faces' normals, so that it is as far from each of them.
    const glm::vec3 out = glm::normalize(corners[i]) * (kCornerDistance * size);
    addLight(scene, names[i], sphereOfIntensity(kLightRadius, kCornerIntensity[i]), kNoParent, centre + corner + out);
  }
  for (const float side : {1.0f, -1.0f}) {
    addLight(scene, side > 0 ? "roof front" : "roof rear", sphereOfIntensity(kLightRadius, kRoofIntensity), kNoParent,
             {0, kCarHeight + kRoofDistance * size, side * kRoofSpread * kCarLength});
  }
  return scene;
}

}  // namespace rigel::tools
