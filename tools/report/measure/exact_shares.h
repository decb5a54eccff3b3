// What the near and far shares of a frame's lights are in double, for the parts of the error.
#pragma once

#include "report/measure/truth.h"

#include <rigel/object_lighting.h>

#include <vector>

namespace rigel::tools {

/// Like FarTruth, each light once for all rigs; of lights that are near, one by one, when first asked for.
class ExactShares {
 public:
  /// Uses all cores. What it is given must outlive the frame.
  void begin(const Truth& truth, const SurfaceSet& surface, const LightSet& lights, int bands);

  /// Exact irradiance of the near shares, `weight` of every light.
  void near(std::span<const LightVerdict> verdicts, std::vector<RgbD>& out);

  /// Irradiance of the first bands of the far shares, 1 - weight of every light, not clamped.
  void farBands(std::span<const LightVerdict> verdicts, std::vector<RgbD>& out);

 private:
  struct Light {
    std::vector<RgbD> exact, bands;  // empty until asked for
  };
  const Light& alone(std::size_t light);

  const Truth* truth_ = nullptr;
  const SurfaceSet* surface_ = nullptr;
  const LightSet* lights_ = nullptr;
  int bands_ = 3;
  std::vector<RgbD> all_;  // the bands of all light
  std::vector<Light> single_;
};

}  // namespace rigel::tools
