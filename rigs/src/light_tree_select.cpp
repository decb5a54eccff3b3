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
#include "light_tree_query.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

using detail::LightTreeState;

// The first pass takes clusters from this many spreads (and one reach) on at least.
constexpr float kCoarse = 3;
// A cluster gives way to its children over this share of its distance.
constexpr float kBand = 0.08f;
// What is dimmed to less than this counts as much less in U.
constexpr float kDark = 0.02f;
/// Mean irradiance over the normals of a light with distance d and radius r, per that of a point at distance 1.
float meanOf(float d, float r) noexcept {
  if (d >= r) return 2 / (1 + std::sqrt((d - r) * (d + r)) / d) / (d * d);
  return 2 * (1 + std::sqrt((r - d) * (r + d)) / r) / (r * r);
}

class Query : BallQuery {
 public:
  Query(const LightTreeState& state, const LightQuery& query, const LightCut* from, LightSelection& out) noexcept
      : BallQuery(state, query, from), out_(out) {
    if (from == nullptr) return;
    mean_ = from->mean;
    bound_ = from->bound;
  }

  void run() {
    const float slopes = std::clamp(q_.slopeShare, 0.0f, 1.0f);
    slopes_ = slopes > 0;
    // For the tau of white lights without dimming; the second pass takes clusters half as large at most.
    const double expected = static_cast<double>(field_.mean) * (1 - slopes) * q_.target;
    if (expected > 0 && !(q_.reference > 0))
      coarse_ = std::max(kCoarse, 0.5f * static_cast<float>(std::sqrt(3 * field_.rms / expected)));
    addLone();
    forEachTree([&](const Tree& tree, auto dimmed) { measure<dimmed.value>(tree); });
    out_.mean = static_cast<float>(mean_);
    out_.reference = q_.reference > 0 ? q_.reference : out_.mean;
    const double budget = static_cast<double>(std::max(0.0f, q_.target)) * out_.reference - bound_;
    tau_ = tauOf((1 - slopes) * budget, clusters_);
    slopeTau_ = tauOf(slopes * budget, all_);
    k_ = std::max(coarse_, std::sqrt(3 * field_.rms / tau_));
    x_ = 2 * field_.rms / tau_;
    forEachTree([&](const Tree& tree, auto dimmed) { take<dimmed.value>(tree); });
    finish();
  }

 private:
  void addLone() {
    for (const LoneLight& light : s_.lone) {
      if ((light.groups & q_.groups) == 0) continue;
      ++visited_;
      if (!light.shines) continue;
      const bool distant = light.directional && slopes_;
      (distant ? out_.distant : out_.nearby).push_back({light.light, 1});
      mean_ += static_cast<double>(field_.mean) * light.mean;
    }
  }

  /// How much of a cluster is closed at a distance where all of it may be from `enough` on.
  static float closedFrom(float least, float enough) noexcept {
    if (!(least >= enough)) return 0;
    return enough > 0 ? smoothstep((least / enough - 1) / kBand) : 1;
  }

  template <bool Dimmed>
  void measure(const Tree& tree) {
    walk(
        tree,
        [&](std::size_t at, const TreeNode& node, Entry& entry) {
          const View v = viewOf(node);
          const DimmingRange dim = dimmed<Dimmed>(at, node, v);
          if (Dimmed && !(dim.most > 0)) return 1.0f;
          entry.dark = std::min(entry.dark, std::min(1.0f, dim.most / kDark));
          const float closed = closedFrom(v.least, coarse_ * node.spread + node.reach);
          if (closed > 0) addCluster(node, v, dim, static_cast<double>(entry.weight) * closed, entry.dark);
          return closed;
        },
        [&](std::size_t slot, const Entry& entry) {
          const TreeLight& light = s_.lights[slot];
          const View v = viewOf(light);
          const DimmingRange dim = dimmed<Dimmed>(slot, light, v, b_);
          if (Dimmed && !(dim.most > 0)) return;
          const float dark = std::min(entry.dark, std::min(1.0f, dim.most / kDark));
          const double far = slopeDistance(v.distance, light.reach);
          all_ += static_cast<double>(entry.weight) * dark * light.power / (far * far);
          mean_ += static_cast<double>(entry.weight) * field_.mean * meanAtCentre<Dimmed>(slot, light, v);
        });
  }

