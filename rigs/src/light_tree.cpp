#include "light_tree_state.h"

#include <algorithm>
#include <atomic>

namespace rigel {
namespace {

using State = detail::LightTreeState;

std::array<int, 5> countsOf(const LightSet& lights) noexcept {
  return {lights.directionalCount(), lights.pointCount(), lights.spotCount(), lights.sphereCount(), lights.diskCount()};
}

/// Two to four lights a leaf.
int depthFor(std::size_t count) noexcept {
  int depth = 0;
  while (count > (std::size_t{4} << depth)) ++depth;
  return depth;
}

LoneLight loneLight(const LightSource& source, std::uint32_t groups) noexcept {
  return {source.light.light, groups, source.light.mean, source.directional, source.shines};
}

/// Lone lights go to their list, the others to `unsorted` with their keys.
void listLights(State& s, const LightSet& lights) {
  const auto count = static_cast<std::uint32_t>(lights.size());
  s.slotOf.resize(count);
  s.lone.clear();
  s.unsorted.clear();
  s.keyOf.clear();
  s.keys.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const LightSource source = lightSource(lights, i);
    const std::uint32_t groups = lights.groups(static_cast<int>(i));
    if (source.lone) {
      s.slotOf[i] = static_cast<std::uint32_t>(s.lone.size()) | State::kLone;
      s.lone.push_back(loneLight(source, groups));
      continue;
    }
    s.unsorted.push_back({source.light.x, source.light.y, source.light.z, i});
    s.keyOf.push_back({source.dimming, groups});
    if (s.keys.empty() || !(s.keys.back() == s.keyOf.back())) s.keys.push_back(s.keyOf.back());
  }
  std::sort(s.keys.begin(), s.keys.end());
  s.keys.erase(std::unique(s.keys.begin(), s.keys.end()), s.keys.end());
}

/// By key, in the order of the lights: a counting sort.
void sortByKey(State& s) {
  const auto indexOf = [&](const State::Key& key) {
    return static_cast<std::size_t>(std::lower_bound(s.keys.begin(), s.keys.end(), key) - s.keys.begin());
  };
  s.begins.assign(s.keys.size() + 1, 0);
  for (const State::Key& key : s.keyOf) ++s.begins[indexOf(key) + 1];
  for (std::size_t k = 1; k < s.begins.size(); ++k) s.begins[k] += s.begins[k - 1];
  s.sorted.resize(s.unsorted.size());
  for (std::size_t i = 0; i < s.unsorted.size(); ++i) s.sorted[s.begins[indexOf(s.keyOf[i])]++] = s.unsorted[i];
  // Each begin has moved to the next.
  std::rotate(s.begins.begin(), s.begins.end() - 1, s.begins.end());
  s.begins.front() = 0;
}

void makeTrees(State& s) {
  s.trees.clear();
  s.firstDimmedLight = s.sorted.size();
  std::size_t nodes = 0;
  bool dimmed = false;
  for (std::size_t k = 0; k < s.keys.size(); ++k) {
    const std::size_t first = s.begins[k];
    const std::size_t end = k + 1 < s.keys.size() ? s.begins[k + 1] : s.sorted.size();
    if (s.keys[k].dimming != Dimming::none && !dimmed) {
      dimmed = true;
      s.firstDimmedLight = first;
      s.firstDimmedNode = nodes;
    }
    s.trees.push_back({s.keys[k].groups, s.keys[k].dimming, depthFor(end - first), nodes, first, end - first});
    nodes += s.trees.back().nodes();
  }
  if (!dimmed) s.firstDimmedNode = nodes;
  s.nodes.assign(nodes, {});
  s.moments.resize(nodes);
  s.clusters.assign(nodes, {});
  s.marked.assign(nodes, 0);
  s.lights.resize(s.sorted.size());
  s.nodeModulation.resize(nodes - s.firstDimmedNode);
  s.lightModulation.resize(s.sorted.size() - s.firstDimmedLight);
}

void gatherAll(State& s, const LightSet& lights) noexcept {
  for (const Tree& tree : s.trees) {
    for (std::size_t node = tree.nodes() - 1; node >= 1; --node) gatherNode(s, lights, tree, node);
  }
}

std::size_t treeOfSlot(const State& s, std::uint32_t slot) noexcept {
  const auto after = std::upper_bound(s.trees.begin(), s.trees.end(), slot,
                                      [](std::size_t at, const Tree& tree) { return at < tree.firstLight; });
  return static_cast<std::size_t>(after - s.trees.begin()) - 1;
}

/// Whether the light is still where the last build has put it.
bool keepsPlace(const State& s, const LightSet& lights, std::uint32_t light) noexcept {
  if (light >= s.slotOf.size()) return false;
  const std::uint32_t slot = s.slotOf[light];
  const LightSource source = lightSource(lights, light);
  if (source.lone != ((slot & State::kLone) != 0)) return false;
  if (source.lone) return true;
  const Tree& tree = s.trees[treeOfSlot(s, slot)];
  return source.dimming == tree.dimming && lights.groups(static_cast<int>(light)) == tree.groups;
}

void refitLone(State& s, const LightSet& lights, std::uint32_t light) noexcept {
  const std::uint32_t slot = s.slotOf[light] & ~State::kLone;
  s.lone[slot] = loneLight(lightSource(lights, light), lights.groups(static_cast<int>(light)));
}

void makeDue(State& s, std::uint32_t tree, std::size_t node) noexcept {
  std::uint8_t& mark = s.marked[s.trees[tree].firstNode + node];
  if (mark) return;
  mark = 1;
  s.due.push_back({tree, static_cast<std::uint32_t>(node)});
}

std::uint64_t newVersion() noexcept {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

/// Every due node, its parents later than itself.
void gatherDue(State& s, const LightSet& lights) noexcept {
  for (std::size_t i = 0; i < s.due.size(); ++i) {
    const auto [tree, node] = s.due[i];
    gatherNode(s, lights, s.trees[tree], node);
    s.marked[s.trees[tree].firstNode + node] = 0;
    if (node > 1) makeDue(s, tree, node / 2);
  }
}

}  // namespace

LightTree::LightTree() : state_(std::make_unique<State>()) {}
LightTree::LightTree(LightTree&&) noexcept = default;
LightTree& LightTree::operator=(LightTree&&) noexcept = default;
LightTree::~LightTree() = default;

void LightTree::build(const LightSet& lights) {
  State& s = *state_;
  s.counts.fill(State::kNotBuilt);
  listLights(s, lights);
  sortByKey(s);
  makeTrees(s);
  for (const Tree& tree : s.trees) orderForTree(s.sorted.data() + tree.firstLight, tree);
  for (std::size_t slot = 0; slot < s.sorted.size(); ++slot) {
    s.lights[slot].light = s.sorted[slot].light;
    s.slotOf[s.sorted[slot].light] = static_cast<std::uint32_t>(slot);
  }
  s.due.reserve(s.nodes.size());
  s.size = 0;
  gatherAll(s, lights);
  s.builtSize = s.size;
  s.counts = countsOf(lights);
  s.version = newVersion();
}

bool LightTree::refit(const LightSet& lights) {
  State& s = *state_;
  if (countsOf(lights) != s.counts) return false;
  const auto count = static_cast<std::uint32_t>(lights.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!keepsPlace(s, lights, i)) return false;
  }
  for (const LoneLight& lone : s.lone) refitLone(s, lights, lone.light);
  gatherAll(s, lights);
  s.version = newVersion();
  return true;
}

