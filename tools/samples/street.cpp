// A car drives down a lamp-lit street and meets the headlights of an oncoming one: lights that rush past a long object
// at about one object size, and two narrow cones that sweep over it.
#include "samples/animation_builder.h"
#include "samples/car_mesh.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

namespace rigel::tools {
namespace {

constexpr float kDuration = 4;  // s
constexpr float kSpeed = 8;     // m/s
constexpr float kLane = 1.8f;   // m from the middle of the road; cars keep to the right
constexpr float kOncomingSpeed = 9;
constexpr float kLampSpacing = 7;  // m; six lamps a side
constexpr float kKerb = 4.0f;      // m from the middle of the road
constexpr float kLampHeight = 4.2f;

void addRoad(Scene& scene) {
  const float end = 34;
  Primitive asphalt, markings, pavement;
  addFloor(asphalt, {-kKerb, -end}, {kKerb, end}, 0);
  finishNormals(asphalt, 0);
  for (float z = -end; z < end; z += 6) addFloor(markings, {-0.06f, z}, {0.06f, z + 3}, 0.004f);
  for (const float side : {-1.0f, 1.0f}) {
    const float x = side * (kKerb - 0.25f);
    addFloor(markings, {x - 0.05f, -end}, {x + 0.05f, end}, 0.004f);
  }
  finishNormals(markings, 0);
  Primitive slab;
  addRoundedBox(slab, {1.5f, 0.12f, end}, 0.03f, 4);
  finishNormals(slab, 0.6f);
  for (const float side : {-1.0f, 1.0f}) {
    append(pavement, slab, glm::translate(glm::mat4(1), glm::vec3(side * (kKerb + 1.5f), 0, 0)));
  }
  addScenery(scene, "asphalt", std::move(asphalt), addMaterial(scene, "asphalt", {0.11f, 0.11f, 0.115f}));
  addScenery(scene, "markings", std::move(markings), addMaterial(scene, "road paint", {0.6f, 0.6f, 0.57f}));
  addScenery(scene, "pavement", std::move(pavement), addMaterial(scene, "concrete", {0.24f, 0.235f, 0.22f}));
}

/// A post by the kerb whose arm holds the lamp over the lane.
void addPost(Primitive& out, float side, float z, float reach) {
  Primitive post;
  addCylinder(post, 0.06f, kLampHeight + 0.25f, 0.02f, 16);
  finishNormals(post, 0.7f);
  append(out, post, glm::translate(glm::mat4(1), glm::vec3(side * (kKerb + 0.45f), 0, z)));
  Primitive arm;
  addRoundedBox(arm, {reach / 2, 0.035f, 0.035f}, 0.02f, 3);
  finishNormals(arm, 0.7f);
  append(out, arm, glm::translate(glm::mat4(1), glm::vec3(side * (kKerb + 0.45f - reach / 2), kLampHeight + 0.22f, z)));
}

void addLamps(Scene& scene) {
  Primitive posts;
  for (int i = 0; i < 6; ++i) {
    for (const float side : {-1.0f, 1.0f}) {
      const float z = kLampSpacing * (static_cast<float>(i) - 2.5f) + (side > 0 ? 1.6f : -1.6f);
      const std::string name = "lamp " + std::string(side > 0 ? "left " : "right ") + std::to_string(i + 1);
      const glm::vec3 at{side * (kKerb - 0.35f), kLampHeight, z};
      addPost(posts, side, z, 0.85f);
      // Sodium and white lamps by turns; every third is a shaded one that throws a cone on the lane.
      const Rgb colour = i % 2 == 0 ? Rgb{30, 19, 9} : Rgb{22, 22, 24};
      if (i % 3 == 1) {
        SpotLight spot;
        spot.intensity = colour * 1.6f;
        spot.innerAngle = glm::radians(32.0f);
        spot.outerAngle = glm::radians(52.0f);
        spot.radius = 0.1f;
        addLight(scene, name, spot, kNoParent, at, {-side * 0.3f, -1, 0});
      } else {
        addLight(scene, name, sphereOfIntensity(0.16f, colour), kNoParent, at);
      }
    }
  }
  addScenery(scene, "lamp posts", std::move(posts), addMaterial(scene, "painted steel", {0.2f, 0.23f, 0.22f}));
}

/// Three-sided advertising column that clicks on by a third of a turn every second: step interpolation, on scenery, so
/// that the light stays continuous.
int addColumn(Scene& scene) {
  Primitive prism;
  addRoundedBox(prism, {0.45f, 1.1f, 0.06f}, 0.04f, 4);
  finishNormals(prism, 0.7f);
  Primitive column;
  for (int i = 0; i < 3; ++i) {
    const glm::mat4 turn =
        glm::rotate(glm::mat4(1), glm::two_pi<float>() * static_cast<float>(i) / 3, glm::vec3(0, 1, 0));
    append(column, prism, glm::translate(turn, glm::vec3(0, 1.5f, 0.26f)));
  }
  const int node = addScenery(scene, "column", std::move(column), addMaterial(scene, "poster", {0.45f, 0.38f, 0.2f}));
  scene.nodes[node].translation = {-kKerb - 1.6f, 0, 1.0f};
  return node;
}

}  // namespace

Scene makeStreet() {
  Scene scene;
  scene.name = "street";
  const Car car = addCar(scene, {0.36f, 0.5f, 0.57f});
  addRoad(scene);
  addLamps(scene);
  const int column = addColumn(scene);
  addLight(scene, "moon", DirectionalLight{{}, {0.10f, 0.13f, 0.20f}}, kNoParent, {0, 20, 0}, {0.5f, -1, 0.35f});

  const int oncoming = addNode(scene, "oncoming", kNoParent);
  for (const float side : {-1.0f, 1.0f}) {
    SpotLight beam;
    beam.intensity = {150, 145, 130};
    beam.innerAngle = glm::radians(6.0f);
    beam.outerAngle = glm::radians(24.0f);
    beam.radius = 0.07f;
    // Low beam, towards its own kerb.
    addLight(scene, side > 0 ? "headlight left" : "headlight right", beam, oncoming, {side * 0.62f, 0.68f, 0},
             {-0.02f, -0.03f, -1});
  }

  AnimationBuilder drive("drive");
  const float start = -kSpeed * kDuration / 2;
  // Facing +z with +y up, the right-hand lane is at -x.
  const Key<glm::vec3> path[] = {{0, {-kLane, 0, start}}, {kDuration, {-kLane, 0, -start}}};
  drive.translation(car.node, Interpolation::linear, path);
  const Key<glm::vec3> towards[] = {{0, {kLane, 0, 0.5f * kOncomingSpeed * kDuration + 3}},
                                    {kDuration, {kLane, 0, -0.5f * kOncomingSpeed * kDuration + 3}}};
  drive.translation(oncoming, Interpolation::linear, towards);
  for (int i = 0; i < 4; ++i) {
    const glm::vec3 axis{i % 2 == 0 ? 1.0f : -1.0f, 0, 0};  // right wheels are mounted the other way round
    // Keys every 0.05 s turn a wheel by 1.2 rad: well under the half turn at which the shortest arc would flip.
    drive.sampledRotation(car.wheels[i], kDuration, 80,
                          [&](float t) { return glm::angleAxis(t * kSpeed / kWheelRadius, axis); });
  }
  std::vector<Key<glm::quat>> clicks;
  for (int i = 0; i <= 3; ++i) {
    const float third = glm::two_pi<float>() / 3;
    clicks.push_back({static_cast<float>(i), glm::angleAxis(third * static_cast<float>(i), glm::vec3(0, 1, 0))});
  }
  drive.rotation(column, Interpolation::step, clicks);
  scene.animations.push_back(drive.finish());
  return scene;
}

}  // namespace rigel::tools
