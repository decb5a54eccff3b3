#include "report/view3d/view3d_pack.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

namespace rigel::tools {
namespace {

template <class T>
struct Differences {
  std::uint8_t kind;
  std::vector<T> values;
  double size = 0;  // summed magnitudes, as signed numbers
};

template <class T, class Predict>
Differences<T> differences(std::uint8_t kind, std::span<const T> row, const Predict& predict) {
  Differences<T> out{kind, {}};
  for (std::size_t i = 0; i < row.size(); ++i) {
    out.values.push_back(static_cast<T>(row[i] - predict(i)));
    out.size += std::abs(static_cast<double>(static_cast<std::make_signed_t<T>>(out.values.back())));
  }
  return out;
}

template <class T>
Differences<T> least(std::span<const T> row, std::span<const T> before) {
  assert(before.empty() || before.size() == row.size());
  auto along = differences(0, row, [&](std::size_t i) { return i > 0 ? row[i - 1] : T{0}; });
  if (before.empty()) return along;
  auto across = differences(1, row, [&](std::size_t i) { return before[i]; });
  return across.size < along.size ? across : along;
}

/// x / most in [0, 1]; 0 where it has no value.
float share(float x, float most) {
  const float s = x / most;
  return s > 0 ? std::min(s, 1.0f) : 0.0f;
}

}  // namespace

void RowPacker::add(std::span<const std::uint8_t> row, std::span<const std::uint8_t> before) {
  const auto packed = least(row, before);
  bytes_.push_back(packed.kind);
  bytes_.insert(bytes_.end(), packed.values.begin(), packed.values.end());
}

void RowPacker::add(std::span<const std::uint16_t> row, std::span<const std::uint16_t> before) {
  const auto packed = least(row, before);
  bytes_.push_back(packed.kind);
  for (const int shift : {0, 8})
    for (const std::uint16_t value : packed.values) bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
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
