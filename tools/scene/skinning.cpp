// poseObject: morph targets, then linear blend skinning or the node's transform.
#include "scene/pose.h"
#include "scene/transform.h"

#include <cassert>

namespace rigel::tools {
namespace {

void morph(const Primitive& primitive, const std::vector<float>& weights, glm::vec3* positions, glm::vec3* normals) {
  const std::size_t count = primitive.positions.size();
  for (std::size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
    const float w = weights[t];
    if (w == 0) continue;
    const MorphTarget& target = primitive.targets[t];
    for (std::size_t v = 0; v < target.positions.size() && v < count; ++v) positions[v] += w * target.positions[v];
    if (primitive.normals.empty()) continue;
    for (std::size_t v = 0; v < target.normals.size() && v < count; ++v) normals[v] += w * target.normals[v];
  }
}

void transformRigid(const glm::mat4& worldFromNode, bool smooth, std::size_t count, glm::vec3* positions,
                    glm::vec3* normals) {
  const glm::mat3 linear(worldFromNode);
  const glm::vec3 offset(worldFromNode[3]);
  const glm::mat3 forNormals = normalMatrix(linear);
  for (std::size_t v = 0; v < count; ++v) positions[v] = linear * positions[v] + offset;
  if (!smooth) return;
  for (std::size_t v = 0; v < count; ++v) normals[v] = normalizeOrZero(forNormals * normals[v]);
}

void transformSkinned(const Primitive& primitive, const std::vector<glm::mat4>& skinMatrices, glm::vec3* positions,
                      glm::vec3* normals) {
  const bool smooth = !primitive.normals.empty();
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    const Influences& in = primitive.influences[v];
    glm::mat4 blended = skinMatrices[in.joint[0]] * in.weight[0];
    for (std::size_t k = 1; k < in.weight.size(); ++k) {
      if (in.weight[k] != 0) blended += skinMatrices[in.joint[k]] * in.weight[k];
    }
    const glm::mat3 linear(blended);
    positions[v] = linear * positions[v] + glm::vec3(blended[3]);
    if (smooth) normals[v] = normalizeOrZero(normalMatrix(linear) * normals[v]);
  }
}

}  // namespace

void poseObject(const Scene& scene, const SceneObject& object, const ScenePose& pose, PosedObject& out) {
  out.worldFromRig = object.frameNode >= 0 ? pose.worldFromNode[object.frameNode] : glm::mat4(1);
  out.positions.resize(static_cast<std::size_t>(object.vertexCount));
  out.normals.resize(static_cast<std::size_t>(object.vertexCount));
  std::size_t base = 0;
  int matricesOf = -1;  // the skin that out.skinMatrices belongs to
  for (const int nodeIndex : object.meshNodes) {
    const Node& node = scene.nodes[nodeIndex];
    if (node.skin >= 0 && node.skin != matricesOf) {
      const Skin& skin = scene.skins[node.skin];
      out.skinMatrices.resize(skin.joints.size());
      for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        out.skinMatrices[j] = pose.worldFromNode[skin.joints[j]] * skin.inverseBind[j];
      }
      matricesOf = node.skin;
    }
    for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
      const std::size_t count = primitive.positions.size();
      assert(base + count <= out.positions.size());
      glm::vec3* positions = out.positions.data() + base;
      glm::vec3* normals = out.normals.data() + base;
      std::copy(primitive.positions.begin(), primitive.positions.end(), positions);
      if (primitive.normals.empty()) {
        std::fill_n(normals, count, glm::vec3(0));
      } else {
        std::copy(primitive.normals.begin(), primitive.normals.end(), normals);
      }
      morph(primitive, pose.morphWeights[nodeIndex], positions, normals);
      if (node.skin >= 0 && !primitive.influences.empty()) {
        transformSkinned(primitive, out.skinMatrices, positions, normals);
      } else {
        transformRigid(pose.worldFromNode[nodeIndex], !primitive.normals.empty(), count, positions, normals);
      }
      base += count;
    }
  }
}

}  // namespace rigel::tools
