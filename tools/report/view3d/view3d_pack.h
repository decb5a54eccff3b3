// Numbers of the 3-D views as bytes that deflate well. The page's view3d_data.js reads what this writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// Rows of small integers, one after another. A row begins with a byte, 0: its numbers are written as differences from
/// the one before, 1: as those from the row before, whichever leaves less. Differences wrap around.
class RowPacker {
 public:
  /// `before`: of the same length, or empty where there is no such row.
  void add(std::span<const std::uint8_t> row, std::span<const std::uint8_t> before = {});
  /// All low bytes of the differences, then all high bytes.
  void add(std::span<const std::uint16_t> row, std::span<const std::uint16_t> before = {});

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Of `x` in [lo, lo + size], to 1/65535 of `size`; what lies outside, or is NaN, at an end.
std::uint16_t quantised(float x, float lo, float size);

/// Square roots keep small values apart: `x` in [0, most] as 0 to 255, `e` in [-most, most] as -127 to 127.
std::uint8_t packedMagnitude(float x, float most);
std::uint8_t packedSigned(float e, float most);

}  // namespace rigel::tools
