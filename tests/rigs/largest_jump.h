// Whether a function is continuous along a path.
#pragma once

#include <algorithm>
#include <cmath>

namespace rigel::test {

/// The largest step of error(t) along a path, t in [0, 1], halved again and again, relative to the largest error: what
/// is left is a jump.
template <class Error>
double largestJump(int steps, Error error) {
  double largest = 0, step = 0, at = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double change = std::abs(error(t + 1.0 / steps) - error(t));
    largest = std::max<double>(largest, error(t));
    if (change > step) step = change, at = t;
  }
  double from = at, to = at + 1.0 / steps;
  while (to - from > 2e-7) {
    const double middle = (from + to) / 2;
    if (std::abs(error(middle) - error(from)) > std::abs(error(to) - error(middle))) {
      to = middle;
    } else {
      from = middle;
    }
  }
  return largest > 0 ? std::abs(error(to) - error(from)) / largest : 0;
}

}  // namespace rigel::test
