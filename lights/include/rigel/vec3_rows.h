// Many points or directions as the vector kernels take them.
#pragma once

#include <cstddef>
#include <span>

namespace rigel {

/// Points or unit vectors, structure of arrays: three spans of one length, of any alignment.
struct Vec3Rows {
  std::span<const float> x, y, z;
  std::size_t size() const noexcept { return x.size(); }
  Vec3Rows subrows(std::size_t first, std::size_t count) const noexcept {
    return {x.subspan(first, count), y.subspan(first, count), z.subspan(first, count)};
  }
};

}  // namespace rigel
