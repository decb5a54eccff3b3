// The two passes of a query. With u = P/d^2, d the least distance from the ball to a cluster's centre, a cluster may
// err by tau u, and so all of them by tau U at most, U = sum u over the clusters taken. The first pass finds U and the
// reference from large clusters, the second takes those that keep to tau = target reference / U.
//
// U of the first pass holds for the second, which takes smaller clusters: children's sum of u is at most u (1 + eps),
// eps = (S/P) G/d^2 + 2 (D/P)/d, because 1/d^2 has a second derivative of at most 6/d^4. Where a cluster gives way to
// its children, over a band of distances, both are there in part, and all of this holds for the parts.
//
// Taken is what has d >= k spread + x lopside + reach with k^2 = 3 N/tau, x = 2 N/tau: then
// N (2 lopside/d + spread^2 G/d^2) <= tau, since d - x lopside >= k spread + reach and
// (s + a) (d - a)^2 >= s^2 (d - 2a/3) for d - a >= s. No root and no division for a node that is opened.
#include <rigel/wrap.h>

#include "light_tree_state.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rigel {
namespace {

using detail::LightTreeState;

// Of the target: what clusters may err by; slopes have the rest.
constexpr float kClusterShare = 0.75f;
// The first pass takes clusters from this many spreads (and one reach) on.
constexpr float kCoarse = 3;
// A cluster gives way to its children over this share of its distance.
constexpr float kBand = 0.08f;
// What is dimmed to less than this counts as much less in U.
constexpr float kDark = 0.02f;
// Slopes are enough from this many radii on, and comfortably so at this share more.
constexpr float kSlopeReach = 3;
constexpr float kSlopeBand = 0.25f;
// What errors and their shares are good to in float, the rounding of moments included.
constexpr float kFloatSlack = 1 + 2e-5f;

float smoothstep(float t) noexcept {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// G; for t < 1.
float growthOf(float t) noexcept { return (3 - 2 * t) / ((1 - t) * (1 - t)); }

/// What a light of power 1 gives at distance 1, over the normals.
struct Field {
  float rms, peak, mean;
};

Field fieldOf(float wrap) noexcept {
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  const double e0 = 0.25 * f[0], e1 = 0.75 * f[1], e2 = 1.25 * f[2];
  return {static_cast<float>(std::sqrt(e0 * e0 + e1 * e1 / 3 + e2 * e2 / 5)), static_cast<float>(e0 + e1 + e2),
          static_cast<float>(e0)};
}

/// Mean irradiance over the normals of a light with distance d and radius r, per that of a point at distance 1.
float meanOf(float d, float r) noexcept {
  if (d >= r) return 2 / (1 + std::sqrt((d - r) * (d + r)) / d) / (d * d);
  return 2 * (1 + std::sqrt((r - d) * (r + d)) / r) / (r * r);
}

class Query {
 public:
  Query(const LightTreeState& state, const LightQuery& query, LightSelection& out) noexcept
      : s_(state), q_(query), out_(out), field_(fieldOf(query.wrap)), b_(std::max(0.0f, query.radius)) {}

  void run() {
    addLone();
    forEachTree([&](const Tree& tree, auto dimmed) { measure<dimmed.value>(tree); });
    out_.mean = static_cast<float>(mean_);
    out_.reference = q_.reference > 0 ? q_.reference : out_.mean;
    const double budget = static_cast<double>(std::max(0.0f, q_.target)) * out_.reference;
    constexpr double kLargest = 0.05;  // keeps kCoarse the coarser one, and expansions where they converge
    tau_ = budget > 0 ? static_cast<float>(std::min(kLargest, kClusterShare * budget / std::max(clusters_, 1e-30))) : 0;
    slopeTau_ =
        budget > 0 ? static_cast<float>(std::min(kLargest, (1 - kClusterShare) * budget / std::max(all_, 1e-30))) : 0;
    k_ = std::max(kCoarse, std::sqrt(3 * field_.rms / tau_));
    x_ = 2 * field_.rms / tau_;
    forEachTree([&](const Tree& tree, auto dimmed) { take<dimmed.value>(tree); });
    const double bound = bound_ * kFloatSlack;
    out_.bound = static_cast<float>(bound);
    out_.worst = static_cast<float>(bound * (field_.peak / field_.rms));
  }

 private:
  template <bool Value>
  using Flag = std::bool_constant<Value>;

  struct Entry {
    std::size_t node;
    float weight;
    float dark;  // least of the ancestors' shares of u
  };

  /// A cluster from the ball.
  struct View {
    Vec3 between;
    float distance;  // between the centres
    float least;     // from the ball; 0 where the centre is within
  };

  template <class F>
  void forEachTree(F&& f) {
    for (const Tree& tree : s_.trees) {
      if ((tree.groups & q_.groups) == 0) continue;
      if (tree.dimmed())
        f(tree, Flag<true>{});
      else
        f(tree, Flag<false>{});
    }
  }

  template <class Place>
  View view(const Place& place) const noexcept {
    const Vec3 between{q_.centre.x - place.x, q_.centre.y - place.y, q_.centre.z - place.z};
    const float distance = length(between);
    return {between, distance, std::max(0.0f, distance - b_)};
  }

  void addLone() {
    for (const LoneLight& light : s_.lone) {
      if ((light.groups & q_.groups) == 0) continue;
      ++out_.visited;
      if (!light.shines) continue;
      const bool distant = light.directional && q_.slopes;
      (distant ? out_.distant : out_.near).push_back({light.light, 1});
      mean_ += static_cast<double>(field_.mean) * light.mean;
    }
  }

  /// Walks the tree: `cluster(node index, node, entry)` returns how much of a cluster stays closed, `light(slot,
  /// entry)` gets the lights of opened leaves.
  template <class Cluster, class Light>
  void walk(const Tree& tree, Cluster&& cluster, Light&& light) {
    Entry stack[64];
    int count = 0;
    stack[count++] = {1, 1, 1};
    while (count > 0) {
      Entry entry = stack[--count];
      const std::size_t at = tree.firstNode + entry.node;
      ++out_.visited;
      if (!(s_.nodes[at].power > 0)) continue;
      const float closed = cluster(at, s_.nodes[at], entry);
      if (!(closed < 1)) continue;
      entry.weight *= 1 - closed;
      if (entry.node < tree.leaves()) {
        stack[count++] = {2 * entry.node, entry.weight, entry.dark};
        stack[count++] = {2 * entry.node + 1, entry.weight, entry.dark};
        continue;
      }
      const std::size_t end = tree.leafStart(entry.node - tree.leaves() + 1);
      for (std::size_t slot = tree.leafStart(entry.node - tree.leaves()); slot < end; ++slot) {
        ++out_.visited;
        if (s_.lights[slot].power > 0) light(slot, entry);
      }
    }
  }

  template <bool Dimmed>
  DimmingRange dimmed(std::size_t at, const TreeNode& node, const View& v) const noexcept {
    if constexpr (Dimmed)
      return dimming(s_.nodeModulation[at - s_.firstDimmedNode], v.between, v.distance, node.reach + b_);
    return {};
  }

  template <bool Dimmed>
  DimmingRange dimmed(std::size_t slot, const TreeLight& light, const View& v, float reach) const noexcept {
    if constexpr (Dimmed)
      return dimming(s_.lightModulation[slot - s_.firstDimmedLight], v.between, v.distance, light.reach + reach);
    return {};
  }

  /// How much of a cluster is closed at a distance where all of it may be from `enough` on.
  static float closedFrom(float least, float enough) noexcept {
    if (!(least >= enough)) return 0;
    return enough > 0 ? smoothstep((least / enough - 1) / kBand) : 1;
  }

  float slopeDistance(float distance, float reach) const noexcept {
    return std::max({distance, kSlopeReach * (reach + b_), 1e-15f});
  }

  template <bool Dimmed>
  void measure(const Tree& tree) {
    walk(
        tree,
        [&](std::size_t at, const TreeNode& node, Entry& entry) {
          const View v = view(node);
          const DimmingRange dim = dimmed<Dimmed>(at, node, v);
          if (Dimmed && !(dim.most > 0)) return 1.0f;
          entry.dark = std::min(entry.dark, std::min(1.0f, dim.most / kDark));
          const float closed = closedFrom(v.least, kCoarse * node.spread + node.reach);
          if (closed > 0) addCluster(node, v, dim, static_cast<double>(entry.weight) * closed, entry.dark);
          return closed;
        },
        [&](std::size_t slot, const Entry& entry) {
          const TreeLight& light = s_.lights[slot];
          const View v = view(light);
          const DimmingRange dim = dimmed<Dimmed>(slot, light, v, b_);
          if (Dimmed && !(dim.most > 0)) return;
          const float dark = std::min(entry.dark, std::min(1.0f, dim.most / kDark));
          const double far = slopeDistance(v.distance, light.reach);
          all_ += static_cast<double>(entry.weight) * dark * light.power / (far * far);
          mean_ += static_cast<double>(entry.weight) * field_.mean * meanAtCentre<Dimmed>(slot, light, v);
        });
  }

  void addCluster(const TreeNode& node, const View& v, const DimmingRange& dim, double weight, float dark) noexcept {
    const double inverse = 1.0 / v.least;
    const double square = node.spread * inverse * (node.spread * inverse);
    const double theta = std::min(0.9, node.reach * inverse);
    const double lopside = 2 * node.lopside * inverse;
    const double grown = weight * dark * node.power * (1 + square * growthOf(static_cast<float>(theta)) + lopside);
    clusters_ += grown * inverse * inverse;
    const double far = slopeDistance(v.distance, node.reach);
    all_ += grown / (far * far);
    // What a sum of 1/d^2 is at least: its second derivative is no less than -2/d^4.
    const double near = (1 - theta) * (1 - theta);
    const double least = node.mean - node.power * (square / (near * near) + lopside);
    mean_ += weight * dim.least * field_.mean * std::max(0.0, least) / (static_cast<double>(v.distance) * v.distance);
  }

  template <bool Dimmed>
  double meanAtCentre(std::size_t slot, const TreeLight& light, const View& v) const noexcept {
    const bool disk = light.radius == 0;
    // Emitters of a disk may be its radius closer; within a spot's sphere its cosine is not the direction's.
    const float loose = disk || v.distance < light.radius ? 0 : -light.reach;
    const float least = dimmed<Dimmed>(slot, light, v, loose).least;
    if (!(least > 0)) return 0;
    if (!disk) return static_cast<double>(least) * light.mean * meanOf(v.distance, light.radius);
    const double far = v.distance + light.reach;
    return static_cast<double>(least) * light.mean / (far * far);
  }

  template <bool Dimmed>
  void take(const Tree& tree) {
    walk(
        tree, [&](std::size_t at, const TreeNode& node, Entry& entry) { return takeCluster<Dimmed>(at, node, entry); },
        [&](std::size_t slot, const Entry& entry) { takeLight<Dimmed>(slot, entry); });
  }

  template <bool Dimmed>
  float takeCluster(std::size_t at, const TreeNode& node, Entry& entry) {
    const float enough = k_ * node.spread + x_ * node.lopside + node.reach;
    if (!Dimmed && !isBeyond(node, enough + b_)) return 0;
    const View v = view(node);
    const DimmingRange dim = dimmed<Dimmed>(at, node, v);
    if (Dimmed && !(dim.most > 0)) return 1;
    entry.dark = std::min(entry.dark, std::min(1.0f, dim.most / kDark));
    float closed = closedFrom(v.least, enough);
    if (!(closed > 0)) return 0;

    const float level = (dim.least + dim.most) / 2;
    const float swing = Dimmed ? (dim.most - dim.least) / 2 : 0;
    const float square = node.spread * node.spread;
    if (Dimmed) {
      const float error = errorOf(node, level, swing, v.least, square, 0);
      closed *= 1 - smoothstep((error / (tau_ * entry.dark) - 0.6f) / 0.4f);
      if (!(closed > 0)) return 0;
    }
    const float weight = entry.weight * closed;
    const double power = static_cast<double>(weight) * node.power;
    float near = 1;
    if (q_.slopes) {
      const float sloped = errorOf(node, level, swing, v.distance, square + b_ * (b_ + 2 * node.lopside), b_);
      near = nearShare(sloped, (tau_ + slopeTau_) * entry.dark, v.distance, node.reach);
      if (near < 1) bound_ += (1 - near) * sloped * power / (static_cast<double>(v.distance) * v.distance);
    }
    if (near > 0) {
      const float error = errorOf(node, level, swing, v.least, square, 0);
      bound_ += near * error * power / (static_cast<double>(v.least) * v.least);
    }
    push(static_cast<std::uint32_t>(s_.slotOf.size() + at), weight * level, near);
    return closed;
  }

  /// Whether the centre is farther than `reach` from that of the ball; false where that cannot be known.
  template <class Place>
  bool isBeyond(const Place& place, float reach) const noexcept {
    const Vec3 between{q_.centre.x - place.x, q_.centre.y - place.y, q_.centre.z - place.z};
    return dot(between, between) >= reach * reach;
  }

  /// N (level (2 D/d + S G/d^2) + swing), per P/d^2; `loose`: how much closer to the lights a point may be.
  float errorOf(const TreeNode& node, float level, float swing, float d, float square, float loose) const noexcept {
    const float inverse = 1 / d;
    const float theta = std::min(0.999f, (node.reach + loose) * inverse);
    const float expansion = 2 * node.lopside * inverse + square * inverse * inverse * growthOf(theta);
    return field_.rms * (level * expansion + swing / ((1 - theta) * (1 - theta)));
  }

  /// Share that goes to every sample, because slopes do not follow it there.
  float nearShare(float error, float limit, float distance, float reach) const noexcept {
    if (!q_.slopes) return 1;
    if (!(limit > 0)) return 1;
    const float wrong = smoothstep((error / limit - 0.8f) / 0.2f);
    const float enough = kSlopeReach * (reach + b_);
    const float close = enough > 0 ? 1 - smoothstep((distance / enough - 1) / kSlopeBand) : 0;
    return std::max(wrong, close);
  }

  template <bool Dimmed>
  void takeLight(std::size_t slot, const Entry& entry) {
    const TreeLight& light = s_.lights[slot];
    const View v = view(light);
    const DimmingRange dim = dimmed<Dimmed>(slot, light, v, b_);
    if (Dimmed && !(dim.most > 0)) return;
    float near = 1, error = 0;
    if (q_.slopes && v.distance > kSlopeReach * (light.reach + b_) && !(dim.least < 1)) {
      const float inverse = 1 / v.distance;
      const float theta = (light.reach + b_) * inverse;
      error = field_.rms * b_ * b_ * inverse * inverse * growthOf(theta);
      near = nearShare(error, slopeTau_, v.distance, light.reach);
      bound_ += static_cast<double>(entry.weight) * (1 - near) * error * light.power * inverse * inverse;
    }
    push(light.light, entry.weight, near);
  }

  void push(std::uint32_t light, float share, float near) {
    share = std::min(share, 1.0f);
    if (near > 0) out_.near.push_back({light, share * near});
    if (near < 1) out_.distant.push_back({light, share * (1 - near)});
  }

  const LightTreeState& s_;
  const LightQuery& q_;
  LightSelection& out_;
  Field field_;
  float b_;
  double clusters_ = 0;  // U
  double all_ = 0;       // the same of everything that slopes may stand for, by the distance of the centres
  double mean_ = 0;
  double bound_ = 0;
  float tau_ = 0, slopeTau_ = 0, k_ = 0, x_ = 0;
};

}  // namespace

void LightTree::select(const LightQuery& query, LightSelection& out) const {
  out.near.clear();
  out.distant.clear();
  out.bound = out.worst = out.reference = out.mean = 0;
  out.visited = 0;
  Query(*state_, query, out).run();
}

}  // namespace rigel
