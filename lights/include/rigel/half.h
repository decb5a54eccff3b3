// IEEE 754 half floats.
#pragma once

#include <bit>
#include <cstdint>

namespace rigel {

/// Round to nearest even; beyond the largest half infinity, NaN stays NaN.
constexpr std::uint16_t halfFromFloat(float x) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);
  if (magnitude >= 0x47800000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // 2^16
  if (magnitude < 0x38800000u) {
    // Below 2^-14 halves are multiples of 2^-24, as floats from 0.5 to 1 are: the sum rounds as it should.
    const float sum = std::bit_cast<float>(magnitude) + 0.5f;
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(sum) - 0x3f000000u));
  }
  // 13 bits go: half of their unit less one, and one more where the last bit that stays is odd. The carry may run into
  // the exponent, and into infinity.
  const std::uint32_t rounded = magnitude - 0x38000000u + 0xfffu + (magnitude >> 13 & 1u);
  return static_cast<std::uint16_t>(sign | rounded >> 13);
}

/// Exact.
constexpr float floatFromHalf(std::uint16_t half) noexcept {
  const std::uint32_t sign = (half & 0x8000u) << 16, magnitude = half & 0x7fffu;
  if (magnitude < 0x0400u) {
    // Multiples of 2^-24.
    const float size = static_cast<float>(magnitude) * 0x1p-24f;
    return sign != 0 ? -size : size;
  }
  const std::uint32_t rest = magnitude << 13;
  return std::bit_cast<float>(sign | (magnitude < 0x7c00u ? rest + 0x38000000u : rest | 0x7f800000u));
}

}  // namespace rigel
