// One pass of a large ball, where those within it go on (light_tree.h, takeDistant). A cluster is taken where the bound
// of its error, by value and slopes, is at most `target` times its own light where that is least in the ball. So the
// sum of all bounds is at most target times the light that is taken, and nothing has to be known of other lights.
//
// What is too close for even a single light to be taken is handed on as it is, or dense lights in the ball would all be
// looked at. Smaller balls may take clusters that this one would have opened, and so this too has to be continuous:
// over a band of distances a node is opened in part, and handed on in part.
#include "light_tree_query.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

using detail::LightTreeState;

// Opened are nodes that reach farther than kOpen of the distance at which a part may take a single light: there
// clusters may be as large as `select` would have them, and closer by they would have to be many. All are from
// kOpenBand more on.
constexpr float kOpen = 1.8f, kOpenBand = 0.1f;

// What errs by more than this share of what is allowed begins to give way: late, for most of it is taken in part
// besides, with all that is below it, where the band is wide.
constexpr float kGivesWay = 0.9f;

class DistantQuery : BallQuery {
 public:
  DistantQuery(const LightTreeState& state, const LightQuery& query, float part, std::vector<LightUse>& whole,
               std::vector<LightUse>& parts, LightCut& rest) noexcept
      : BallQuery(state, query, nullptr),
        whole_(whole),
        parts_(parts),
        rest_(rest),
        part_(std::min(std::max(0.0f, part), b_)),
        gap_(b_ - part_) {
    target_ = std::max(0.0f, query.target) * field_.mean;
    // From k sqrt(S) on: errors are 3 N S/d^2 at least, and a light's mean is its power at most.
    k_ = std::sqrt(3 * field_.rms / target_);
    // A part may take a single light where its centre is c away and c^2 = k part (c + gap + b).
    const float kPart = k_ * part_;
    opens_ = gap_ + kOpen * (kPart / 2 + std::sqrt(kPart * (kPart / 4 + gap_ + b_)));
  }

  void run() {
    forEachTree([&](const Tree& tree, auto dimmed) { take<dimmed.value>(tree); });
    rest_.bound = bound_;
    rest_.mean = mean_;
  }

 private:
  template <bool Dimmed>
  void take(const Tree& tree) {
    walk(
        tree,
        [&](std::size_t at, const TreeNode& node, const Entry& entry) {
          const View v = viewOf(node);
          const float closed = takeCluster<Dimmed>(at, node, v, entry.weight);
          if (!(closed < 1)) return 1.0f;
          const float opened = smoothstep(((v.distance + node.reach) / opens_ - 1) / kOpenBand);
          if (opened >= 1) return closed;
          // Not for NaN.
          const float part = opened > 0 ? opened : 0;
          rest_.open.push_back(
              {numberOf(tree), static_cast<std::uint32_t>(entry.node), entry.weight * (1 - closed) * (1 - part)});
          return 1 - (1 - closed) * part;
        },
        [&](std::size_t slot, const Entry& entry) {
          const float rest = 1 - takeLight<Dimmed>(slot, entry.weight);
          if (rest > 0)
            rest_.open.push_back({numberOf(tree), static_cast<std::uint32_t>(slot) | kLightPart, entry.weight * rest});
        });
  }

  /// How much of it is taken.
  template <bool Dimmed>
  float takeCluster(std::size_t at, const TreeNode& node, const View& v, float weight) {
    const float square = node.spread * node.spread;
    if (!Dimmed && !allows(v.distance, square)) return 0;
    const DimmingRange dim = dimmed<Dimmed>(at, node, v);
    if (Dimmed && !(dim.most > 0)) return 1;
    if (Dimmed && !(dim.least > 0 && allows(v.distance, square))) return 0;
    return take({useOf(at), node.reach, square, node.lopside, node.power, node.mean}, dim, v, v.distance + b_, weight);
  }

  template <bool Dimmed>
  float takeLight(std::size_t slot, float weight) {
    const TreeLight& light = s_.lights[slot];
    const View v = viewOf(light);
    const DimmingRange dim = dimmed<Dimmed>(slot, light, v, b_);
    if (Dimmed && !(dim.most > 0)) return 1;
    if (dim.least < 1 || !allows(v.distance, 0)) return 0;
    return take({light.light, light.reach, 0, 0, light.power, light.mean}, {}, v, v.distance + b_ + light.reach,
                weight);
  }

  /// Whether a cluster of that second moment could be taken: without a division, for most cannot.
  bool allows(float distance, float square) const noexcept {
    return allows(distance, distance, square + b_ * b_) ||
           allows(std::max(0.0f, distance - gap_), distance, square + part_ * part_);
  }
  bool allows(float closest, float distance, float square) const noexcept {
    const float least = closest * closest, most = k_ * (distance + b_);
    return square * most * most <= least * least;
  }

  struct Source {
    std::uint32_t use;
    float reach, square, lopside;  // square: S/P
    float power, mean;
  };

  /// Value and slopes at distance d, in a ball of radius r and dimmed by l +- s, err by
  ///
  ///   N P ( l (2 D/P + (S/P + r (r + 2 D/P)) (3 d - 2 (a + r)) / e^2) / d^3 + s / e^2 ),   e = d - r - a
  ///
  /// at most: light_tree.h with its G written out. Parts as close as they can be have the same e as the ball.
  float take(const Source& source, DimmingRange dim, const View& v, float beyond, float weight) {
    const float e = v.least - source.reach;
    if (!(e > 0)) return 0;
    const float inverse = 1 / e, inverseSquare = inverse * inverse;
    const float level = (dim.least + dim.most) / 2, swing = (dim.most - dim.least) / 2;
    const auto error = [&](float d, float r) {
      const float square = source.square + r * (r + 2 * source.lopside);
      const float expansion = 2 * source.lopside + square * (3 * d - 2 * (source.reach + r)) * inverseSquare;
      return field_.rms * source.power * (level * expansion / (d * d * d) + swing * inverseSquare);
    };
    const float nearest = 1 / v.least, bend = v.least * inverseSquare;
    const float mean =
        dim.least *
        std::max(0.0f, source.mean - source.power * (source.square * bend * bend + 2 * source.lopside * nearest)) /
        (beyond * beyond);
    const float limit = target_ * mean;

    float taken = 0;
    const auto takeFor = [&](std::vector<LightUse>& uses, float distance, float ball) {
      const float bound = error(distance, ball);
      if (!(bound < limit)) return;
      const float share = (1 - taken) * (1 - nearShare(bound, limit, distance, source.reach, ball, kGivesWay));
      if (!(share > 0)) return;
      uses.push_back({source.use, std::min(1.0f, weight * share * level)});
      bound_ += static_cast<double>(weight) * share * bound;
      taken += share;
    };
    takeFor(whole_, v.distance, b_);
    if (taken < 1) takeFor(parts_, v.distance - gap_, part_);
    mean_ += static_cast<double>(weight) * taken * field_.mean * mean;
    return taken;
  }

  std::vector<LightUse>& whole_;
  std::vector<LightUse>& parts_;
  LightCut& rest_;
  float part_, gap_, target_, k_, opens_;
  double bound_ = 0, mean_ = 0;
};

}  // namespace

void LightTree::takeDistant(const LightQuery& query, float part, std::vector<LightUse>& whole,
                            std::vector<LightUse>& parts, LightCut& rest) const {
  whole.clear();
  parts.clear();
  rest.open.clear();
  rest.bound = rest.mean = 0;
  if (state_->counts[0] == LightTreeState::kNotBuilt) return;
  DistantQuery(*state_, query, part, whole, parts, rest).run();
}

}  // namespace rigel
