// A long body undulates among forty small lights of all colours, some within a hand's breadth: no low-order function of
// position over an 8 m box follows them all.
#include "samples/animation_builder.h"
#include "samples/implicit_surface.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"
#include "samples/skeleton_builder.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

constexpr float kDuration = 4;
constexpr float kCell = 0.05f;
constexpr float kSkinBlend = 0.3f;

/// The body's axis: z, height and radius from tail tip to the back of the head.
struct Ring {
  float z, y, radius;
};
constexpr Ring kAxis[] = {{-4.0f, 0.3f, 0.03f},  {-3.4f, 0.27f, 0.07f}, {-2.9f, 0.29f, 0.11f}, {-2.4f, 0.34f, 0.16f},
                          {-1.8f, 0.41f, 0.22f}, {-1.2f, 0.47f, 0.28f}, {-0.6f, 0.5f, 0.32f},  {0, 0.51f, 0.34f},
                          {0.6f, 0.51f, 0.36f},  {1.2f, 0.53f, 0.34f},  {1.9f, 0.6f, 0.24f},   {2.6f, 0.69f, 0.18f},
                          {3.2f, 0.7f, 0.17f}};
constexpr int kRings = static_cast<int>(std::size(kAxis));
constexpr int kRoot = 7;  // the ring at the middle of the body

glm::vec3 axisPoint(int ring) { return {0, kAxis[ring].y, kAxis[ring].z}; }

/// Root, then bones forward to head and jaw, then bones backward to the tail's tip: 14 joints.
std::vector<Bone> makeBones() {
  std::vector<Bone> bones{
      {"body", -1, axisPoint(kRoot), axisPoint(kRoot + 1), kAxis[kRoot].radius, kAxis[kRoot + 1].radius}};
  const char* const forward[] = {"chest", "shoulders", "neck 1", "neck 2"};
  for (int i = 0; i < 4; ++i) {
    const int ring = kRoot + 1 + i;
    bones.push_back({forward[i], i, axisPoint(ring), axisPoint(ring + 1), kAxis[ring].radius, kAxis[ring + 1].radius});
  }
  bones.push_back({"head", 4, axisPoint(kRings - 1), {0, 0.69f, 3.85f}, 0.19f, 0.1f});
  bones.push_back({"jaw", 5, {0, 0.62f, 3.3f}, {0, 0.55f, 3.8f}, 0.08f, 0.05f});
  for (int ring = kRoot; ring > 0; --ring) {
    const int parent = ring == kRoot ? 0 : static_cast<int>(bones.size()) - 1;
    bones.push_back({"tail " + std::to_string(kRoot - ring + 1), parent, axisPoint(ring), axisPoint(ring - 1),
                     kAxis[ring].radius, kAxis[ring - 1].radius});
  }
  return bones;
}

float legDistance(glm::vec3 p, float z, float lean) {
  const glm::vec3 hip{0.24f, 0.46f, z}, knee{0.36f, 0.28f, z + lean}, ankle{0.36f, 0.09f, z - 0.5f * lean};
  float d = roundConeDistance(p, hip, knee, 0.15f, 0.095f);
  d = smoothUnion(d, roundConeDistance(p, knee, ankle, 0.09f, 0.065f), 0.05f);
  for (const float fan : {-0.07f, 0.0f, 0.07f}) {
    d = smoothUnion(d, roundConeDistance(p, ankle, {0.36f + fan, 0.055f, ankle.z + 0.19f}, 0.06f, 0.045f), 0.03f);
  }
  return d;
}

float bodyDistance(glm::vec3 p) {
  const glm::vec3 q{std::abs(p.x), p.y, p.z};
  float d = 1e3f;
  for (int i = 0; i + 1 < kRings; ++i) {
    const float blend = 0.3f * kAxis[i].radius + 0.01f;
    d = smoothUnion(d, roundConeDistance(p, axisPoint(i), axisPoint(i + 1), kAxis[i].radius, kAxis[i + 1].radius),
                    blend);
  }
  float head = roundConeDistance(p, {0, 0.72f, 3.28f}, {0, 0.69f, 3.6f}, 0.19f, 0.14f);
  head = smoothUnion(head, roundConeDistance(q, {0.03f, 0.685f, 3.55f}, {0.04f, 0.66f, 3.9f}, 0.12f, 0.075f), 0.06f);
  head = smoothUnion(head, roundConeDistance(q, {0.1f, 0.83f, 3.3f}, {0.08f, 0.79f, 3.52f}, 0.055f, 0.04f),
                     0.05f);                                                                            // brows
  head = smoothUnion(head, ellipsoidDistance(q, {0.06f, 0.73f, 3.9f}, {0.04f, 0.035f, 0.05f}), 0.04f);  // nostrils
  const float jaw = roundConeDistance(q, {0.04f, 0.6f, 3.3f}, {0.03f, 0.5f, 3.78f}, 0.09f, 0.055f);
  head = smoothUnion(head, jaw, 0.03f);
  d = smoothUnion(d, head, 0.1f);
  d = smoothUnion(d, legDistance(q, 1.15f, -0.1f), 0.1f);
  return smoothUnion(d, legDistance(q, -0.75f, 0.12f), 0.1f);
}

