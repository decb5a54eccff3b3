// What the page does with packed pictures, written anew and slowly.
#pragma once

#include "report/pictures/pixel_packing.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>

namespace rigel::tests {

inline std::vector<std::uint8_t> inflated(const std::vector<std::uint8_t>& stream, std::size_t size) {
  std::vector<std::uint8_t> bytes(size + 1);  // one more than there should be
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &length, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(length, size);
  bytes.resize(size);
  return bytes;
}

inline tools::HalfPlanes unpackPlanes(const std::vector<std::uint8_t>& stream, const tools::PixelMask& mask,
                                      const tools::HalfPlanes* base = nullptr) {
  const std::size_t count = mask.count();
  const auto width = static_cast<std::size_t>(mask.width), height = static_cast<std::size_t>(mask.height);
  const std::vector<std::uint8_t> bytes = inflated(stream, 6 * count);
  tools::HalfPlanes planes;
  std::size_t at = 0;
  for (const std::size_t channel : {1u, 0u, 2u}) {
    // The plane as a picture: a value a pixel, covered or not.
    std::vector<std::uint16_t> values(width * height);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        if (!mask.covered[y * width + x]) continue;
        const auto has = [&](bool inside, std::size_t i) { return inside && mask.covered[i]; };
        const bool left = has(x > 0, y * width + x - 1), up = has(y > 0, (y - 1) * width + x);
        const bool upLeft = has(x > 0 && y > 0, (y - 1) * width + x - 1);
        const auto value = [&](std::size_t i) { return int{static_cast<std::int16_t>(values[i])}; };
        int predicted = 0;
        if (left && up && upLeft) {
          const int a = value(y * width + x - 1), b = value((y - 1) * width + x), c = value((y - 1) * width + x - 1);
          predicted = std::clamp(a + b - c, std::min(a, b), std::max(a, b));
        } else if (left) {
          predicted = value(y * width + x - 1);
        } else if (up) {
          predicted = value((y - 1) * width + x);
        }
        const unsigned code = bytes[at] * 256u + bytes[3 * count + at];
        ++at;
        const int residual = code % 2 ? -static_cast<int>(code / 2) - 1 : static_cast<int>(code / 2);
        values[y * width + x] = static_cast<std::uint16_t>(predicted + residual);
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      if (mask.covered[i]) planes[channel].push_back(values[i]);
  }
  for (const std::size_t channel : {0u, 2u})
    for (std::size_t i = 0; i < count; ++i)
      planes[channel][i] = static_cast<std::uint16_t>(planes[channel][i] + planes[1][i]);
  for (std::size_t channel = 0; base && channel < 3; ++channel)
    for (std::size_t i = 0; i < count; ++i)
      planes[channel][i] = static_cast<std::uint16_t>(planes[channel][i] + (*base)[channel][i]);
  return planes;
}

}  // namespace rigel::tests
