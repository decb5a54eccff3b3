// Which lights leave the rig and are evaluated exactly, how much of each, and in which slot: continuous in the geometry.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace rigel {

inline constexpr int kMaxNearLights = 64;

struct NearFarOptions {
  int slots = 2;           // near lights at most, fading ones included; <= kMaxNearLights
  float tolerance = 0;     // [W/m2] a light whose error is below it stays in the rig
  float weightRate = 20;   // [1/s] limit of a weight's movement, for lights switched on or off and for objects that jump
};

/// Weight w of each light: the share w is evaluated exactly, 1 - w stays in the rig. w = smoothstep(err/F - 1),
/// F = max(tolerance, err of the light ranked slots + 1), and 0 where F = err = 0. Keeps, from frame to frame, the
/// weights (for their rate limit) and the slot of each near light; everything else depends on the present alone.
class NearFar {
 public:
  explicit NearFar(const NearFarOptions& options = {});

  /// After a cut or a teleport: the next update takes its weights at once.
  void reset() noexcept;

  /// `errors`: per light, of leaving it in the rig [W/m2]. `ids` name the lights from frame to frame; empty: by index.
  /// `seconds` since the last update. Allocates only while it grows.
  void update(std::span<const float> errors, std::span<const std::uint32_t> ids, float seconds);

  /// The same bookkeeping for weights that were found elsewhere (`auto` rigs).
  void follow(std::span<const float> weights, std::span<const std::uint32_t> ids, float seconds);

  std::span<const float> weights() const noexcept;  // per light, of the last update
  std::span<const int> slots() const noexcept;      // light in each slot, or -1; a light keeps its slot while w > 0
};

}  // namespace rigel
