// b(p): how strongly the nodes of one lattice axis count at a position.
#pragma once

#include <rigel/rig_spec.h>

#include <array>

namespace rigel {

/// Up to four consecutive nodes from `first`, and their weights (sum 1).
struct AxisWeights {
  int first = 0;
  int count = 1;
  std::array<float, 4> weight{1};
};

/// Weights at u in [-1, 1] (clamped) of `nodes` equidistant nodes, the outermost at -1 and 1.
/// linear: the hat function. smooth: hat through smoothstep, C1, flat at the nodes. cubic: Catmull-Rom, C1, with the
/// missing outer neighbours extrapolated linearly.
AxisWeights axisWeights(LatticeKernel kernel, int nodes, float u) noexcept;

}  // namespace rigel