  void addCluster(const TreeNode& node, const View& v, const DimmingRange& dim, double weight, float dark) noexcept {
    const float inverse = 1 / v.least;
    const float ratio = node.spread * inverse, square = ratio * ratio;
    const float theta = std::min(0.99999f, node.reach * inverse);
    const float near = 1 / ((1 - theta) * (1 - theta));
    const float lopside = 2 * node.lopside * inverse;
    const double grown = weight * dark * node.power * (1 + square * (3 - 2 * theta) * near + lopside);
    clusters_ += grown * (inverse * inverse);
    const float far = 1 / slopeDistance(v.distance, 0);
    all_ += grown * (far * far);
    // What a sum of 1/d^2 is at least: its second derivative is no less than -2/d^4.
    const float beyond = 1 / (v.distance + (q_.everywhere ? b_ : 0));
    const float least = node.mean - node.power * (square * near * near + lopside);
    mean_ += weight * dim.least * field_.mean * std::max(0.0f, least) * (beyond * beyond);
  }

  template <bool Dimmed>
  double meanAtCentre(std::size_t slot, const TreeLight& light, const View& v) const noexcept {
    const bool disk = light.radius == 0;
    const float ball = q_.everywhere ? b_ : 0;
    // Emitters of a disk may be its radius closer; within a spot's sphere its cosine is not the direction's.
    const float loose = disk || v.distance < light.radius ? ball : ball - light.reach;
    const float least = dimmed<Dimmed>(slot, light, v, loose).least;
    if (!(least > 0)) return 0;
    if (!disk) return static_cast<double>(least) * light.mean * meanOf(v.distance + ball, light.radius);
    const double far = v.distance + light.reach + ball;
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
    const View v = viewOf(node);
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
    if (slopes_) {
      const float sloped = errorOf(node, level, swing, v.distance, square + b_ * (b_ + 2 * node.lopside), b_);
      near = nearShare(sloped, (tau_ + slopeTau_) * entry.dark, v.distance, node.reach);
      if (near < 1) {
        const float far = 1 / v.distance;
        bound_ += (1 - near) * sloped * power * (far * far);
      }
    }
    if (near > 0) {
      const float far = 1 / v.least;
      bound_ += near * errorOf(node, level, swing, v.least, square, 0) * power * (far * far);
    }
    push(useOf(at), weight * level, near);
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

  template <bool Dimmed>
  void takeLight(std::size_t slot, const Entry& entry) {
    const TreeLight& light = s_.lights[slot];
    const View v = viewOf(light);
    const DimmingRange dim = dimmed<Dimmed>(slot, light, v, b_);
    if (Dimmed && !(dim.most > 0)) return;
    float near = 1;
    if (slopes_ && !(dim.least < 1) && allowsSlopes(v.distance, light.reach)) {
      const float error = slopeError(v.distance, light.reach);
      near = nearShare(error, slopeTau_, v.distance, light.reach);
      const float far = 1 / v.distance;
      bound_ += static_cast<double>(entry.weight) * (1 - near) * error * light.power * (far * far);
    }
    push(light.light, entry.weight, near);
  }

  void push(std::uint32_t light, float share, float near) {
    share = std::min(share, 1.0f);
    if (near > 0) out_.nearby.push_back({light, share * near});
    if (near < 1) out_.distant.push_back({light, share * (1 - near)});
  }

  void finish() noexcept {
    // What errors and their shares are good to in float, the rounding of moments included.
    constexpr double kFloatSlack = 1 + 2e-5;
    out_.bound = static_cast<float>(bound_ * kFloatSlack);
    out_.worst = static_cast<float>(bound_ * kFloatSlack * (field_.peak / field_.rms));
    out_.visited = visited_;
  }

  LightSelection& out_;
  double clusters_ = 0;  // U
  double all_ = 0;       // the same of everything that slopes may stand for, by the distance of the centres
  double mean_ = 0;
  double bound_ = 0;
  float coarse_ = kCoarse, tau_ = 0, slopeTau_ = 0, k_ = 0, x_ = 0;
  bool slopes_ = true;
};

}  // namespace

void LightTree::select(const LightQuery& query, LightSelection& out) const { select(query, nullptr, out); }

void LightTree::select(const LightQuery& query, const LightCut* from, LightSelection& out) const {
  out.nearby.clear();
  out.distant.clear();
  out.bound = out.worst = out.reference = out.mean = 0;
  out.visited = 0;
  if (state_->counts[0] == LightTreeState::kNotBuilt) return;
  Query(*state_, query, from, out).run();
}

}  // namespace rigel