bool LightTree::refit(const LightSet& lights, std::span<const std::uint32_t> moved) {
  State& s = *state_;
  if (countsOf(lights) != s.counts) return false;
  for (const std::uint32_t light : moved) {
    if (!keepsPlace(s, lights, light)) return false;
  }
  s.due.clear();
  for (const std::uint32_t light : moved) {
    const std::uint32_t slot = s.slotOf[light];
    if (slot & State::kLone) {
      refitLone(s, lights, light);
      continue;
    }
    const std::size_t at = treeOfSlot(s, slot);
    const Tree& tree = s.trees[at];
    // The last leaf that begins at or before the slot.
    const std::size_t leaf = ((slot - tree.firstLight + 1) * tree.leaves() - 1) / tree.count;
    makeDue(s, static_cast<std::uint32_t>(at), tree.leaves() + leaf);
  }
  gatherDue(s, lights);
  s.version = newVersion();
  return true;
}

void LightTree::update(const LightSet& lights) {
  if (!refit(lights) || !(growth() < kWorthBuilding)) build(lights);
}

float LightTree::growth() const noexcept {
  const State& s = *state_;
  return s.builtSize > 0 ? static_cast<float>(s.size / s.builtSize) : s.size > 0 ? kNoRange : 1.0f;
}

std::uint64_t LightTree::version() const noexcept { return state_->version; }

LightTree::Groups LightTree::groups() const noexcept {
  Groups groups;
  const auto add = [&](std::uint32_t mask) {
    groups.any |= mask;
    groups.all &= mask;
  };
  for (const Tree& tree : state_->trees) add(tree.groups);
  for (const LoneLight& light : state_->lone) add(light.groups);
  return groups;
}

std::span<const SphereLight> LightTree::clusters() const noexcept { return state_->clusters; }

}  // namespace rigel
