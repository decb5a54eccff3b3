// Ranges of values over points and normals, and what two functions within them can differ by.
#pragma once

#include <algorithm>
#include <limits>

namespace rigel {

/// Values of opposite sign that a function takes: between -down and up.
struct Range {
  double down = 0, up = 0;
};

/// Largest difference of two functions.
inline double difference(Range a, Range b) noexcept { return std::max(a.up + b.down, a.down + b.up); }

/// Of weighted sums of values in `values`, the sum of |weights| being at most `lebesgue` and that of weights 1.
inline Range blended(Range values, double lebesgue) noexcept {
  const double spread = (lebesgue - 1) / 2 * (values.up + values.down);
  return {values.down + spread, values.up + spread};
}

/// A bound as a float: finite, and above 0.
inline float heldBound(double x) noexcept {
  constexpr double kLargest = std::numeric_limits<float>::max();
  constexpr double kLeast = std::numeric_limits<float>::min();
  return static_cast<float>(std::clamp(x, kLeast, kLargest));
}

// Of the light's peak and the sum of |weights|: rounding of the float path.
inline constexpr double kValueRounding = 1e-6;

}  // namespace rigel
