#include "report/measure/body_parts.h"

#include <algorithm>
#include <map>
#include <optional>

namespace rigel::tools {
namespace {

/// Looks up the node that moves a point: vertices are laid out mesh node by mesh node, primitive by primitive.
class Movers {
 public:
  Movers(const Scene& scene, const SceneObject& object) : scene_(scene), object_(object) {
    std::uint32_t first = 0;
    for (const int node : object.meshNodes) {
      const int mesh = scene.nodes[static_cast<std::size_t>(node)].mesh;
      for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(mesh)].primitives) {
        runs_.push_back({first, node, &primitive});
        first += static_cast<std::uint32_t>(primitive.positions.size());
      }
    }
  }

  int at(const SurfacePoint& point) const {
    const glm::uvec3& corners = object_.triangles[point.triangle];
    const auto after = std::ranges::upper_bound(runs_, corners[0], {}, &Run::first);
    const Run& run = *std::prev(after);
    const Node& node = scene_.nodes[static_cast<std::size_t>(run.node)];
    if (node.skin < 0 || run.primitive->influences.empty()) return run.node;
    std::map<int, float> weights;
    const float shares[3] = {1 - point.b1 - point.b2, point.b1, point.b2};
    for (int corner = 0; corner < 3; ++corner) {
      const Influences& influences = run.primitive->influences[corners[corner] - run.first];
      for (std::size_t k = 0; k < influences.joint.size(); ++k)
        if (influences.weight[k] > 0) weights[influences.joint[k]] += shares[corner] * influences.weight[k];
    }
    if (weights.empty()) return run.node;
    const auto most = std::ranges::max_element(weights, {}, [](const auto& entry) { return entry.second; });
    return scene_.skins[static_cast<std::size_t>(node.skin)].joints[static_cast<std::size_t>(most->first)];
  }

 private:
  struct Run {
    std::uint32_t first;  // vertex
    int node;
    const Primitive* primitive;
  };
  const Scene& scene_;
  const SceneObject& object_;
  std::vector<Run> runs_;
};

/// Parts as they are merged, by the node that each is named after.
class Merging {
 public:
  Merging(const Scene& scene, std::span<const int> movers) : scene_(scene), below_(scene.nodes.size()) {
    for (const int node : movers) {
      Group& group = at(node);
      group.nodes.assign(1, node);
      ++group.samples;
    }
  }

  void merge() {
    while (const std::optional<int> smallest = smallestLeaf()) {
      if (groups_.size() <= BodyParts::kMost && groups_.at(*smallest).samples >= BodyParts::kLeastSamples) break;
      for (const int node : counterparts(*smallest)) moveUp(node);
      moveUp(*smallest);
    }
  }

  /// Parts in the order of the hierarchy, and the part of each node that has samples.
  std::map<int, int> list(std::vector<BodyParts::Part>& out) const {
    std::map<int, int> partOf, index;
    for (const int node : inOrder()) {
      const Group& group = groups_.at(node);
      int above = parent(node);
      while (above >= 0 && !groups_.contains(above)) above = parent(above);
      index[node] = static_cast<int>(out.size());
      const std::string& name = scene_.nodes[static_cast<std::size_t>(node)].name;
      out.push_back({name.empty() ? "node " + std::to_string(node) : name, above < 0 ? -1 : index.at(above),
                     static_cast<int>(group.nodes.size())});
      for (const int one : group.nodes) partOf[one] = index[node];
    }
    return partOf;
  }

 private:
  struct Group {
    std::vector<int> nodes;
    int samples = 0;
  };

  int parent(int node) const { return scene_.nodes[static_cast<std::size_t>(node)].parent; }
  int& below(int node) { return below_[static_cast<std::size_t>(node)]; }

  Group& at(int node) {
    const auto [entry, added] = groups_.try_emplace(node);
    if (added)
      for (int up = parent(node); up >= 0; up = parent(up)) ++below(up);
    return entry->second;
  }

  void moveUp(int node) {
    const Group moved = std::move(groups_.at(node));
    Group& into = at(junction(node));
    into.samples += moved.samples;
    into.nodes.insert(into.nodes.end(), moved.nodes.begin(), moved.nodes.end());
    groups_.erase(node);
    for (int up = parent(node); up >= 0; up = parent(up)) --below(up);
  }

  int depth(int node) const {
    int steps = 0;
    for (int up = parent(node); up >= 0; up = parent(up)) ++steps;
    return steps;
  }

  /// The other foot, where one goes to its leg: as deep, about as large, on another branch.
  std::vector<int> counterparts(int leaf) {
    constexpr double kAlike = 1.25;
    constexpr std::size_t kFew = 64;  // more are no limbs, and take long to compare
    std::vector<int> out;
    if (groups_.size() > kFew) return out;
    for (const auto& [node, group] : groups_) {
      if (node == leaf || below(node) > 0 || group.samples > kAlike * groups_.at(leaf).samples) continue;
      const int to = junction(node);
      if (to >= 0 && to != junction(leaf) && depth(node) == depth(leaf)) out.push_back(node);
    }
    return out;
  }

  /// Of the groups from which no other hangs and that hang from something, the one with fewest samples.
  std::optional<int> smallestLeaf() {
    std::optional<int> smallest;
    for (const auto& [node, group] : groups_) {
      if (below(node) > 0 || (smallest && group.samples >= groups_.at(*smallest).samples)) continue;
      if (junction(node) >= 0) smallest = node;
    }
    return smallest;
  }

  /// The nearest node above a group that is one itself, or from which another hangs; -1: there is none.
  int junction(int node) {
    for (int up = parent(node); up >= 0; up = parent(up))
      if (groups_.contains(up) || below(up) > 1) return up;
    return -1;
  }

  /// Groups as the scene's nodes come, parents before children.
  std::vector<int> inOrder() const {
    std::vector<int> order, pending;
    for (int node = static_cast<int>(scene_.nodes.size()); node-- > 0;)
      if (parent(node) < 0) pending.push_back(node);
    while (!pending.empty()) {
      const int node = pending.back();
      pending.pop_back();
      if (groups_.contains(node)) order.push_back(node);
      const std::vector<int>& children = scene_.nodes[static_cast<std::size_t>(node)].children;
      pending.insert(pending.end(), children.rbegin(), children.rend());
    }
    return order;
  }

  const Scene& scene_;
  std::map<int, Group> groups_;
  std::vector<int> below_;  // per node: groups that hang from it
};

}  // namespace

BodyParts findBodyParts(const Scene& scene, const SceneObject& object, std::span<const SurfacePoint> samples) {
  const Movers movers(scene, object);
  std::vector<int> nodes;
  for (const SurfacePoint& sample : samples) nodes.push_back(movers.at(sample));
  Merging merging(scene, nodes);
  merging.merge();
  BodyParts out;
  const std::map<int, int> partOf = merging.list(out.parts);
  for (const int node : nodes) out.ofSample.push_back(partOf.at(node));
  return out;
}

}  // namespace rigel::tools
