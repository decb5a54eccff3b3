// Splits the errors of a rig into their causes, sample by sample.
#pragma once

#include "report/error_breakdown.h"
#include "report/measure/rig_runner.h"

namespace rigel::tools {

/// Irradiance of one frame at the points where errors are measured, from the truth to the rig. None is clamped.
struct ErrorSteps {
  std::span<const RgbD> exact;                // all light
  std::span<const RgbD> nearExact;            // near shares, exact
  std::span<const RgbD> farBands;             // far shares, SH of each point in double
  std::span<const Rgb> farSh;                 // far shares, SH of each point as the runtime projects them
  std::span<const RgbD> rig;                  // the rig in double, without high band
  std::span<const Rgb> highBand;              // empty where the rig has none
  std::span<const RigRunner::Shaded> shaded;  // what is shown
};

/// The error is the sum of five steps d at every sample and channel (README.md), so that its square is the sum of all
/// products d_j d_k: those sums are all it keeps.
class PartsTally {
 public:
  void add(const ErrorSteps& steps);

  /// Relative to `meanIrradiance`, which must not be 0.
  ErrorParts report(double meanIrradiance) const;

 private:
  std::array<std::array<double, kErrorCauses>, kErrorCauses> products_{};  // upper triangle
  double total_ = 0, unclamped_ = 0;
  std::size_t count_ = 0;
};

}  // namespace rigel::tools
