#include "samples/scene_builder.h"

#include <rigel/sh.h>

#include <glm/geometric.hpp>

#include <utility>

namespace rigel::tools {

int addNode(Scene& scene, std::string name, int parent, glm::vec3 translation) {
  const int index = static_cast<int>(scene.nodes.size());
  Node node;
  node.name = std::move(name);
  node.parent = parent;
  node.translation = translation;
  scene.nodes.push_back(std::move(node));
  (parent == kNoParent ? scene.roots : scene.nodes[static_cast<std::size_t>(parent)].children).push_back(index);
  return index;
}

int addMaterial(Scene& scene, std::string name, glm::vec3 baseColour, float wrap) {
  scene.materials.push_back({std::move(name), baseColour, wrap});
  return static_cast<int>(scene.materials.size()) - 1;
}

int addMesh(Scene& scene, std::string name, std::vector<Primitive> primitives) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.primitives = std::move(primitives);
  scene.meshes.push_back(std::move(mesh));
  return static_cast<int>(scene.meshes.size()) - 1;
}

int addMeshNode(Scene& scene, std::string name, int parent, Primitive primitive, int material) {
  primitive.material = material;
  const int node = addNode(scene, name, parent);
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(primitive));
  const int mesh = addMesh(scene, std::move(name), std::move(primitives));
  scene.nodes[static_cast<std::size_t>(node)].mesh = mesh;
  return node;
}

int addScenery(Scene& scene, std::string name, Primitive primitive, int material) {
  const int node = addMeshNode(scene, std::move(name), kNoParent, std::move(primitive), material);
  scene.nodes[static_cast<std::size_t>(node)].isStatic = true;
  return node;
}

int addLight(Scene& scene, std::string name, LightShape shape, int parent, glm::vec3 position, glm::vec3 direction) {
  // glTF: a light shines along its node's -z, from its origin.
  if (auto* directional = std::get_if<DirectionalLight>(&shape)) directional->direction = {0, 0, -1};
  if (auto* spot = std::get_if<SpotLight>(&shape)) spot->direction = {0, 0, -1};
  if (auto* disk = std::get_if<DiskLight>(&shape)) disk->direction = {0, 0, -1};
  const int node = addNode(scene, name, parent, position);
  scene.nodes[static_cast<std::size_t>(node)].rotation = aim(direction);
  scene.nodes[static_cast<std::size_t>(node)].light = static_cast<int>(scene.lights.size());
  scene.lights.push_back({std::move(name), shape});
  return node;
}

glm::quat aim(glm::vec3 direction) {
  const glm::vec3 d = glm::normalize(direction), from{0, 0, -1};
  const float c = glm::dot(from, d);
  if (c < -0.9999f) return {0, 0, 1, 0};  // half a turn about y
  return glm::normalize(glm::quat(1 + c, glm::cross(from, d)));
}

SphereLight sphereOfIntensity(float radius, Rgb colour) {
  const auto area = static_cast<float>(kPi) * radius * radius;
  return {{}, radius, colour * (1 / area)};
}

std::uint32_t Scatter::next() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ull + 1442695040888963407ull;
  const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  const auto turn = static_cast<std::uint32_t>(old >> 59);
  return (mixed >> turn) | (mixed << ((32 - turn) & 31));
}

float Scatter::uniform(float low, float high) {
  return low + (high - low) * static_cast<float>(next() >> 8) * 0x1p-24f;
}

}  // namespace rigel::tools
