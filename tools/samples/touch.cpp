// Lights at every place where formulas divide by zero, one after another: one brushes the top of a body, one touches
// its side, a point of zero radius grazes it at a centimetre, one goes in, rests and comes out, and one crosses its
// very middle. The body morphs meanwhile. No more than two lights are near it at a time, so that two near lights are
// enough: light moves as the square root of the way through a lamp's surface, and no rig follows that.
#include "samples/animation_builder.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>

namespace rigel::tools {
namespace {

constexpr float kHalf = 0.5f;     // m, of the rounded cube at rest
constexpr float kSwollen = 0.6f;  // m, radius of the ball it swells to
constexpr float kHeight = 0.75f;  // m, of its middle
constexpr float kDuration = 7;
constexpr float kFirstBall = 2, kSecondBall = 3;  // s, where the body is a ball

MorphTarget morph(const Primitive& base, const std::function<glm::vec3(glm::vec3)>& shape) {
  MorphTarget target;
  std::vector<glm::vec3> moved;
  for (const glm::vec3 p : base.positions) {
    moved.push_back(shape(p));
    target.positions.push_back(moved.back() - p);
  }
  target.normals = smoothNormals(moved, base.triangles);
  for (std::size_t i = 0; i < base.normals.size(); ++i) target.normals[i] -= base.normals[i];
  return target;
}

Primitive makeBody() {
  Primitive body;
  addRoundedBox(body, glm::vec3(kHalf), 0.2f, 28);
  finishNormals(body, glm::pi<float>());
  body.targets.push_back(morph(body, [](glm::vec3 p) { return glm::normalize(p) * kSwollen; }));
  body.targets.push_back(morph(body, [](glm::vec3 p) {
    const float angle = 1.1f * p.y, waist = 0.72f + 0.9f * p.y * p.y;
    return glm::vec3(waist * (p.x * std::cos(angle) + p.z * std::sin(angle)), 1.12f * p.y,
                     waist * (p.z * std::cos(angle) - p.x * std::sin(angle)));
  }));
  return body;
}

}  // namespace

Scene makeTouch() {
  Scene scene;
  scene.name = "touch";
  const int body =
      addMeshNode(scene, "body", kNoParent, makeBody(), addMaterial(scene, "plaster", {0.7f, 0.68f, 0.64f}));
  scene.nodes[body].translation = {0, kHeight, 0};
  scene.meshes[scene.nodes[body].mesh].morphWeights = {0, 0};
  Primitive floor;
  addFloor(floor, {-3, -3}, {3, 3}, 0);
  finishNormals(floor, 0);
  addScenery(scene, "floor", std::move(floor), addMaterial(scene, "floor", {0.3f, 0.3f, 0.3f}));

  addLight(scene, "fill", DirectionalLight{{}, {0.35f, 0.4f, 0.5f}}, kNoParent, {0, 4, 0}, {-0.5f, -1, -0.7f});
  const int brush = addLight(scene, "brush", SphereLight{{}, 0.15f, {2.2f, 1.2f, 0.5f}}, kNoParent, {});
  const int touch = addLight(scene, "touch", SphereLight{{}, 0.25f, {0.5f, 0.9f, 1.5f}}, kNoParent, {});
  const int enter = addLight(scene, "enter", SphereLight{{}, 0.2f, {1.3f, 0.45f, 0.9f}}, kNoParent, {});
  const int cross = addLight(scene, "cross", SphereLight{{}, 0.08f, {1.6f, 2.6f, 1.2f}}, kNoParent, {});
  PointLight spark;
  spark.intensity = {0.004f, 0.0037f, 0.003f};
  spark.radius = 0;
  const int graze = addLight(scene, "graze", spark, kNoParent, {});

  AnimationBuilder play("play");
  const auto path = [&](int node, Interpolation interpolation, std::initializer_list<Key<glm::vec3>> keys) {
    scene.nodes[node].translation = keys.begin()->value;  // the rest pose is the clip's first frame
    play.translation(node, interpolation, std::span(keys.begin(), keys.size()));
  };
  // Along the flat top of the cube, which is there at the start.
  const float top = kHeight + kHalf + 0.15f;
  path(brush, Interpolation::linear,
       {{0, {-1.2f, top, 0.1f}},
        {1.2f, {0.8f, top, 0.1f}},
        {2.4f, {2.3f, top + 0.5f, 0.3f}},
        {kDuration, {3, 2.2f, 0.8f}}});
  // Against the ball, just in contact.
  const float side = kSwollen + 0.25f;
  path(touch, Interpolation::cubicSpline,
       {{0, {2.8f, 1.4f, 1.4f}},
        {1.2f, {2, kHeight, 0.6f}},
        {kFirstBall, {side, kHeight, 0}},
        {2.8f, {2, kHeight, -0.7f}},
        {kDuration, {2.8f, 1.6f, -1.6f}}});
  // A centimetre off the ball (between its two moments it is up to 5 mm larger).
  const float skim = kSwollen + 0.013f;
  path(graze, Interpolation::linear,
       {{0, {-2.6f, kHeight + 0.6f, skim + 1}},
        {2, {-0.8f, kHeight + 0.2f, skim + 0.1f}},
        {kSecondBall, {0, kHeight, skim}},
        {4, {0.8f, kHeight - 0.13f, skim + 0.17f}},
        {kDuration, {2.4f, kHeight - 0.4f, skim + 1.2f}}});
  // In from the front, resting half-way inside, and out again.
  path(enter, Interpolation::cubicSpline,
       {{0, {-1.6f, 0.9f, 2.6f}},
        {3, {-1, 0.55f, 2}},
        {3.9f, {-0.1f, 0.65f, 0.35f}},
        {4.3f, {-0.1f, 0.7f, 0.3f}},
        {5.1f, {-0.8f, 0.95f, 1.8f}},
        {kDuration, {-1.3f, 1.1f, 2.5f}}});
  // Straight through the middle of the body and of its box.
  const glm::vec3 middle{0, kHeight, 0}, along{0.84f, 0.49f, 0.97f};
  path(
      cross, Interpolation::linear,
      {{0, middle - 2.6f * along}, {4.8f, middle - 1.2f * along}, {5.8f, middle}, {kDuration, middle + 1.44f * along}});

  const Key<std::vector<float>> weights[] = {{0, {0, 0}},          {0.6f, {0, 0.2f}},     {1.3f, {0.7f, 0.2f}},
                                             {kFirstBall, {1, 0}}, {kSecondBall, {1, 0}}, {3.6f, {0.7f, 0.3f}},
                                             {4.4f, {0.1f, 1}},    {5.6f, {0.3f, 0.5f}},  {kDuration, {0, 0}}};
  play.weights(body, Interpolation::cubicSpline, weights);
  scene.animations.push_back(play.finish());
  return scene;
}

}  // namespace rigel::tools
