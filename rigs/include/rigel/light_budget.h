// One frame's time spread over many objects, so that the largest visible error is as small as the time allows.
#pragma once

#include <rigel/object_lighting.h>

namespace rigel {

/// What one object was granted in a frame.
struct BudgetShare {
  float wanted = 0;        // its own error target (options().target.value)
  float granted = 0;       // the target it was lit to: `wanted`, or more where something had to be given up
  float microseconds = 0;  // modelled: points x ns a point

  bool gaveUp() const noexcept { return granted > wanted; }
};

struct BudgetOutcome {
  float largestError = 0;  // common to the objects that gave up: granted error x visibility; 0 where none did
  float microseconds = 0;  // modelled, of all objects
  bool met = false;        // microseconds <= the budget; otherwise even kGiveUpError costs more
};

/// The error at which nothing more is saved by giving up: the lighting is unrecognisable.
inline constexpr float kGiveUpError = 2;

/// Lights `objects` (targets of kind spatialError or totalError) within `microseconds` of modelled shading time. All
/// get the error they want where there is time for it; otherwise the objects whose errors would show least give up
/// first, until what remains shows equally: granted x visibility is the same for all that gave up. `visibility`: how
/// much an object's relative error shows (its share of the screen, its distance); empty: 1 for all. `shares`: one an
/// object. Continuous as lights and objects move. Cost: one `weigh` and `settle` an object, and about 40 table
/// look-ups.
template <int B>
BudgetOutcome lightWithinBudget(std::span<ObjectLighting<B>* const> objects, std::span<const float> visibility,
                                const LightSet& lights, float microseconds, float seconds,
                                std::span<BudgetShare> shares);

}  // namespace rigel
