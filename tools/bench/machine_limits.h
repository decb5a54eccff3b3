// What the machine does at most, for figures to be compared with: measured beside them, in vectors as wide as theirs.
#pragma once

#include <cstddef>
#include <span>

namespace rigel::tools {

/// Runs about `flops` floating-point operations, multiply-adds that wait for nothing, two operations each; how many.
double multiplyAdds(double flops) noexcept;

/// to[i] += scale from[i]: 12 bytes of memory traffic a number where both are larger than the caches.
void addScaled(std::span<const float> from, float scale, std::span<float> to) noexcept;

}  // namespace rigel::tools
