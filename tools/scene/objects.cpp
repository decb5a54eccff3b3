// Which parts of a scene get a rig: SceneObject from nodes, skins and marks.
#include "scene/pose.h"
#include "scene/transform.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace rigel::tools {
namespace {

// What findObjects needs to know of each node beyond its own fields.
struct NodeFacts {
  std::vector<bool> inScene;
  std::vector<bool> isStatic;     // itself or a node above
  std::vector<int> markedObject;  // the outermost marked node at or above, -1 without
};

NodeFacts gatherFacts(const Scene& scene) {
  const std::size_t count = scene.nodes.size();
  NodeFacts facts{std::vector<bool>(count, false), std::vector<bool>(count, false), std::vector<int>(count, -1)};
  std::vector<int> pending = scene.roots;
  while (!pending.empty()) {
    const int i = pending.back();
    pending.pop_back();
    const Node& node = scene.nodes[i];
    const int parent = node.parent;
    facts.inScene[i] = true;
    facts.isStatic[i] = node.isStatic || (parent >= 0 && facts.isStatic[parent]);
    facts.markedObject[i] = parent >= 0 ? facts.markedObject[parent] : -1;
    if (facts.markedObject[i] < 0 && node.isObject) facts.markedObject[i] = i;
    pending.insert(pending.end(), node.children.begin(), node.children.end());
  }
  return facts;
}

// Does the node's rest transform turn the mesh inside out? glTF then reverses the winding. For a skinned primitive the
// joint that moves its first vertex most stands for all.
bool mirrored(const Scene& scene, const Node& node, const Primitive& primitive, const glm::mat4& worldFromNode,
              const ScenePose& rest) {
  glm::mat4 m = worldFromNode;
  if (node.skin >= 0 && !primitive.influences.empty()) {
    const Skin& skin = scene.skins[node.skin];
    const Influences& first = primitive.influences.front();
    const auto strongest = std::max_element(first.weight.begin(), first.weight.end()) - first.weight.begin();
    const int joint = first.joint[strongest];
    m = rest.worldFromNode[skin.joints[joint]] * skin.inverseBind[joint];
  }
  return glm::determinant(glm::mat3(m)) < 0;
}

void appendMesh(const Scene& scene, int nodeIndex, const ScenePose& rest, SceneObject& object) {
  const Node& node = scene.nodes[nodeIndex];
  object.meshNodes.push_back(nodeIndex);
  for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
    const bool flip = mirrored(scene, node, primitive, rest.worldFromNode[nodeIndex], rest);
    const auto base = static_cast<glm::uint>(object.vertexCount);
    const Material material = primitive.material >= 0 ? scene.materials[primitive.material] : Material{};
    for (const glm::uvec3& t : primitive.triangles) {
      object.triangles.push_back(base + (flip ? glm::uvec3(t.x, t.z, t.y) : t));
      object.triangleWrap.push_back(material.wrap);
      object.triangleColour.push_back(material.baseColour);
    }
    object.vertexCount += static_cast<int>(primitive.positions.size());
  }
}

std::string firstNonEmpty(std::initializer_list<std::string> names) {
  for (const std::string& name : names) {
    if (!name.empty()) return name;
  }
  return "object";
}

std::string nodeOrMeshName(const Scene& scene, int node) {
  const Node& n = scene.nodes[node];
  return firstNonEmpty({n.name, n.mesh >= 0 ? scene.meshes[n.mesh].name : std::string()});
}

std::string skinnedName(const Scene& scene, const SceneObject& object, const Skin& skin) {
  if (object.meshNodes.size() == 1) return nodeOrMeshName(scene, object.meshNodes.front());
  return firstNonEmpty(
      {skin.name, scene.nodes[skin.skeletonRoot].name, nodeOrMeshName(scene, object.meshNodes.front())});
}

void makeNamesUnique(std::vector<SceneObject>& objects) {
  std::unordered_set<std::string> taken;
  std::unordered_map<std::string, int>
      suffixes;  // the last one given to each name: thousands may have none of their own
  for (SceneObject& object : objects) {
    if (taken.insert(object.name).second) continue;
    int& suffix = suffixes.try_emplace(object.name, 1).first->second;
    std::string name;
    do name = object.name + " " + std::to_string(++suffix);
    while (!taken.insert(name).second);
    object.name = std::move(name);
  }
}

}  // namespace

std::vector<SceneObject> findObjects(const Scene& scene) {
  const NodeFacts facts = gatherFacts(scene);
  ScenePose rest;
  poseScene(scene, kRestPose, 0, rest);

  std::vector<SceneObject> objects;
  std::vector<int> objectOfMark(scene.nodes.size(), -1);
  std::vector<int> objectOfSkin(scene.skins.size(), -1);
  std::vector<int> skinOfObject;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int index = static_cast<int>(i);
    const Node& node = scene.nodes[i];
    if (!facts.inScene[i] || node.mesh < 0) continue;
    const int mark = facts.markedObject[i];
    int none = -1;
    int& slot = mark >= 0 ? objectOfMark[mark] : node.skin >= 0 ? objectOfSkin[node.skin] : none;
    if (slot < 0) {
      slot = static_cast<int>(objects.size());
      SceneObject object;
      object.isStatic = facts.isStatic[mark >= 0 ? mark : index];
      object.frameNode = mark >= 0 ? mark : node.skin >= 0 ? scene.skins[node.skin].skeletonRoot : index;
      object.name = nodeOrMeshName(scene, mark >= 0 ? mark : index);
      objects.push_back(std::move(object));
      skinOfObject.push_back(mark < 0 ? node.skin : -1);
    }
    SceneObject& object = objects[slot];
    if (mark < 0) object.isStatic = object.isStatic && facts.isStatic[i];
    appendMesh(scene, index, rest, object);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (skinOfObject[i] >= 0) objects[i].name = skinnedName(scene, objects[i], scene.skins[skinOfObject[i]]);
  }
  std::erase_if(objects, [](const SceneObject& object) { return object.triangles.empty(); });
  makeNamesUnique(objects);
  return objects;
}

}  // namespace rigel::tools
