// How a rig's errors are distributed: over their sizes, and over the points of the surface.
#pragma once

#include "report/error_breakdown.h"
#include "report/measure/body_parts.h"

#include <rigel/vec3.h>

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace rigel::tools {

class ErrorSpread {
 public:
  /// Signed errors of one frame at the points [W/m2]; as many each time.
  void add(std::span<const Rgb> errors);

  /// Relative to `meanIrradiance`, which must not be 0.
  ErrorHistogram histogram(double meanIrradiance) const;
  std::vector<BodyPartErrors> bodyParts(const BodyParts& parts, double meanIrradiance) const;

 private:
  struct Point {
    double sum = 0, squares = 0, largest = 0;
  };

  // A float's upper half is a scale of its own: sign, exponent, and 128 equal steps in every octave. Counted so, errors
  // find their bins when the mean that they are relative to is known. By sign and exponent; those that occur.
  static constexpr std::uint32_t kSteps = 128;
  using Octave = std::array<std::uint32_t, kSteps>;
  std::map<std::uint32_t, Octave> counts_;
  std::vector<Point> points_;
  std::size_t frames_ = 0;
};

}  // namespace rigel::tools
