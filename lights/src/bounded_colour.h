#pragma once

#include <rigel/project.h>

#include <algorithm>

namespace rigel::detail {

/// colour * scale, held within +-kMaxProjectionScale; a product without a value (infinity times zero) is 0.
inline Rgb boundedColour(Rgb colour, double scale) noexcept {
  constexpr double kLimit = kMaxProjectionScale;
  const auto bounded = [&](float channel) {
    const double product = channel * scale;
    return product == product ? static_cast<float>(std::clamp(product, -kLimit, kLimit)) : 0.0f;
  };
  return {bounded(colour.r), bounded(colour.g), bounded(colour.b)};
}

}  // namespace rigel::detail
