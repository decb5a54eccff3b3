// Moments of the lights below a node. With x_i, P_i the lights, C the node's centre rounded to float and c one colour
// (or P, for what centres must not leave):
//
//   first_c = sum c_i (x_i - C) / P,   S/P = sum P_i (|x_i - C|^2 + own_i) / P
//
// Both move from the centres of children to their parent's by the parallel axes theorem; sums are in double.
#include "light_tree_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

using Double3 = std::array<double, 3>;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

Double3 widened(Vec3 v) noexcept { return {v.x, v.y, v.z}; }

/// A light, or a child.
struct Part {
  Vec3 centre;
  float reach;
  float power, mean;
  NodeMoments moments;
};

class Sum {
 public:
  void gather(const Part& part) noexcept {
    if (!(part.power > 0)) return;
    power_ += part.power;
    const Double3 c = widened(part.centre);
    for (int a = 0; a < 3; ++a) {
      centre_[a] += part.power * c[a];
      lo_[a] = std::min(lo_[a], part.moments.lo[a]);
      hi_[a] = std::max(hi_[a], part.moments.hi[a]);
    }
    mean_ += part.mean;
    for (int k = 0; k < 3; ++k) colour_[k] += part.moments.colour[k];
  }

  /// The centre, once all parts are gathered.
  Vec3 centre() const noexcept {
    if (!(power_ > 0)) return {};
    return {static_cast<float>(centre_[0] / power_), static_cast<float>(centre_[1] / power_),
            static_cast<float>(centre_[2] / power_)};
  }

  /// Each part again, about the centre.
  void move(const Part& part, Vec3 centre) noexcept {
    if (!(part.power > 0)) return;
    const Double3 from = widened(part.centre), to = widened(centre);
    double square = 0, cross = 0;
    for (int a = 0; a < 3; ++a) {
      const double offset = from[a] - to[a];
      square += offset * offset;
      cross += offset * part.power * part.moments.first[3][a];
      for (int k = 0; k < 3; ++k)
        first_[k][a] += part.power * part.moments.first[k][a] + part.moments.colour[k] * offset;
      first_[3][a] += part.power * (part.moments.first[3][a] + offset);
    }
    second_ += part.power * (part.moments.second + square) + 2 * cross;
    squaredRadius_ += double{part.power} * part.moments.squaredRadius;
    reach_ = std::max(reach_, std::sqrt(square) + part.reach);
  }

  void store(Vec3 centre, TreeNode& node, NodeMoments& moments) const noexcept {
    node = {};
    moments = {};
    node.x = centre.x;
    node.y = centre.y;
    node.z = centre.z;
    if (!(power_ > 0)) return;
    node.power = static_cast<float>(power_);
    node.mean = static_cast<float>(mean_);
    double corner = 0, colours = 0, whole = 0;
    for (int a = 0; a < 3; ++a) {
      moments.lo[a] = lo_[a];
      moments.hi[a] = hi_[a];
      const double farthest = std::max(std::abs(lo_[a] - double{centre[a]}), std::abs(hi_[a] - double{centre[a]}));
      corner += farthest * farthest;
      whole += first_[3][a] * first_[3][a];
      for (int k = 0; k < 3; ++k) colours += first_[k][a] * first_[k][a] / 3;
    }
    for (int k = 0; k < 4; ++k) {
      for (int a = 0; a < 3; ++a) moments.first[k][a] = static_cast<float>(first_[k][a] / power_);
    }
    for (int k = 0; k < 3; ++k) moments.colour[k] = static_cast<float>(colour_[k]);
    moments.second = static_cast<float>(std::max(0.0, second_) / power_);
    moments.squaredRadius = static_cast<float>(squaredRadius_ / power_);
    // What float left of the sums goes up.
    constexpr double kUp = 1 + 1e-6;
    node.reach = static_cast<float>(std::min(reach_, std::sqrt(corner)) * kUp);
    node.spread = static_cast<float>(std::sqrt(double{moments.second}) * kUp);
    node.lopside = static_cast<float>(std::sqrt(std::max(colours, whole)) / power_ * kUp);
  }

 private:
  double power_ = 0, mean_ = 0, second_ = 0, squaredRadius_ = 0, reach_ = 0;
  Double3 centre_{}, colour_{};
  std::array<Double3, 4> first_{};
  Vec3 lo_{kInfinite, kInfinite, kInfinite}, hi_{-kInfinite, -kInfinite, -kInfinite};
};

Part partOf(const LightSource& source) noexcept {
  const TreeLight& l = source.light;
  Part part{{l.x, l.y, l.z}, l.reach, l.power, l.mean, {}};
  part.moments.colour = source.colour;
  part.moments.second = source.second;
  part.moments.squaredRadius = l.radius * l.radius;
  part.moments.lo = part.centre - Vec3{l.reach, l.reach, l.reach};
  part.moments.hi = part.centre + Vec3{l.reach, l.reach, l.reach};
  return part;
}

Part partOf(const TreeNode& node, const NodeMoments& moments) noexcept {
  return {{node.x, node.y, node.z}, node.reach, node.power, node.mean, moments};
}

/// The mean square of the radii leaves less than each of them alone (light_tree_source.cpp). Disks have none, and get
/// one that is small against their own.
SphereLight clusterOf(const TreeNode& node, const NodeMoments& moments) noexcept {
  if (!(node.power > 0)) return {};
  constexpr float kPiF = 3.14159265f;
  const float radius = std::max({std::sqrt(moments.squaredRadius), 1e-3f * node.spread, kMinPointRadius});
  return {{node.x, node.y, node.z}, radius, moments.colour * (1 / (kPiF * radius * radius))};
}

}  // namespace

void gatherNode(detail::LightTreeState& state, const LightSet& lights, const Tree& tree, std::size_t node) noexcept {
  // At most four lights a leaf (LightTree::build).
  std::array<Part, 4> parts;
  std::size_t count = 0;
  LightModulation modulation;
  if (node >= tree.leaves()) {
    const std::size_t end = tree.leafStart(node - tree.leaves() + 1);
    for (std::size_t slot = tree.leafStart(node - tree.leaves()); slot < end; ++slot) {
      const LightSource source = lightSource(lights, state.lights[slot].light);
      parts[count++] = partOf(source);
      state.lights[slot] = source.light;
      if (!tree.dimmed()) continue;
      state.lightModulation[slot - state.firstDimmedLight] = source.modulation;
      modulation = merged(modulation, source.modulation);
    }
  } else {
    for (std::size_t child = 2 * node; child < 2 * node + 2; ++child) {
      const std::size_t at = tree.firstNode + child;
      parts[count++] = partOf(state.nodes[at], state.moments[at]);
      if (tree.dimmed()) modulation = merged(modulation, state.nodeModulation[at - state.firstDimmedNode]);
    }
  }
  Sum sum;
  for (std::size_t i = 0; i < count; ++i) sum.gather(parts[i]);
  const Vec3 centre = sum.centre();
  for (std::size_t i = 0; i < count; ++i) sum.move(parts[i], centre);

  const std::size_t at = tree.firstNode + node;
  state.size -= state.nodes[at].spread;
  sum.store(centre, state.nodes[at], state.moments[at]);
  state.size += state.nodes[at].spread;
  state.clusters[at] = clusterOf(state.nodes[at], state.moments[at]);
  if (tree.dimmed()) state.nodeModulation[at - state.firstDimmedNode] = modulation;
}

}  // namespace rigel
