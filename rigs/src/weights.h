// How errors become weights, and colours one figure: what all that chooses lights agrees on.
#pragma once

#include <rigel/vec3.h>

#include <algorithm>
#include <cmath>

namespace rigel {

/// 0 for t <= 0, 1 for t >= 1, flat at both.
inline float smoothstep(float t) noexcept {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// Share of a light that is evaluated exactly: smoothstep(error / floor - 1), and its limits where the floor is 0.
inline float nearWeight(float error, float floor) noexcept {
  if (!(error > floor)) return 0;
  if (!(floor > 0)) return 1;
  return smoothstep(error / floor - 1);
}

/// How much of a disk light is near because the object may touch its face, where speeds are unknown: nothing where the
/// gap is kContactOuter of the object's radius, all at kContactInner. In time for weights that rise within 50 ms, at 8
/// radii a second.
inline constexpr float kContactOuter = 0.6f, kContactInner = 0.2f;

/// A share that nobody sees and that is not worth a slot.
inline constexpr float kLeastWeight = 1e-6f;

/// RMS over the channels, as errors are pooled.
inline float magnitude(Rgb c) noexcept { return std::sqrt((c.r * c.r + c.g * c.g + c.b * c.b) / 3); }

}  // namespace rigel
