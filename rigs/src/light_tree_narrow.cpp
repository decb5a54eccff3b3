// Lights of a region for one object in it. Clusters of the region's selection are as good for every point of its ball;
// what is left to decide is for which of them slopes at the object do.
#include "light_tree_query.h"

namespace rigel {
namespace {

class Narrowing : BallQuery {
 public:
  using BallQuery::BallQuery;

  void run(const LightSelection& region) {
    double all = 0;
    for (const LightUse& use : region.near) {
      const Local local = localOf(use.light);
      const float distance = length(q_.centre - local.position);
      const double far = slopeDistance(distance, local.reach);
      all += static_cast<double>(use.share) * local.power / (far * far);
    }
    out_.mean = region.mean;
    out_.reference = q_.reference > 0 ? q_.reference : region.mean;
    slopeTau_ = tauOf(static_cast<double>(q_.target) * out_.reference, all);
    bound_ = region.bound;
    for (const LightUse& use : region.near) take(use);
    finish(bound_);
  }

 private:
  struct Local {
    Vec3 position;
    float reach;
    float power;
    std::size_t dimmed;  // its place in lightModulation; kNone: never dimmed
    bool lone;
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Local localOf(std::uint32_t light) const noexcept {
    if (light >= s_.slotOf.size()) {
      const std::size_t at = light - s_.slotOf.size();
      const SphereLight& cluster = s_.clusters[at];
      return {cluster.position, 2 * cluster.radius, s_.nodes[at].power, kNone, false};
    }
    const std::uint32_t slot = s_.slotOf[light];
    if (slot & detail::LightTreeState::kLone) return {{}, 0, 0, kNone, true};
    const TreeLight& l = s_.lights[slot];
    const bool dimmed = slot >= s_.firstDimmedLight;
    return {{l.x, l.y, l.z}, l.reach, l.power, dimmed ? slot - s_.firstDimmedLight : kNone, false};
  }

  void take(const LightUse& use) {
    ++out_.visited;
    const Local local = localOf(use.light);
    if (local.lone) return push(use.light, use.share, 1);
    const View v = view(local.position);
    bool full = true;
    if (local.dimmed != kNone) {
      const DimmingRange dim = dimming(s_.lightModulation[local.dimmed], v.between, v.distance, local.reach + b_);
      if (!(dim.most > 0)) return;
      full = !(dim.least < 1);
    }
    float near = 1;
    if (full && allowsSlopes(v.distance, local.reach)) {
      const float error = slopeError(v.distance, local.reach);
      near = nearShare(error, slopeTau_, v.distance, local.reach);
      bound_ += static_cast<double>(use.share) * (1 - near) * error * local.power /
                (static_cast<double>(v.distance) * v.distance);
    }
    push(use.light, use.share, near);
  }

  double bound_ = 0;
  float slopeTau_ = 0;
};

}  // namespace

void LightTree::narrow(const LightSelection& region, const LightQuery& query, LightSelection& out) const {
  out.near.clear();
  out.distant.clear();
  out.visited = 0;
  Narrowing(*state_, query, out).run(region);
}

}  // namespace rigel
