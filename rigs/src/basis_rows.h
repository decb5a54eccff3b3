// Basis functions of rigs at many points in vectors: a row a function, a number a point.
#pragma once

#include <cstddef>

namespace rigel::basisrows {

/// out = a b; `out` may be one of them.
void multiply(const float* a, const float* b, std::size_t count, float* out) noexcept;

/// Weights of `nodes` (two or more) equidistant nodes, the outermost at -1 and 1, for linear interpolation at u, which
/// is clamped to [-1, 1]: a row of `count` a node. `smooth`: through smoothstep. Those of axisWeights, to rounding.
void hats(int nodes, bool smooth, const float* u, std::size_t count, float* rows) noexcept;

}  // namespace rigel::basisrows
