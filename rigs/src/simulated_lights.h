// Lights to try a rig on before there are any.
#pragma once

#include "model.h"

#include <rigel/project.h>

namespace rigel {

/// Forty sphere lights around an object in its rest pose, eight each at 0.06 to 3 of its sizes from the surface, evenly
/// spread over surface and directions: the same for every rig of the object.
class SimulatedLights {
 public:
  /// Cost: lights x (at most 128 points of the surface) projections; allocates.
  explicit SimulatedLights(const RigShape& rest);

  /// How wrong a rig is about them: RMS over the surface against the lights' own SH, relative to the light's mean, as a
  /// geometric mean over lights, so that near and far count alike. Not a number where the shape leaves no light to
  /// compare. `model` is in its rest pose; an `invquad` rig keeps the falloff of the last light. Cost: lights x
  /// (samples projections + points evaluations), about 1 ms for `poly:12`.
  double error(Rig::Model& model) const;

 private:
  static constexpr int kBands = 3;
  static constexpr int kWidth = shCount(kBands);
  using Row = std::array<float, kWidth>;

  struct Light {
    SphereLight light;
    float mean = 0;  // L_00 over the points
    std::vector<Row> truth;
  };
  static Row project(const SphereLight& light, Vec3 p, float footprint);

  std::vector<Vec3> points_;
  std::vector<Light> lights_;
};

}  // namespace rigel
