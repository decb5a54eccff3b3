// A ball, its field, and where slopes do: what light_tree_select.cpp asks of one light or cluster.
#pragma once

#include <rigel/wrap.h>

#include "light_tree_state.h"
#include "weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rigel {

/// G of light_tree.h; for t < 1.
inline float growthOf(float t) noexcept { return (3 - 2 * t) / ((1 - t) * (1 - t)); }

/// Irradiance of a light of power 1 at distance 1, over the normals.
struct UnitField {
  float rms, peak, mean;
};

inline UnitField unitField(float wrap) noexcept {
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  const double e0 = 0.25 * f[0], e1 = 0.75 * f[1], e2 = 1.25 * f[2];
  return {static_cast<float>(std::sqrt(e0 * e0 + e1 * e1 / 3 + e2 * e2 / 5)), static_cast<float>(e0 + e1 + e2),
          static_cast<float>(e0)};
}

class BallQuery {
 public:
  BallQuery(const detail::LightTreeState& state, const LightQuery& query, LightSelection& out) noexcept
      : s_(state), q_(query), out_(out), field_(unitField(query.wrap)), b_(std::max(0.0f, query.radius)) {}

 protected:
  /// A light or cluster from the ball.
  struct View {
    Vec3 between;
    float distance;  // between the centres
    float least;     // from the ball; 0 where the centre is within
  };

  View view(Vec3 place) const noexcept {
    const Vec3 between = q_.centre - place;
    const float distance = length(between);
    return {between, distance, std::max(0.0f, distance - b_)};
  }

  /// The distance at which a light counts among those that slopes may stand for.
  float slopeDistance(float distance, float reach) const noexcept {
    return std::max({distance, kSlopeReach * (reach + b_), 1e-15f});
  }

  /// N (S G/d^2 with S = b^2), per P/d^2, of the slopes of one light; d > reach + b.
  float slopeError(float distance, float reach) const noexcept {
    const float inverse = 1 / distance;
    return field_.rms * b_ * b_ * inverse * inverse * growthOf((reach + b_) * inverse);
  }

  bool allowsSlopes(float distance, float reach) const noexcept { return distance > kSlopeReach * (reach + b_); }

  /// Share that goes to every sample, because slopes do not follow it there: all of it where the error is beyond the
  /// limit.
  float nearShare(float error, float limit, float distance, float reach) const noexcept {
    // The usual case, without a division.
    const float enough = kSlopeReach * (reach + b_);
    if (error <= kSlopesDo * limit && distance >= (1 + kSlopeBand) * enough) return 0;
    if (!(limit > 0)) return 1;
    const float wrong = smoothstep((error / limit - kSlopesDo) / (1 - kSlopesDo));
    const float close = enough > 0 ? 1 - smoothstep((distance / enough - 1) / kSlopeBand) : 0;
    return std::max(wrong, close);
  }

  void push(std::uint32_t light, float share, float near) {
    share = std::min(share, 1.0f);
    if (near > 0) out_.near.push_back({light, share * near});
    if (near < 1) out_.distant.push_back({light, share * (1 - near)});
  }

  void finish(double bound) noexcept {
    // What errors and their shares are good to in float, the rounding of moments included.
    constexpr double kFloatSlack = 1 + 2e-5;
    out_.bound = static_cast<float>(bound * kFloatSlack);
    out_.worst = static_cast<float>(bound * kFloatSlack * (field_.peak / field_.rms));
  }

  /// tau of a budget [W/m2] for lights of which the u sum to `sum`. No more than keeps expansions where they converge.
  static float tauOf(double budget, double sum) noexcept {
    constexpr double kLargest = 0.2;
    return budget > 0 ? static_cast<float>(std::min(kLargest, budget / std::max(sum, 1e-30))) : 0;
  }

  const detail::LightTreeState& s_;
  const LightQuery& q_;
  LightSelection& out_;
  UnitField field_;
  float b_;

 private:
  // Slopes are enough from this many radii on, and comfortably so at this share more.
  static constexpr float kSlopeReach = 3;
  static constexpr float kSlopeBand = 0.25f;
  // They begin to give way at this share of the error allowed.
  static constexpr float kSlopesDo = 0.8f;
};

}  // namespace rigel
