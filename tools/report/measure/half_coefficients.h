// A fitted rig whose coefficients have been through half floats, as shaders read them (gpu_rig.h).
#pragma once

#include <rigel/object_lighting.h>

#include <vector>

namespace rigel::tools {

/// Irradiance of a constant high band alone.
Rgb highBandIrradiance(const HighBand& high, Vec3 normal, float wrap);

template <int B>
class HalfCoefficients {
 public:
  /// The rig must outlive it, and keep its pose.
  HalfCoefficients(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                   const HighBand& high);

  /// Irradiance at a world point, not clamped, without near lights.
  Rgb shade(Vec3 point, Vec3 normal, float wrap) const;

 private:
  const Rig* rig_;
  RigFrame frame_;
  std::vector<RadianceSH<B>> coefficients_;  // all that the rig may use: those not in use are 0
  HighBand high_;
};

}  // namespace rigel::tools
