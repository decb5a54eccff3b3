// By how much windows, cones and emission cosines can dim the lights of a cluster, anywhere in a ball.
#pragma once

#include <rigel/light.h>

#include <cstdint>

namespace rigel {

/// What one light, or a cluster of lights, is dimmed by: full (1) and none (0) included.
struct LightModulation {
  enum Kind : std::uint8_t { kPlain = 1, kSpot = 2, kOneSided = 4, kTwoSided = 8 };
  float x = 0, y = 0, z = 0;             // axis of the cone that holds all axes ...
  float cosSpread = 1, sinSpread = 0;    // ... and its half-angle
  float leastOuter = 1, mostOuter = -1;  // cosines of the spots' cones
  float leastInner = 1, mostInner = -1;
  float leastRange = kNoRange, mostRange = 0;
  std::uint8_t kinds = 0;  // of the lights within; 0: none
};

/// Holds the lights of both.
LightModulation merged(const LightModulation& a, const LightModulation& b) noexcept;

struct DimmingRange {
  float least = 1, most = 1;
};

/// Least and most of the lights' dimming where light and receiver are closer than `reach` to two points that are
/// `between` [m], from the lights to the receivers, apart; `distance` its length.
DimmingRange dimming(const LightModulation& lights, Vec3 between, float distance, float reach) noexcept;

}  // namespace rigel
