// A body as a distance field: ellipsoids for the trunk, tapered limbs, all blended; meshed once and bound to the bones.
#include "samples/figure_mesh.h"

#include "samples/implicit_surface.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

constexpr float kCell = 0.0185f;      // m; the finest that keeps the figure below 20k triangles
constexpr float kHandCell = 0.0075f;  // m; half a finger
constexpr float kSkinBlend = 0.06f;   // m over which skin passes from one bone to the next

// Two cones that continue each other overlap all round their joint: a wide blend would swell it.
constexpr float kChainBlend = 0.02f;

constexpr glm::vec3 kShoulder{0.19f, 1.44f, -0.015f}, kElbow{0.395f, 1.235f, -0.02f}, kWrist{0.578f, 1.052f, 0},
    kKnuckle{0.642f, 0.988f, 0.004f}, kFingertip{0.71f, 0.92f, 0.012f};
constexpr glm::vec3 kHip{0.095f, 0.94f, 0}, kKnee{0.105f, 0.52f, 0.012f}, kAnkle{0.11f, 0.09f, -0.022f},
    kToe{0.125f, 0.033f, 0.135f};

glm::vec3 mirror(glm::vec3 p, float side) { return {p.x * side, p.y, p.z}; }

std::vector<Bone> makeBones() {
  using J = FigureJoint;
  std::vector<Bone> bones(J::count);
  bones[J::hips] = {"hips", -1, {0, 0.96f, 0}, {0, 1.03f, 0}, 0.13f, 0.12f};
  bones[J::spine] = {"spine", J::hips, {0, 1.08f, 0}, {0, 1.2f, 0}, 0.11f, 0.12f};
  bones[J::chest] = {"chest", J::spine, {0, 1.27f, 0}, {0, 1.4f, -0.01f}, 0.125f, 0.12f};
  bones[J::neck] = {"neck", J::chest, {0, 1.48f, -0.012f}, {0, 1.56f, 0}, 0.055f, 0.05f};
  bones[J::head] = {"head", J::neck, {0, 1.62f, 0.012f}, {0, 1.7f, 0.015f}, 0.085f, 0.095f};
  for (const int base : {J::left, J::right}) {
    const float side = base == J::left ? 1.0f : -1.0f;
    const std::string suffix = side > 0 ? " left" : " right";
    const auto limb = [&](int index, const char* name, int parent, glm::vec3 head, glm::vec3 tail, float r0, float r1) {
      bones[base + index] = {name + suffix, parent, mirror(head, side), mirror(tail, side), r0, r1};
    };
    limb(J::clavicle, "clavicle", J::chest, {0.05f, 1.43f, -0.01f}, {0.15f, 1.445f, -0.015f}, 0.065f, 0.06f);
    limb(J::upperArm, "upper arm", base + J::clavicle, kShoulder, kElbow, 0.058f, 0.042f);
    limb(J::forearm, "forearm", base + J::upperArm, kElbow, kWrist, 0.043f, 0.028f);
    limb(J::hand, "hand", base + J::forearm, kWrist, kKnuckle, 0.03f, 0.034f);
    limb(J::fingers, "fingers", base + J::hand, kKnuckle, kFingertip, 0.03f, 0.03f);
    limb(J::thigh, "thigh", J::hips, kHip, kKnee, 0.092f, 0.058f);
    limb(J::shin, "shin", base + J::thigh, kKnee, kAnkle, 0.056f, 0.037f);
    limb(J::foot, "foot", base + J::shin, kAnkle, kToe, 0.04f, 0.03f);
  }
  return bones;
}

float handDistance(glm::vec3 p) {
  // The palm faces the thigh: fingers fan out along z, the thumb points forward.
  const glm::vec3 palm = glm::mix(kWrist, kKnuckle, 0.55f);
  float d =
      roundConeDistance(p, palm + glm::vec3(0, 0, -0.02f), palm + glm::vec3(0.012f, -0.012f, 0.024f), 0.026f, 0.024f);
  d = smoothUnion(d, roundConeDistance(p, kWrist, palm, 0.026f, 0.028f), 0.02f);
  constexpr float kReach[4] = {0.82f, 0.97f, 1.0f, 0.9f};
  for (int i = 0; i < 4; ++i) {
    const float across = static_cast<float>(i) - 1.5f;
    const glm::vec3 root = glm::mix(kWrist, kKnuckle, 0.9f) + glm::vec3(0, 0, 0.021f * across);
    const glm::vec3 tip = kKnuckle + (kFingertip - kKnuckle) * kReach[i] + glm::vec3(0, 0, 0.032f * across);
    d = smoothUnion(d, roundConeDistance(p, root, tip, 0.0125f, 0.0095f), 0.008f);
  }
  const glm::vec3 thumbRoot = glm::mix(kWrist, kKnuckle, 0.3f) + glm::vec3(-0.005f, -0.005f, 0.02f);
  return smoothUnion(d, roundConeDistance(p, thumbRoot, thumbRoot + glm::vec3(0.03f, -0.04f, 0.052f), 0.015f, 0.011f),
                     0.015f);
}

/// Shoulder to wrist.
float armDistance(glm::vec3 p) {
  const glm::vec3 forearmBelly = glm::mix(kElbow, kWrist, 0.3f);
  float d = roundConeDistance(p, kShoulder, kElbow, 0.052f, 0.037f);
  d = smoothUnion(d, ellipsoidDistance(p, kShoulder + glm::vec3(0.022f, -0.04f, 0), glm::vec3(0.05f, 0.07f, 0.054f)),
                  0.03f);
  d = smoothUnion(d, roundConeDistance(p, kElbow, forearmBelly, 0.035f, 0.039f), kChainBlend);
  return smoothUnion(d, roundConeDistance(p, forearmBelly, kWrist, 0.039f, 0.024f), kChainBlend);
}

