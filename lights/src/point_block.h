// Points go through the stages of a kernel in blocks, which between two stages stay in the first-level cache.
#pragma once

#include <cstddef>

namespace rigel {

inline constexpr std::size_t kPointBlock = 64;

/// Points and normals of a block: x, y, z, nx, ny, nz.
struct SurfaceRows {
  const float* row[6];
};

}  // namespace rigel
