// How a weight follows what is wanted of it when that jumps.
#pragma once

#include <algorithm>
#include <cmath>

namespace rigel {

/// Of the way that a weight has to go, what it goes within `seconds`: rate * seconds of it [1/s], and so small changes
/// shrink with the frame like large ones that a limit holds back. Not less than kLeastPace, so that it arrives. All of
/// it where rate * seconds is above 1, or `rate` is not positive.
inline float approach(float way, float rate, float seconds) noexcept {
  constexpr float kLeastPace = 0.2f;  // 1/s
  if (!(rate > 0 && rate * seconds < 1)) return way;
  return std::copysign(std::min(std::abs(way), std::max(rate * std::abs(way), kLeastPace) * seconds), way);
}

}  // namespace rigel
