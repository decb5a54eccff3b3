// SH irradiance of the light that rigs hold, for any share of it that they leave to exact evaluation.
#pragma once

#include "report/measure/truth.h"

#include <rigel/object_lighting.h>

#include <memory>
#include <mutex>

namespace rigel::tools {

/// What perfect rigs of one number of bands would give at a frame's points. Each light is projected once, however many
/// rigs ask: all lights are summed in double, so that what a near light takes away again leaves nothing behind.
class FarTruth {
 public:
  /// Projects all lights, on all cores. What it is given must outlive the frame.
  void begin(const Truth& truth, const SurfaceSet& surface, const LightSet& lights, int bands);

  /// Irradiance of (1 - weight) of every light, not clamped; without verdicts of all of it. Any number of threads.
  void irradiance(std::span<const LightVerdict> verdicts, std::vector<Rgb>& out);

 private:
  struct Light {
    std::once_flag projected;
    std::vector<Rgb> irradiance;
  };

  std::span<const Rgb> alone(int light);
  Rgb at(int light, std::size_t point) const;

  const Truth* truth_ = nullptr;
  const SurfaceSet* surface_ = nullptr;
  const LightSet* lights_ = nullptr;
  int bands_ = 3;
  std::vector<RgbD> all_;
  std::vector<std::unique_ptr<Light>> single_;
};

}  // namespace rigel::tools
