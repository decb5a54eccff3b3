// Skins: joints, inverse bind matrices, the skeleton root; every joint number of a skinned vertex exists.
#include "scene/gltf_import.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace rigel::tools {
namespace {

// A skin may take a walk through all nodes. Crowds have thousands of skins of a hundred joints.
constexpr std::size_t kMaxSkinsTimesNodes = std::size_t{1} << 30;

// Steps from each node up to its root. Skeletons may be chains of thousands: a walk per joint would never end.
std::vector<int> nodeDepths(const std::vector<Node>& nodes) {
  std::vector<int> depths(nodes.size(), -1);
  std::vector<int> pending;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].parent < 0) pending.push_back(static_cast<int>(i));
  while (!pending.empty()) {
    const int node = pending.back();
    pending.pop_back();
    depths[node] = nodes[node].parent < 0 ? 0 : depths[nodes[node].parent] + 1;
    pending.insert(pending.end(), nodes[node].children.begin(), nodes[node].children.end());
  }
  return depths;
}

// The lowest node at or above all of `joints`; -1 when they are in different trees. Visits each node once.
int commonAncestor(const std::vector<Node>& nodes, const std::vector<int>& depths, const std::vector<int>& joints) {
  std::vector<bool> below(nodes.size(), false);  // known to lie at or below `common`
  int common = joints.front();
  below[common] = true;
  for (int joint : joints) {
    for (; !below[joint] && depths[joint] > depths[common]; joint = nodes[joint].parent) below[joint] = true;
    if (below[joint]) continue;
    while (common != joint) {
      if (depths[common] == depths[joint]) {
        below[joint] = true;
        joint = nodes[joint].parent;
      }
      common = nodes[common].parent;
      if (common < 0) return -1;
      below[common] = true;
    }
  }
  return common;
}

bool isAtOrAbove(const std::vector<Node>& nodes, const std::vector<int>& depths, int upper, int node) {
  while (depths[node] > depths[upper]) node = nodes[node].parent;
  return node == upper;
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

void chooseSkeletonRoot(GltfImport& import, const JsonPlace& place, const std::vector<int>& depths, Skin& skin) {
  const std::vector<Node>& nodes = import.scene.nodes;
  const int named = place.index("skeleton", nodes.size(), "node");
  int common = commonAncestor(nodes, depths, skin.joints);
  const bool found = common >= 0;
  if (!found) {
    for (common = skin.joints.front(); nodes[common].parent >= 0;) common = nodes[common].parent;
    import.note("{}: joints have no common root; the first one's is used", place.path());
  }
  skin.skeletonRoot = common;
  if (named < 0) return;
  if (found && isAtOrAbove(nodes, depths, named, common)) {
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
  const std::vector<JsonPlace> places = import.document.root().items("skins");
  if (places.size() > kMaxSkinsTimesNodes / std::max<std::size_t>(import.scene.nodes.size(), 1))
    import.document.root().member("skins").fail("{} skins of {} nodes are absurd", places.size(),
                                                import.scene.nodes.size());
  const std::vector<int> depths = nodeDepths(import.scene.nodes);
  for (const JsonPlace& place : places) {
    Skin skin;
    skin.name = readName(place);
    readJoints(place, import.scene.nodes, skin);
    readInverseBind(import, place, skin);
    chooseSkeletonRoot(import, place, depths, skin);
    import.scene.skins.push_back(std::move(skin));
  }
  checkJointNumbers(import.document.root().items("nodes"), import.scene);
}

}  // namespace rigel::tools
