#include "report/measure/frame_errors.h"

#include <cassert>
#include <cmath>

namespace rigel::tools {

FrameErrors frameErrors(const RigRunner& rig, std::span<const RigRunner::Shaded> shaded, const Truth& truth,
                        std::span<const Rgb> sh, std::span<const float> wrap, std::span<Rgb> total) {
  assert(total.empty() || total.size() == shaded.size());
  FrameErrors errors;
  const bool highBand = rig.hasHighBand();
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    Rgb beside = shaded[i].rig - sh[i];
    if (highBand) {
      const Rgb high = rig.highBand(truth.points[i].normal, wrap[i]);
      errors.highBand = errors.highBand || high.r != 0 || high.g != 0 || high.b != 0;
      beside = beside - high;
    }
    const Rgb clamped = shaded[i].clamped();
    for (int c = 0; c < 3; ++c) {
      const double spatial = static_cast<double>(beside[c]);
      const double seen = static_cast<double>(clamped[c]) - truth.exact[i][c];
      errors.spatialSquares += spatial * spatial;
      errors.totalSquares += seen * seen;
      errors.spatialMax = std::max(errors.spatialMax, std::abs(spatial));
      errors.totalMax = std::max(errors.totalMax, std::abs(seen));
      if (!total.empty()) total[i][c] = static_cast<float>(seen);
    }
  }
  return errors;
}

}  // namespace rigel::tools
