// The one sentence an artist takes from a measurement: which rig to use for this object.
#pragma once

#include "report/report_data.h"

#include <cstddef>
#include <optional>
#include <string>

namespace rigel::tools {

/// How much worse than the best total RMS the chosen rig may be. Below this a difference is not seen in a picture:
/// the light that the SH bands themselves leave out is several times larger.
inline constexpr double kVerdictSlack = 0.10;

/// Least total RMS above which no rig is advised: an error of a quarter of the mean light is plain at a glance.
inline constexpr double kUsableError = 0.25;

struct Verdict {
  std::size_t best = 0;  // index of the rig of least total RMS
  /// Cheapest within kVerdictSlack of it: fewest SH vectors (where lights are near: least modelled time a point), then
  /// projections, then error.
  std::size_t chosen = 0;
  bool advised = false;  // whether `chosen` is good enough; where it is not, it is `best`
  std::string sentence;
};

/// Nothing to say where no rig was measured.
std::optional<Verdict> verdictOf(const ObjectReport& object);

}  // namespace rigel::tools
