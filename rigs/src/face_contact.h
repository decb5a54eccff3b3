// Which disk lights an object is about to touch: what passes through a face leaps from darkness to all of its light,
// and only a light that is evaluated exactly leaps with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "weights.h"

namespace rigel {

/// Remembers the distances of the last frame, so that a light is near in time for the speed at which the object comes,
/// and not for any other. One object's; distances are in its radii (LightBound::gap).
class FaceContact {
 public:
  void reset() noexcept { now_.clear(); }

  /// A new frame, `seconds` after the last; without a duration no speed is known.
  void begin(float seconds, std::size_t lights) {
    const bool timed = seconds > 0 && std::isfinite(seconds);
    last_.swap(now_);
    now_.clear();
    last_.reserve(lights);
    now_.reserve(lights);
    if (!timed) last_.clear();
    seconds_ = seconds;
    const auto before = [](const Face& a, const Face& b) { return a.id < b.id; };
    if (!std::ranges::is_sorted(last_, before)) std::ranges::sort(last_, before);
  }

  /// The same for any speed that there may be: for who has as many near lights whatever they are.
  static float shareAtAnySpeed(float gap) noexcept {
    return smoothstep((kContactOuter - gap) / (kContactOuter - kContactInner));
  }

  /// In [0, 1]: how much of a light must be near now, whatever it costs. Once a light and frame.
  float share(std::uint32_t id, float gap) {
    if (!(gap < kWatched)) return 0;
    now_.push_back({id, gap});
    const auto old = std::ranges::lower_bound(last_, id, {}, &Face::id);
    const float closing = old != last_.end() && old->id == id ? (old->gap - gap) / seconds_ : 0.0f;
    const float seconds = gap / std::clamp(closing, kLeastSpeed, kMostSpeed);
    return smoothstep((kFrom - seconds) / (kFrom - kTo));
  }

 private:
  struct Face {
    std::uint32_t id = 0;
    float gap = 0;
  };
  // Before the touch: the share begins to rise, and is all. Weights rise within 50 ms.
  static constexpr float kFrom = 0.09f, kTo = 0.03f;  // s
  // Radii a second. Who stands before a face may start to walk; and after a cut no speed is known.
  static constexpr float kLeastSpeed = 1, kMostSpeed = 8;
  static constexpr float kWatched = 2;  // radii: far more than anything covers in kFrom

  std::vector<Face> last_, now_;
  float seconds_ = 0;
};

}  // namespace rigel