float legDistance(glm::vec3 p) {
  const glm::vec3 calf = glm::mix(kKnee, kAnkle, 0.3f) + glm::vec3(0, 0, -0.022f);
  const glm::vec3 heel = kAnkle + glm::vec3(0, -0.052f, -0.03f);
  float d = roundConeDistance(p, kHip, kKnee, 0.09f, 0.056f);
  d = smoothUnion(d, roundConeDistance(p, kKnee, calf, 0.051f, 0.053f), kChainBlend);
  d = smoothUnion(d, roundConeDistance(p, calf, kAnkle, 0.053f, 0.032f), kChainBlend);
  float foot = roundConeDistance(p, heel, kAnkle + glm::vec3(0, -0.02f, 0.02f), 0.036f, 0.04f);
  foot = smoothUnion(foot, roundConeDistance(p, kAnkle + glm::vec3(0, -0.025f, 0.02f), kToe, 0.04f, 0.027f), 0.03f);
  foot = smoothUnion(
      foot, roundConeDistance(p, kToe + glm::vec3(-0.03f, 0, 0), kToe + glm::vec3(0.028f, 0, -0.015f), 0.028f, 0.026f),
      0.03f);
  // Flat soles: smooth maximum with the half space above the ground.
  foot = -smoothUnion(-foot, p.y - 0.004f, 0.02f);
  return smoothUnion(d, foot, 0.03f);
}

float bodyDistance(glm::vec3 p) {
  const glm::vec3 q{std::abs(p.x), p.y, p.z};  // both sides at once
  float d = ellipsoidDistance(p, {0, 1.31f, -0.005f}, {0.165f, 0.185f, 0.112f});
  d = smoothUnion(d, ellipsoidDistance(p, {0, 1.1f, 0}, {0.126f, 0.17f, 0.092f}), 0.1f);
  d = smoothUnion(d, ellipsoidDistance(p, {0, 0.97f, -0.005f}, {0.148f, 0.12f, 0.108f}), 0.08f);
  d = smoothUnion(d, ellipsoidDistance(q, {0.072f, 0.925f, -0.05f}, {0.085f, 0.09f, 0.075f}), 0.06f);
  d = smoothUnion(d, ellipsoidDistance(q, {0.075f, 1.35f, 0.06f}, {0.075f, 0.06f, 0.042f}), 0.06f);
  d = smoothUnion(d, roundConeDistance(q, {0.03f, 1.46f, -0.02f}, kShoulder, 0.05f, 0.045f), 0.05f);
  d = smoothUnion(d, armDistance(q), 0.04f);
  d = smoothUnion(d, legDistance(q), 0.05f);
  return smoothUnion(d, figureHeadDistance(p), 0.03f);
}

/// Distance to the whole, hands included: what normals come from, so that shading does not show where meshes meet.
float wholeDistance(glm::vec3 p) {
  const glm::vec3 q{std::abs(p.x), p.y, p.z};
  return smoothUnion(bodyDistance(p), handDistance(q), 0.02f);
}

/// Body and hands as one primitive: fingers need finer cells than the rest can afford, so that the hands are meshed by
/// themselves and start inside the wrists.
Primitive makeMesh() {
  Primitive mesh = meshImplicit(bodyDistance, {-0.62f, -0.01f, -0.2f}, {0.62f, 1.82f, 0.22f}, kCell, wholeDistance);
  for (const float side : {1.0f, -1.0f}) {
    const auto hand = [side](glm::vec3 p) { return handDistance({p.x * side, p.y, p.z}); };
    const glm::vec3 low{0.535f, 0.88f, -0.085f}, high{0.745f, 1.09f, 0.12f};
    append(mesh,
           meshImplicit(hand, {side > 0 ? low.x : -high.x, low.y, low.z}, {side > 0 ? high.x : -low.x, high.y, high.z},
                        kHandCell, wholeDistance),
           glm::mat4(1));
  }
  return mesh;
}

}  // namespace

float figureHeadDistance(glm::vec3 p) {
  float d = ellipsoidDistance(p, {0, 1.69f, -0.005f}, {0.078f, 0.108f, 0.1f});
  d = smoothUnion(d, ellipsoidDistance(p, {0, 1.625f, 0.03f}, {0.056f, 0.07f, 0.066f}), 0.05f);
  d = smoothUnion(d, roundConeDistance(p, {0, 1.685f, 0.084f}, {0, 1.652f, 0.094f}, 0.009f, 0.014f), 0.02f);  // nose
  const glm::vec3 q{std::abs(p.x), p.y, p.z};
  d = smoothUnion(d, ellipsoidDistance(q, {0.08f, 1.66f, -0.005f}, {0.014f, 0.032f, 0.022f}), 0.015f);  // ears
  return smoothUnion(d, roundConeDistance(p, {0, 1.46f, -0.02f}, {0, 1.6f, 0}, 0.06f, 0.05f), 0.04f);
}

Figure addFigure(Scene& scene) {
  const std::vector<Bone> bones = makeBones();
  Primitive body = makeMesh();
  bindToBones(body, bones, kSkinBlend);
  body.material = addMaterial(scene, "clay", {0.72f, 0.62f, 0.54f});

  Figure figure;
  figure.node = addNode(scene, "figure", kNoParent);
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(body));
  scene.nodes[figure.node].mesh = addMesh(scene, "figure", std::move(primitives));
  figure.skeleton = addSkeleton(scene, "figure", kNoParent, bones);
  scene.nodes[figure.node].skin = figure.skeleton.skin;
  return figure;
}

}  // namespace rigel::tools
