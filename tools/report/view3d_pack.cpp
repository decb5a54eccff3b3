#include "report/view3d_pack.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel::tools {
namespace {

template <class T>
T difference(std::span<const T> row, std::span<const T> before, std::size_t i) {
  const T predicted = !before.empty() ? before[i] : i > 0 ? row[i - 1] : T{0};
  return static_cast<T>(row[i] - predicted);
}

/// x / most in [0, 1]; 0 where it has no value.
float share(float x, float most) {
  const float s = x / most;
  return s > 0 ? std::min(s, 1.0f) : 0.0f;
}

}  // namespace

void RowPacker::add(std::span<const std::uint8_t> row, std::span<const std::uint8_t> before) {
  assert(before.empty() || before.size() == row.size());
  for (std::size_t i = 0; i < row.size(); ++i) bytes_.push_back(difference(row, before, i));
}

void RowPacker::add(std::span<const std::uint16_t> row, std::span<const std::uint16_t> before) {
  assert(before.empty() || before.size() == row.size());
  for (const int shift : {0, 8})
    for (std::size_t i = 0; i < row.size(); ++i)
      bytes_.push_back(static_cast<std::uint8_t>(difference(row, before, i) >> shift));
}

std::uint16_t quantised(float x, float lo, float size) {
  return static_cast<std::uint16_t>(std::lround(65535 * share(x - lo, size)));
}

std::uint8_t packedMagnitude(float x, float most) {
  return static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share(x, most))));
}

std::uint8_t packedSigned(float e, float most) {
  const long size = std::lround(127 * std::sqrt(share(std::abs(e), most)));
  return static_cast<std::uint8_t>(e < 0 ? -size : size);
}

}  // namespace rigel::tools
