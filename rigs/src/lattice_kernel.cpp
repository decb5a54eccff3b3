#include "lattice_kernel.h"

#include <rigel/shader_lattice.h>

#include <algorithm>

namespace rigel {
namespace {

/// Catmull-Rom between nodes `cell` and `cell + 1` at t in [0, 1]. An outer neighbour that does not exist is
/// 2 p0 - p1 (or 2 p1 - p0): its weight goes to the two inner nodes.
AxisWeights catmullRom(int cell, int nodes, float t) noexcept {
  using namespace detail;
  const std::array<float, 4> w{latticeOuter(t), latticeInner(t), latticeInner(1 - t), latticeOuter(1 - t)};
  AxisWeights out{cell - 1, 4, w};
  if (cell + 2 >= nodes) {
    out.weight[2] += 2 * w[3];
    out.weight[1] -= w[3];
    out.count = 3;
  }
  if (cell == 0) {
    out.weight[1] += 2 * w[0];
    out.weight[2] -= w[0];
    out.first = 0;
    --out.count;
    std::shift_left(out.weight.begin(), out.weight.end(), 1);
  }
  return out;
}

}  // namespace

AxisWeights axisWeights(LatticeKernel kernel, int nodes, float u) noexcept {
  if (nodes == 1) return {};
  const float x = (std::clamp(u, -1.0f, 1.0f) + 1) * 0.5f * static_cast<float>(nodes - 1);
  const int cell = std::min(static_cast<int>(x), nodes - 2);
  float t = x - static_cast<float>(cell);
  if (kernel == LatticeKernel::cubic) return catmullRom(cell, nodes, t);
  if (kernel == LatticeKernel::smooth) t = detail::latticeSmooth(t);
  return {cell, 2, {1 - t, t}};
}

}  // namespace rigel
