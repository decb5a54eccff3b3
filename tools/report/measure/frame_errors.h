// How wrong a rig is in one frame, at the points where it is measured.
#pragma once

#include "report/measure/rig_runner.h"

namespace rigel::tools {

/// Sums over samples and channels [W/m2]^2, and largest [W/m2].
struct FrameErrors {
  double spatialSquares = 0, totalSquares = 0;
  double spatialMax = 0, totalMax = 0;
  bool highBand = false;  // the rig held light beyond its own bands
};

/// Of `shaded`, which `rig` gave at the truth's points with their wraps. `sh`: what a perfect rig of the same bands and
/// far shares gives there. `total`, where it has room for them, takes the points' own errors: clamped rig + near lights
/// - exact.
FrameErrors frameErrors(const RigRunner& rig, std::span<const RigRunner::Shaded> shaded, const Truth& truth,
                        std::span<const Rgb> sh, std::span<const float> wrap, std::span<Rgb> total = {});

}  // namespace rigel::tools
