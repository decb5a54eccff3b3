// What LightTree is made of.
#pragma once

#include <rigel/light_tree.h>

#include "light_modulation.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rigel {

/// One light as the tree sees it. P, its power: irradiance at normal incidence at one metre, root mean square of the
/// colours.
struct TreeLight {
  float x = 0, y = 0, z = 0;
  float reach = 0;   // [m] of what it emits from; twice the radius of a sphere, so that none is closer than that
  float power = 0;   // 0: no light
  float mean = 0;    // of the colours
  float radius = 0;  // of spheres and points; of disks 0
  std::uint32_t light = 0;
};

/// A cluster as a query sees it: half a cache line, siblings in one.
struct TreeNode {
  float x = 0, y = 0, z = 0;
  float reach = 0;    // largest distance of a light, reach included
  float spread = 0;   // sqrt(S/P)
  float lopside = 0;  // D/P
  float power = 0;
  float mean = 0;
};

/// What the parent's moments follow from.
struct NodeMoments {
  // Per P. Of the three colours and of P, about the node's own centre, which is rounded to float.
  std::array<Vec3, 4> first{};
  float second = 0;         // S/P
  float squaredRadius = 0;  // of spheres and points, mean
  Rgb colour;
  Vec3 lo{}, hi{};  // box of the lights
};

/// By what a light is dimmed. Each has trees of its own: in a cluster of lamps with a range and spots without, neither
/// is ever known to be dark.
enum class Dimming : std::uint8_t { none, range, cone, coneAndRange, face, twoFaces };

/// Lights of one dimming and one group mask. Node i has the children 2i and 2i + 1, the root is 1; of
/// 2^depth leaves, the first is node 2^depth, and leaf j holds the lights from (j count) >> depth on.
struct Tree {
  std::uint32_t groups = 0;
  Dimming dimming = Dimming::none;
  int depth = 0;
  std::size_t firstNode = 0;  // of the unused node 0
  std::size_t firstLight = 0, count = 0;

  bool dimmed() const noexcept { return dimming != Dimming::none; }
  std::size_t leaves() const noexcept { return std::size_t{1} << depth; }
  std::size_t nodes() const noexcept { return 2 * leaves(); }
  std::size_t leafStart(std::size_t leaf) const noexcept { return firstLight + ((leaf * count) >> depth); }
};

/// What a light is sorted by.
struct TreeItem {
  float x = 0, y = 0, z = 0;
  std::uint32_t light = 0;
};

/// A light that is always by itself.
struct LoneLight {
  std::uint32_t light = 0;
  std::uint32_t groups = 0;
  float mean = 0;  // of a directional light's colours
  bool directional = false;
  bool shines = false;
};

struct detail::LightTreeState {
  std::vector<Tree> trees;  // the dimmed ones last
  std::vector<TreeLight> lights;
  std::vector<TreeNode> nodes;
  std::vector<NodeMoments> moments;
  std::vector<SphereLight> clusters;
  std::vector<LoneLight> lone;
  // Of dimmed lights and of the nodes of their trees, counted from these.
  std::size_t firstDimmedLight = 0, firstDimmedNode = 0;
  std::vector<LightModulation> lightModulation, nodeModulation;

  std::array<int, 5> counts{};        // of the last build, per kind; kNotBuilt where memory has ended in it
  std::vector<std::uint32_t> slotOf;  // of each light, in `lights`; or in `lone`, with the highest bit set
  double size = 0, builtSize = 0;     // sum of the nodes' spreads
  std::uint64_t version = 0;

  // Scratch of builds and refits.
  struct Key {
    Dimming dimming = Dimming::none;
    std::uint32_t groups = 0;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  std::vector<Key> keys;
  std::vector<Key> keyOf;  // of each light that is not lone
  std::vector<TreeItem> unsorted, sorted;
  std::vector<std::size_t> begins;
  struct Due {
    std::uint32_t tree, node;
  };
  std::vector<Due> due;
  std::vector<std::uint8_t> marked;  // per node, whether it is due

  static constexpr std::uint32_t kLone = 0x80000000u;
  static constexpr int kNotBuilt = -1;
};

/// What the tree wants to know of a light.
struct LightSource {
  TreeLight light;
  Rgb colour;        // per channel, what P is of
  float second = 0;  // of its own extent, per power
  LightModulation modulation;
  Dimming dimming = Dimming::none;
  bool lone = false;
  bool directional = false;
  bool shines = false;  // of lone lights
};
LightSource lightSource(const LightSet& lights, std::uint32_t index) noexcept;

/// Orders the tree's items so that each of its nodes is compact: medians along the longest axis.
void orderForTree(TreeItem* items, const Tree& tree) noexcept;

/// Computes a node from its lights or children, and its cluster.
void gatherNode(detail::LightTreeState& state, const LightSet& lights, const Tree& tree, std::size_t node) noexcept;

}  // namespace rigel