/// A flattened spike on `base`, leaning back, `height` long.
void addSpike(Primitive& out, glm::vec3 base, glm::vec3 direction, float height, float width) {
  std::vector<glm::vec2> profile;
  constexpr int kSteps = 6;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    profile.push_back({i == kSteps ? 0.0f : width * (1 - t) * (1 + 0.6f * t), height * t});
  }
  Primitive spike;
  spike.positions.reserve(128);
  profile.insert(profile.begin(), {0, 0});  // closed below
  addLathe(spike, profile, 14);
  for (glm::vec3& p : spike.positions) p.x *= 0.45f;
  finishNormals(spike, glm::radians(60.0f));
  const glm::vec3 up = glm::normalize(direction);
  const glm::vec3 right = glm::normalize(glm::cross(up, glm::vec3(0, 0, 1)));
  const glm::mat4 frame{glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(glm::cross(right, up), 0), glm::vec4(base, 1)};
  append(out, spike, frame);
}

Primitive makeSpikes() {
  Primitive out;
  for (int i = 1; i + 1 < kRings; ++i) {
    for (const float t : {0.0f, 0.5f}) {
      const glm::vec3 at = glm::mix(axisPoint(i), axisPoint(i + 1), t);
      const float radius = glm::mix(kAxis[i].radius, kAxis[i + 1].radius, t);
      const float size = 0.05f + 0.32f * radius;
      addSpike(out, at + glm::vec3(0, 0.93f * radius, 0), {0, 1, -0.55f}, size, 0.62f * size);
    }
  }
  for (const float side : {-1.0f, 1.0f}) {
    addSpike(out, {side * 0.11f, 0.84f, 3.22f}, {side * 0.3f, 0.35f, -1}, 0.42f, 0.06f);  // horns
    addSpike(out, {side * 0.17f, 0.72f, 3.25f}, {side * 0.8f, 0.1f, -1}, 0.22f, 0.045f);
  }
  return out;
}

Primitive makeEyes() {
  Primitive eye, out;
  addSphere(eye, 0.045f, 10);
  finishNormals(eye, glm::pi<float>());
  for (const float side : {-1.0f, 1.0f}) {
    append(out, eye, glm::translate(glm::mat4(1), glm::vec3(side * 0.135f, 0.765f, 3.5f)));
  }
  return out;
}

/// A saturated colour of unit mean.
Rgb hue(float h) {
  const auto channel = [h](float phase) { return 1 + 0.8f * std::cos(glm::two_pi<float>() * (h - phase)); };
  return {channel(0), channel(1.0f / 3), channel(2.0f / 3)};
}

