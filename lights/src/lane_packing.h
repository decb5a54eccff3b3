// For each set of eight lanes the order that puts its members first.
#pragma once

#include <array>
#include <cstdint>

namespace rigel {

using LanePacking = std::array<std::int32_t, 8>;

inline constexpr std::array<LanePacking, 256> kLanePackings = [] {
  std::array<LanePacking, 256> packings{};
  for (unsigned set = 0; set < 256; ++set) {
    int end = 0;
    for (int lane = 0; lane < 8; ++lane)
      if (set >> lane & 1) packings[set][end++] = lane;
  }
  return packings;
}();

}  // namespace rigel
