// A figure reaches out of a narrow spotlight until its fingertips leave the light: a cone's edge that crosses a body,
// where a rig that sees the light at a few points blurs it over the whole arm. Footlights stand close to the legs.
#include "samples/animation_builder.h"
#include "samples/figure_mesh.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"

#include <glm/gtc/constants.hpp>

namespace rigel::tools {
namespace {

/// Rotation by angles [degrees] about x, then y, then z.
glm::quat turn(float x, float y, float z) {
  return glm::angleAxis(glm::radians(z), glm::vec3(0, 0, 1)) * glm::angleAxis(glm::radians(y), glm::vec3(0, 1, 0)) *
         glm::angleAxis(glm::radians(x), glm::vec3(1, 0, 0));
}

void addLights(Scene& scene) {
  // The cone's edge lies at x = 0.63 to 0.77 m at shoulder height: between forearm and wrist of the stretched arm.
  SpotLight key;
  key.intensity = {125, 118, 104};
  key.innerAngle = glm::radians(8.0f);
  key.outerAngle = glm::radians(10.0f);
  key.radius = 0.05f;
  const glm::vec3 keyAt{0.1f, 4.6f, 2.2f};
  addLight(scene, "spotlight", key, kNoParent, keyAt, glm::vec3(0.1f, 1.2f, 0) - keyAt);

  SpotLight rim;
  rim.intensity = {14, 22, 42};
  rim.innerAngle = glm::radians(14.0f);
  rim.outerAngle = glm::radians(26.0f);
  rim.radius = 0.05f;
  const glm::vec3 rimAt{-1.7f, 3.0f, -2.6f};
  addLight(scene, "rim", rim, kNoParent, rimAt, glm::vec3(0, 1.1f, 0) - rimAt);

  addLight(scene, "footlight left", sphereOfIntensity(0.08f, {0.85f, 0.42f, 0.16f}), kNoParent, {0.75f, 0.12f, 0.85f});
  addLight(scene, "footlight right", sphereOfIntensity(0.08f, {0.75f, 0.30f, 0.34f}), kNoParent, {-0.8f, 0.12f, 0.7f});
}

void addStageFloor(Scene& scene) {
  Primitive floor;
  const glm::vec2 disc[] = {{2.6f, -0.12f}, {2.6f, -0.02f}, {2.58f, 0}, {0, 0}};
  addLathe(floor, disc, 96);
  finishNormals(floor, glm::radians(50.0f));
  addScenery(scene, "floor", std::move(floor), addMaterial(scene, "boards", {0.26f, 0.17f, 0.11f}));
}

}  // namespace

Scene makeStage() {
  using J = FigureJoint;
  Scene scene;
  scene.name = "stage";
  const Figure figure = addFigure(scene);
  addStageFloor(scene);
  addLights(scene);

  AnimationBuilder reach("reach");
  const auto joint = [&](int index) { return figure.skeleton.joints[index]; };
  const auto spline = [&](int index, std::initializer_list<Key<glm::quat>> keys) {
    reach.rotation(joint(index), Interpolation::cubicSpline, std::span(keys.begin(), keys.size()));
  };
  // The left arm hangs bent in the light, stretches out of it and comes half-way back.
  spline(J::left + J::clavicle,
         {{0, turn(0, 0, 0)}, {1.3f, turn(0, -4, 9)}, {1.8f, turn(0, -4, 10)}, {3, turn(0, 0, 2)}});
  spline(J::left + J::upperArm, {{0, turn(-18, 0, -30)},
                                 {0.5f, turn(-20, -12, -8)},
                                 {1.3f, turn(-8, -14, 42)},
                                 {1.8f, turn(-6, -12, 45)},
                                 {2.4f, turn(-12, -16, 18)},
                                 {3, turn(-18, -4, -18)}});
  spline(J::left + J::forearm, {{0, turn(-62, -12, 0)},
                                {0.5f, turn(-66, -16, 0)},
                                {1.3f, turn(-8, -5, 0)},
                                {1.8f, turn(-5, -4, 0)},
                                {2.4f, turn(-34, -10, 0)},
                                {3, turn(-55, -10, 0)}});
  spline(J::left + J::hand, {{0, turn(0, 0, -8)}, {1.3f, turn(0, 0, 8)}, {1.8f, turn(0, 0, 14)}, {3, turn(0, 0, -6)}});
  spline(J::left + J::fingers,
         {{0, turn(0, 0, -28)}, {1.3f, turn(0, 0, -6)}, {1.8f, turn(0, 0, 4)}, {3, turn(0, 0, -24)}});
  // The right arm swings back a little for balance.
  spline(J::right + J::upperArm, {{0, turn(4, 0, 34)}, {1.5f, turn(16, 0, 24)}, {3, turn(4, 0, 32)}});
  spline(J::right + J::forearm, {{0, turn(-14, 6, 0)}, {1.5f, turn(-26, 10, 0)}, {3, turn(-16, 6, 0)}});
  spline(J::right + J::fingers, {{0, turn(0, 0, 22)}, {1.5f, turn(0, 0, 30)}, {3, turn(0, 0, 22)}});
  // The trunk leans after the hand, the head looks at it, the legs carry the weight over.
  spline(J::spine, {{0, turn(0, 0, 0)}, {1.3f, turn(2, 6, -5)}, {1.8f, turn(2, 7, -6)}, {3, turn(0, 0, -1)}});
  spline(J::chest, {{0, turn(-1, -4, 0)}, {1.3f, turn(1, 8, -5)}, {1.8f, turn(1, 9, -6)}, {3, turn(0, -2, 0)}});
  spline(J::neck, {{0, turn(4, 0, 0)}, {1.3f, turn(0, 14, 4)}, {3, turn(3, 0, 0)}});
  spline(J::head, {{0, turn(4, -6, 0)}, {1.3f, turn(-2, 28, 3)}, {1.8f, turn(-3, 30, 3)}, {3, turn(3, 0, 0)}});
  const glm::vec3 hips = scene.nodes[joint(J::hips)].translation;
  const Key<glm::vec3> sway[] = {{0, hips}, {1.5f, hips + glm::vec3(0.035f, -0.006f, 0)}, {3, hips}};
  reach.translation(joint(J::hips), Interpolation::cubicSpline, sway);
  // Legs turn against the shift of the hips (0.035 m over 0.9 m of leg), so that the feet stay where they are.
  for (const int side : {J::left, J::right}) {
    spline(side + J::thigh, {{0, turn(0, 0, 0)}, {1.5f, turn(0, 0, -2.2f)}, {3, turn(0, 0, 0)}});
    spline(side + J::foot, {{0, turn(0, 0, 0)}, {1.5f, turn(0, 0, 2.2f)}, {3, turn(0, 0, 0)}});
  }
  scene.animations.push_back(reach.finish());
  return scene;
}

}  // namespace rigel::tools
