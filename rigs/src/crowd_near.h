// A crowd character's near lights: near_far.h for a few slots, and for characters that are not updated in every frame.
#pragma once

#include <cstdint>
#include <span>

namespace rigel::crowd {

/// A light that is near, as shown: its weight goes from `from` to `to` until the next update.
struct NearSlot {
  std::uint32_t id = 0;
  int light = -1;  // index in the frame of the last update; -1: free
  float from = 0, to = 0;
};

/// What a frame's lights are to a character.
struct NearView {
  const float* errors = nullptr;        // of light i at i * kBlock; 0: does not light it
  std::span<const int> above;           // lights whose error is above the floor
  float floor = 0;                      // F
  std::span<const std::uint32_t> ids;   // of the lights
  std::span<const std::uint8_t> fresh;  // lights of which nothing was in any rig in the last frame
  float step = 1;                       // limit of a weight's movement
  bool cut = false;                     // nothing was shown before
  bool atOnce = true;                   // `from` is not shown
};

/// w = smoothstep(err/F - 1), F = max(tolerance, the error ranked slots + 1); 0 where F = err = 0, 1 where only F is 0.
void updateNear(const NearView& view, std::span<NearSlot> slots) noexcept;

/// Where `id` is among `ids`, looked for at `hint` first; -1: nowhere.
int findLight(std::span<const std::uint32_t> ids, std::uint32_t id, int hint) noexcept;

}  // namespace rigel::crowd
