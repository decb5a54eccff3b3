// A crowd character's near lights: near_far.h for a few slots, and for characters that are not updated in every frame.
#pragma once

#include <rigel/light.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rigel::crowd {

/// A light that is near, as shown: its weight goes from `from` to `to` until the next update.
struct NearSlot {
  std::uint32_t id = 0;
  int light = -1;  // index in the frame of the last update; -1: free
  float from = 0, to = 0;
};

/// What a frame's lights are to a character. Its row of errors is all lights, or those that are listed.
struct NearView {
  const float* errors = nullptr;           // of row i at i * kBlock; 0: does not light it
  std::span<const int> above;              // rows whose error is above the floor
  float floor = 0;                         // F
  const float* shares = nullptr;           // as errors: how much of each row's light is there by itself; null: all
  std::span<const std::uint32_t> listed;   // with shares, the rows' lights, sorted
  const LightSet* lights = nullptr;        // of listed lights
  std::uint32_t groups = kAllLightGroups;  // of the character
  std::span<const std::uint32_t> ids;      // of all lights
  std::span<const std::uint32_t> fresh;    // sorted ids of those of which nothing was in any rig in the last frame
  float step = 1;                          // limit of a weight's movement
  bool cut = false;                        // nothing was shown before
  bool atOnce = true;                      // `from` is not shown
};

/// w = smoothstep(err/F - 1), F = max(tolerance, the error ranked slots + 1); 0 where F = err = 0, 1 where only F is 0.
/// No more than the light's share: what clusters hold of it cannot be taken out of them.
void updateNear(const NearView& view, std::span<NearSlot> slots) noexcept;

/// Where a light is among those that are listed, sorted; -1: nowhere.
std::ptrdiff_t rowOf(std::span<const std::uint32_t> listed, std::uint32_t light) noexcept;

/// Where `id` is among `ids`, looked for at `hint` first; -1: nowhere.
int findLight(std::span<const std::uint32_t> ids, std::uint32_t id, int hint) noexcept;

}  // namespace rigel::crowd
