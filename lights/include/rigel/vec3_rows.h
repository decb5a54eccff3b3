// Many points or directions as the vector kernels take them.
#pragma once

#include <cstddef>
#include <span>

namespace rigel {

/// Points or unit vectors, structure of arrays: three spans of one length, of any alignment.
struct Vec3Rows {
  std::span<const float> x, y, z;
  std::size_t size() const noexcept { return x.size(); }
};

}  // namespace rigel
