// What half floats are stored over.
#pragma once

#include <algorithm>
#include <cmath>

namespace rigel {

/// The power of two that brings `largest` between 2^14 and 2^15; its inverse is a float too.
inline float halfScale(double largest) noexcept {
  constexpr int kTop = 15, kLeast = -100;
  if (largest == 0) return 1;
  int exponent;
  (void)std::frexp(largest, &exponent);
  return std::ldexp(1.0f, std::max(exponent - kTop, kLeast));
}

}  // namespace rigel
