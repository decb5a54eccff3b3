#include "scene/pose.h"

#include "scene/animation.h"
#include "scene/transform.h"

#include <rigel/glm.h>

#include <algorithm>
#include <cassert>
#include <unordered_map>

namespace rigel::tools {
namespace {

void applyChannel(const Channel& channel, double time, ScenePose& out) {
  ScenePose::Local& local = out.local[channel.node];
  if (channel.path == AnimationPath::weights) {
    std::vector<float>& weights = out.morphWeights[channel.node];
    if (weights.size() == static_cast<std::size_t>(channel.width)) sampleChannel(channel, time, weights.data());
    return;
  }
  float v[4];
  assert(channel.width == (channel.path == AnimationPath::rotation ? 4 : 3));
  sampleChannel(channel, time, v);
  switch (channel.path) {
    case AnimationPath::translation:
      local.translation = {v[0], v[1], v[2]};
      break;
    case AnimationPath::rotation:
      local.rotation = glm::quat(v[3], v[0], v[1], v[2]);
      break;
    case AnimationPath::scale:
      local.scale = {v[0], v[1], v[2]};
      break;
    case AnimationPath::weights:
      break;
  }
}

// The way a node's light shines: local -z. A node flattened along z still has the direction across its other axes.
glm::vec3 lightDirection(const glm::mat4& worldFromNode) {
  const glm::vec3 forward = normalizeOrZero(-glm::vec3(worldFromNode[2]));
  if (forward != glm::vec3(0)) return forward;
  const glm::vec3 across = normalizeOrZero(-glm::cross(glm::vec3(worldFromNode[0]), glm::vec3(worldFromNode[1])));
  return across != glm::vec3(0) ? across : glm::vec3(0, 0, -1);
}

float largestScale(const glm::mat4& worldFromNode) {
  float largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, glm::length(glm::vec3(worldFromNode[axis])));
  return largest;
}

template <class Light>
Light placed(Light light, const glm::mat4& worldFromNode, bool scales) {
  if constexpr (requires { light.position; }) light.position = fromGlm(glm::vec3(worldFromNode[3]));
  if constexpr (requires { light.direction; }) light.direction = fromGlm(lightDirection(worldFromNode));
  if constexpr (requires { light.twoSided; }) {
    if (scales) light.radius *= largestScale(worldFromNode);
  }
  return light;
}

}  // namespace

std::vector<bool> nodesInScene(const Scene& scene) {
  std::vector<bool> inScene(scene.nodes.size(), false);
  std::vector<int> pending = scene.roots;
  while (!pending.empty()) {
    const int i = pending.back();
    pending.pop_back();
    inScene[i] = true;
    pending.insert(pending.end(), scene.nodes[i].children.begin(), scene.nodes[i].children.end());
  }
  return inScene;
}

void poseScene(const Scene& scene, int clip, double time, ScenePose& out) {
  const std::size_t count = scene.nodes.size();
  out.worldFromNode.resize(count);
  out.morphWeights.resize(count);
  out.local.resize(count);
  out.pending.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = scene.nodes[i];
    out.local[i] = {node.translation, glm::normalize(node.rotation), node.scale};
    if (node.mesh < 0) {
      out.morphWeights[i].clear();
    } else {
      out.morphWeights[i] = node.morphWeights.empty() ? scene.meshes[node.mesh].morphWeights : node.morphWeights;
    }
    if (node.parent < 0) out.pending.push_back(static_cast<int>(i));
  }
  if (clip >= 0) {
    assert(static_cast<std::size_t>(clip) < scene.animations.size());
    for (const Channel& channel : scene.animations[clip].channels) applyChannel(channel, time, out);
  }
  while (!out.pending.empty()) {
    const int i = out.pending.back();
    out.pending.pop_back();
    const Node& node = scene.nodes[i];
    const ScenePose::Local& local = out.local[i];
    const glm::mat4 parentFromNode =
        node.hasMatrix ? node.matrix : composeTransform(local.translation, local.rotation, local.scale);
    out.worldFromNode[i] = node.parent < 0 ? parentFromNode : out.worldFromNode[node.parent] * parentFromNode;
    out.pending.insert(out.pending.end(), node.children.begin(), node.children.end());
  }
}

void poseLights(const Scene& scene, const ScenePose& pose, PosedLights& out) {
  out.set.clear();
  out.names.clear();
  const std::vector<bool> inScene = nodesInScene(scene);
  std::unordered_map<std::string, int> uses;
  for (std::size_t kind = 0; kind < std::variant_size_v<LightShape>; ++kind) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      const Node& node = scene.nodes[i];
      if (node.light < 0 || !inScene[i]) continue;
      const SceneLight& light = scene.lights[node.light];
      if (light.shape.index() != kind) continue;
      std::visit([&](const auto& shape) { out.set.add(placed(shape, pose.worldFromNode[i], light.scalesWithNode)); },
                 light.shape);
      std::string name = !light.name.empty() ? light.name : !node.name.empty() ? node.name : "light";
      const int use = ++uses[name];
      out.names.push_back(use == 1 ? std::move(name) : name + " " + std::to_string(use));
    }
  }
}

}  // namespace rigel::tools
