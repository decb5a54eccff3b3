// The axes of a rig's box.
#pragma once

#include <rigel/rig.h>

#include <algorithm>

namespace rigel {

/// By decreasing extent; ties keep x, y, z.
inline std::array<int, 3> axesByExtent(const RigBox& box) {
  const Vec3 extent = box.hi - box.lo;
  std::array<int, 3> order{0, 1, 2};
  std::ranges::stable_sort(order, [&](int a, int b) { return extent[a] > extent[b]; });
  return order;
}

inline Vec3 unit(int axis) noexcept {
  Vec3 v;
  v[axis] = 1;
  return v;
}

}  // namespace rigel
