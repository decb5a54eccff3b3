// Lights at every place where formulas divide by zero: one brushes the top of a body, one touches its side, one goes in
// and out, one crosses its very middle, and a point of zero radius grazes it at a centimetre. The body morphs
// meanwhile.
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
constexpr float kDuration = 3;

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
  // Tangent to the flat top of the cube, which is there at the start and at the end.
  const float top = kHeight + kHalf + 0.15f;
  path(brush, Interpolation::linear,
       {{0, {-0.9f, top, 0.1f}}, {1.1f, {0.5f, top, 0.1f}}, {kDuration, {2.2f, top, 0.3f}}});
  // Against the ball at 1.5 s, just in contact.
  const float side = kSwollen + 0.25f;
  path(touch, Interpolation::cubicSpline,
       {{0, {2.0f, kHeight, 0.5f}}, {1.5f, {side, kHeight, 0}}, {kDuration, {1.9f, kHeight, -0.6f}}});
  // In from the front, resting half-way inside, and out again.
  path(enter, Interpolation::cubicSpline,
       {{0, {-0.7f, 0.5f, 1.6f}},
        {1.9f, {-0.1f, 0.65f, 0.35f}},
        {2.3f, {-0.1f, 0.7f, 0.3f}},
        {kDuration, {-0.6f, 0.9f, 1.3f}}});
  // Straight through the middle of the body and of its box.
  const glm::vec3 middle{0, kHeight, 0}, along{0.95f, 0.55f, 1.1f};
  path(cross, Interpolation::linear, {{0, middle - along}, {kDuration, middle + along}});
  // A centimetre above the ball when it is fully swollen (the spline overshoots by 3 mm at most).
  const float skim = kSwollen + 0.013f;
  path(graze, Interpolation::linear,
       {{0, {-1.2f, kHeight + 0.3f, skim + 0.15f}},
        {1.5f, {0, kHeight, skim}},
        {kDuration, {1.2f, kHeight - 0.2f, skim + 0.25f}}});

  const Key<std::vector<float>> weights[] = {{0, {0, 0}},        {0.6f, {0, 0.5f}},    {1.1f, {0.6f, 0.2f}},
                                             {1.5f, {1, 0}},     {1.9f, {0.6f, 0.3f}}, {2.4f, {0.1f, 1}},
                                             {kDuration, {0, 0}}};
  play.weights(body, Interpolation::cubicSpline, weights);
  scene.animations.push_back(play.finish());
  return scene;
}

}  // namespace rigel::tools
