// One frame's time spread over many objects, so that the largest visible error is as small as the time allows.
#pragma once

#include <rigel/object_lighting.h>

namespace rigel {

/// What one object asks of a frame's time, and what it is granted.
struct BudgetShare {
  float wanted = 0;      // its own error target
  float visibility = 1;  // how much its relative error shows: its share of the screen, its distance
  float points = 0;      // shaded in the frame
  float late = 0;        // [us] modelled: what the last frame evaluated beyond its choice, for lights leave gradually

  float granted = 0;       // the target to light it to: `wanted`, or more where something has to be given up
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

/// Share of the time kept for what is late at most: lights leave within a fifth of a second, and errors would rise for
/// nothing where many leave at once.
inline constexpr float kMostLate = 0.25f;

/// Nobody sees less than this: who wants it takes all the time that there is.
inline constexpr float kLeastError = 1e-3f;

/// What it costs [ns a point] to light an object, by its index among the shares, to an error.
struct TargetCost {
  float (*at)(void* context, std::size_t object, float target) = nullptr;
  void* context = nullptr;
};

/// Decides `granted` and `microseconds` of each share. All get the error they want where there is time for it;
/// otherwise the objects whose errors would show least give up first, until what remains shows equally: granted x
/// visibility is the same for all that gave up, and as small as the time allows. What is late is kept free, up to
/// kMostLate of the time. About 20 look-ups of the cost an object.
BudgetOutcome spreadBudget(std::span<BudgetShare> shares, TargetCost cost, float microseconds);

/// Lights `objects` (targets of kind spatialError or totalError) within `microseconds` of modelled shading time:
/// `weigh` for each, spreadBudget, `settle` for each. `visibility`: empty: 1 for all. `shares`: one an object, filled
/// here. Continuous as lights and objects move.
template <int B>
BudgetOutcome lightWithinBudget(std::span<ObjectLighting<B>* const> objects, std::span<const float> visibility,
                                const LightSet& lights, float microseconds, float seconds,
                                std::span<BudgetShare> shares);

}  // namespace rigel
