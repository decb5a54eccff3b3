// Skins: joints, inverse bind matrices, the skeleton root; every joint number of a skinned vertex exists.
#include "scene/gltf_import.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace rigel::tools {
namespace {

int depthOf(const std::vector<Node>& nodes, int node) {
  int depth = 0;
  for (; nodes[node].parent >= 0; node = nodes[node].parent) ++depth;
  return depth;
}

// The node at or above both; -1 when they are in different trees.
int commonAncestor(const std::vector<Node>& nodes, int a, int b) {
  int depthA = depthOf(nodes, a), depthB = depthOf(nodes, b);
  for (; depthA > depthB; --depthA) a = nodes[a].parent;
  for (; depthB > depthA; --depthB) b = nodes[b].parent;
  while (a != b && a >= 0 && b >= 0) {
    a = nodes[a].parent;
    b = nodes[b].parent;
  }
  return a == b ? a : -1;
}

void readJoints(const JsonPlace& place, const std::vector<Node>& nodes, Skin& skin) {
  const std::vector<JsonPlace> joints = place.items("joints", true);
  if (joints.size() > 65536) place.member("joints").fail("has {} joints, 65536 are possible", joints.size());
  std::vector<bool> seen(nodes.size(), false);
  for (const JsonPlace& reference : joints) {
    const int joint = reference.asIndex(nodes.size(), "node");
    if (seen[joint]) reference.fail("node {} is listed twice", joint);
    seen[joint] = true;
    skin.joints.push_back(joint);
  }
}

void readInverseBind(GltfImport& import, const JsonPlace& place, Skin& skin) {
  skin.inverseBind.assign(skin.joints.size(), glm::mat4(1));
  const int accessor = place.index("inverseBindMatrices", import.accessors.count(), "accessor");
  if (accessor < 0) return;
  const JsonPlace user = place.member("inverseBindMatrices");
  if (import.accessors.elements(accessor) < skin.joints.size()) {
    user.fail("accessor {} has {} matrices for {} joints", accessor, import.accessors.elements(accessor),
              skin.joints.size());
  }
  const std::vector<float> flat = import.accessors.floats(user, accessor, 16, kFloat);
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    glm::mat4 m = glm::make_mat4(flat.data() + 16 * j);
    // Computed inverses carry rounding in the last row; more than that is a perspective, which no joint has.
    const glm::vec4 lastRow(m[0][3], m[1][3], m[2][3], m[3][3] - 1);
    if (glm::dot(lastRow, lastRow) > 1e-8f) user.fail("matrix {} is not affine: its last row must be 0 0 0 1", j);
    for (int c = 0; c < 4; ++c) m[c][3] = c == 3 ? 1.f : 0.f;
    skin.inverseBind[j] = m;
  }
}

void chooseSkeletonRoot(GltfImport& import, const JsonPlace& place, Skin& skin) {
  const std::vector<Node>& nodes = import.scene.nodes;
  int common = skin.joints.front();
  for (const int joint : skin.joints) common = common < 0 ? common : commonAncestor(nodes, common, joint);
  const int named = place.index("skeleton", nodes.size(), "node");
  if (common < 0) {
    for (common = skin.joints.front(); nodes[common].parent >= 0;) common = nodes[common].parent;
    import.note("{}: joints have no common root; the first one's is used", place.path());
  }
  skin.skeletonRoot = common;
  if (named < 0) return;
  if (commonAncestor(nodes, named, common) == named) {
    skin.skeletonRoot = named;
  } else {
    import.note("{}/skeleton: node {} is not above all joints; node {} is used", place.path(), named, common);
  }
}

void checkJointNumbers(const std::vector<JsonPlace>& places, const Scene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.skin < 0) continue;
    const std::size_t joints = scene.skins[node.skin].joints.size();
    for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
      for (std::size_t v = 0; v < primitive.influences.size(); ++v) {
        for (const std::uint16_t joint : primitive.influences[v].joint) {
          if (joint >= joints) {
            places[i].fail("vertex {} of mesh {} follows joint {}, skin {} has {}", v, node.mesh, joint, node.skin,
                           joints);
          }
        }
      }
    }
  }
}

}  // namespace

void importSkins(GltfImport& import) {
  for (const JsonPlace& place : import.document.root().items("skins")) {
    Skin skin;
    skin.name = readName(place);
    readJoints(place, import.scene.nodes, skin);
    readInverseBind(import, place, skin);
    chooseSkeletonRoot(import, place, skin);
    import.scene.skins.push_back(std::move(skin));
  }
  checkJointNumbers(import.document.root().items("nodes"), import.scene);
}

}  // namespace rigel::tools
