// Nodes: the hierarchy is a forest, every reference exists, transforms are finite.
#include "scene/gltf_import.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

void readTransform(const JsonPlace& place, Node& node) {
  float m[16];
  if (place.numbers("matrix", 16, m)) {
    for (const char* other : {"translation", "rotation", "scale"}) {
      if (place.has(other)) place.fail("has both matrix and {}", other);
    }
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      place.member("matrix").fail("is not affine: its last row must be 0 0 0 1");
    }
    node.hasMatrix = true;
    node.matrix = glm::make_mat4(m);
    return;
  }
  place.numbers("translation", 3, &node.translation.x);
  place.numbers("scale", 3, &node.scale.x);
  float q[4] = {0, 0, 0, 1};
  if (place.numbers("rotation", 4, q)) {
    const double norm = std::hypot(std::hypot(double(q[0]), double(q[1])), std::hypot(double(q[2]), double(q[3])));
    // Exporters round to few digits; what is off by more is no rotation.
    if (std::abs(norm - 1) > 0.01) place.member("rotation").fail("is no unit quaternion: its length is {:.4g}", norm);
  }
  node.rotation = glm::quat(q[3], q[0], q[1], q[2]);
}

void readLight(GltfImport& import, const JsonPlace& place, Node& node) {
  const auto extensions = place.find("extensions");
  if (!extensions) return;
  if (const auto punctual = extensions->find("KHR_lights_punctual")) {
    node.light = import.punctualLight[punctual->requiredIndex("light", import.punctualLight.size(), "light")];
  }
  if (const auto area = extensions->find("EXT_lights_area")) {
    const int light = import.areaLight[area->requiredIndex("light", import.areaLight.size(), "light")];
    if (light < 0) return;
    if (node.light >= 0) place.fail("has a punctual and an area light: a node may carry one");
    node.light = light;
  }
}

void readReferences(GltfImport& import, const JsonPlace& place, Node& node) {
  const JsonPlace root = import.document.root();
  node.mesh = place.index("mesh", import.scene.meshes.size(), "mesh");
  node.skin = place.index("skin", root.items("skins").size(), "skin");
  if (node.skin >= 0 && node.mesh < 0) place.fail("has a skin but no mesh");
  if (node.skin >= 0) {
    const Mesh& mesh = import.scene.meshes[node.mesh];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      if (mesh.primitives[p].influences.empty()) {
        place.fail("has a skin, but primitive {} of mesh {} has no JOINTS_0 and WEIGHTS_0", p, node.mesh);
      }
    }
  }
  if (place.has("weights")) {
    const std::size_t targets = node.mesh >= 0 ? import.scene.meshes[node.mesh].morphWeights.size() : 0;
    if (targets == 0) place.member("weights").fail("there are no morph targets for them");
    node.morphWeights.resize(targets);
    place.numbers("weights", targets, node.morphWeights.data());
  }
  readLight(import, place, node);
}

void readExtras(const JsonPlace& place, Node& node) {
  const auto extras = place.find("extras");
  if (!extras || !extras->value().is_object()) return;
  const auto ours = extras->find("rigel");
  if (!ours || !ours->value().is_object()) return;
  node.isStatic = ours->flag("static");
  node.isObject = ours->flag("object");
}

void linkChildren(const std::vector<JsonPlace>& places, std::vector<Node>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const JsonPlace& reference : places[i].items("children")) {
      const int child = reference.asIndex(nodes.size(), "node");
      if (nodes[child].parent >= 0) {
        reference.fail("node {} already has the parent {}", child, nodes[child].parent);
      }
      nodes[child].parent = static_cast<int>(i);
      nodes[i].children.push_back(child);
    }
  }
}

std::string describeLoop(const std::vector<Node>& nodes, int start) {
  constexpr int kShown = 8;
  std::string text = std::to_string(start);
  int at = nodes[start].parent;
  for (int shown = 1; at != start && shown < kShown; ++shown, at = nodes[at].parent) text += " < " + std::to_string(at);
  return text + (at == start ? " < " : " < ... < ") + std::to_string(start) + " (child < parent)";
}

// Every node has at most one parent by now, so a loop is a chain of parents that comes back to its start.
void refuseLoops(const std::vector<JsonPlace>& places, const std::vector<Node>& nodes) {
  std::vector<bool> done(nodes.size(), false);
  std::vector<std::size_t> visit(nodes.size(), 0);  // number of the walk that came here
  for (std::size_t start = 0; start < nodes.size(); ++start) {
    int at = static_cast<int>(start);
    for (; at >= 0 && !done[at]; at = nodes[at].parent) {
      if (visit[at] == start + 1) places[at].fail("node loop: {}", describeLoop(nodes, at));
      visit[at] = start + 1;
    }
    for (at = static_cast<int>(start); at >= 0 && !done[at]; at = nodes[at].parent) done[at] = true;
  }
}

// The scene to show: `scene`, else the first, else all nodes without a parent.
void chooseRoots(GltfImport& import) {
  const JsonPlace root = import.document.root();
  Scene& scene = import.scene;
  const auto scenes = root.items("scenes");
  const int chosen = std::max(root.index("scene", scenes.size(), "scene"), 0);
  for (const JsonPlace& place : scenes) {
    std::vector<bool> seen(scene.nodes.size(), false);
    for (const JsonPlace& reference : place.items("nodes")) {
      const int node = reference.asIndex(scene.nodes.size(), "node");
      if (scene.nodes[node].parent >= 0)
        reference.fail("node {} is a child of node {}", node, scene.nodes[node].parent);
      if (seen[node]) reference.fail("node {} is listed twice", node);
      seen[node] = true;
    }
  }
  if (scenes.empty()) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      if (scene.nodes[i].parent < 0) scene.roots.push_back(static_cast<int>(i));
    }
    return;
  }
  for (const JsonPlace& reference : scenes[chosen].items("nodes")) {
    scene.roots.push_back(reference.asIndex(scene.nodes.size(), "node"));
  }
  if (scenes.size() > 1)
    import.note("{} of {} scenes ignored: scene {} is used", scenes.size() - 1, scenes.size(), chosen);
}

}  // namespace

void importNodes(GltfImport& import) {
  const std::vector<JsonPlace> places = import.document.root().items("nodes");
  for (const JsonPlace& place : places) {
    Node node;
    node.name = readName(place);
    readTransform(place, node);
    readReferences(import, place, node);
    readExtras(place, node);
    import.scene.nodes.push_back(std::move(node));
  }
  linkChildren(places, import.scene.nodes);
  refuseLoops(places, import.scene.nodes);
  chooseRoots(import);
}

}  // namespace rigel::tools