void addLights(Scene& scene, AnimationBuilder& fly) {
  constexpr int kCount = 40;
  Scatter scatter(7);
  for (int i = 0; i < kCount; ++i) {
    // Evenly along the body, anywhere in the upper two thirds around it; every fourth within a hand's breadth.
    const float z = -4.4f + 8.8f * (static_cast<float>(i) + scatter.uniform(0.1f, 0.9f)) / kCount;
    const float angle = glm::radians(scatter.uniform(-25, 205));
    const bool isClose = i % 4 == 1;
    const float away = isClose ? scatter.uniform(0.78f, 0.9f) : scatter.uniform(1.1f, 2.6f);
    const glm::vec3 at{away * std::cos(angle), std::max(0.08f, 0.5f + 0.85f * away * std::sin(angle)), z};
    const float reach = away - 0.35f;  // to the body's surface
    const Rgb colour = hue(scatter.uniform(0, 1)) * (scatter.uniform(0.5f, 1.3f) * reach * reach);
    // Larger where farther: a small bright ball in a sample's place would drown everything else.
    const float radius = scatter.uniform(0.04f, 0.06f) * (1 + reach);
    const std::string name = "light " + std::to_string(i + 1);
    int node = -1;
    if (i % 3 == 2) {
      PointLight point;
      point.intensity = colour;
      point.radius = radius;
      node = addLight(scene, name, point, kNoParent, at);
    } else {
      node = addLight(scene, name, sphereOfIntensity(radius, colour), kNoParent, at);
    }
    if (isClose || i % 5 != 0) continue;
    // Fireflies: every fifth light wanders round a loop, back where it began at the end of the clip.
    const float phase = scatter.uniform(0, glm::two_pi<float>()), size = scatter.uniform(0.15f, 0.35f);
    fly.sampledTranslation(node, kDuration, 48, [=](float t) {
      const float a = phase + glm::two_pi<float>() * t / kDuration;
      const float zero = phase;
      return at + size * glm::vec3(std::cos(a) - std::cos(zero), 0.5f * (std::sin(2 * a) - std::sin(2 * zero)),
                                   1.5f * (std::sin(a) - std::sin(zero)));
    });
  }
}

/// World rotation of the body at z: a wave of headings runs from head to tail, a smaller one of pitches with it.
glm::quat heading(float z, float time) {
  constexpr float kYaw = 0.34f, kPitch = 0.09f;  // rad
  constexpr float kWaves = glm::two_pi<float>() / 4.6f;
  const float phase = kWaves * z + glm::two_pi<float>() * time / 2;  // two waves a clip
  return glm::angleAxis(kYaw * std::sin(phase), glm::vec3(0, 1, 0)) *
         glm::angleAxis(kPitch * std::sin(phase + 1.1f), glm::vec3(1, 0, 0));
}

}  // namespace

Scene makeDragon() {
  Scene scene;
  scene.name = "dragon";
  const std::vector<Bone> bones = makeBones();
  std::vector<Primitive> parts(3);
  parts[0] = meshImplicit(bodyDistance, {-0.56f, -0.01f, -4.06f}, {0.56f, 0.96f, 4.02f}, kCell);
  parts[1] = makeSpikes();
  parts[2] = makeEyes();
  bindToBones(parts[0], bones, kSkinBlend);
  bindToBones(parts[1], bones, kSkinBlend);
  bindToBone(parts[2], 5);
  parts[0].material = addMaterial(scene, "scales", {0.35f, 0.47f, 0.36f});
  parts[1].material = addMaterial(scene, "horn", {0.66f, 0.6f, 0.5f});
  parts[2].material = addMaterial(scene, "eye", {0.75f, 0.62f, 0.12f});

  const int dragon = addNode(scene, "dragon", kNoParent);
  scene.nodes[dragon].mesh = addMesh(scene, "dragon", std::move(parts));
  const Skeleton skeleton = addSkeleton(scene, "dragon", kNoParent, bones);
  scene.nodes[dragon].skin = skeleton.skin;

  Primitive ground;
  addFloor(ground, {-5, -7}, {5, 7}, 0);
  finishNormals(ground, 0);
  addScenery(scene, "ground", std::move(ground), addMaterial(scene, "stone", {0.22f, 0.21f, 0.2f}));

  AnimationBuilder fly("undulate");
  addLights(scene, fly);
  constexpr int kKeys = 40;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const auto middle = [&](std::size_t bone) { return 0.5f * (bones[bone].head.z + bones[bone].tail.z); };
    fly.sampledRotation(skeleton.joints[b], kDuration, kKeys, [&](float t) {
      const bool isJaw = bones[b].name == "jaw";
      if (isJaw) return glm::angleAxis(0.12f * (1 - std::cos(glm::pi<float>() * t)), glm::vec3(1, 0, 0));
      const glm::quat own = heading(middle(b), t);
      return bones[b].parent < 0 ? own : glm::inverse(heading(middle(bones[b].parent), t)) * own;
    });
  }
  // The integral of the headings: without it the middle would stand still and the ends sweep twice as far.
  const glm::vec3 root = bones[0].head;
  fly.sampledTranslation(skeleton.joints[0], kDuration, kKeys, [&](float t) {
    return root + glm::vec3(-0.22f * std::cos(glm::two_pi<float>() * t / 2),
                            0.05f + 0.02f * std::sin(glm::pi<float>() * t), 0);
  });
  scene.animations.push_back(fly.finish());
  return scene;
}

}  // namespace rigel::tools
