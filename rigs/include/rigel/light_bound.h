// How wrong a rig can be about one light: a conservative bound, cheap enough for every light in every frame.
#pragma once

#include <rigel/light.h>
#include <rigel/rig_light.h>

namespace rigel {

/// Irradiance [W/m2] per unit of the light's colour (irradiance, intensity or radiance), largest over the points the
/// rig serves and over all normals.
struct LightBound {
  float error = 0;  // of the rig's SH against the SH of the same bands at each point
  float peak = 0;   // of the light's own irradiance; 0 only where it gives the object nothing at all
};

/// The bounds of one rig in one pose. Made once a frame and object; the light loop allocates nothing.
class LightBounds {
 public:
  /// `wrap` is that of the object's materials (the one with the larger bound where they differ).
  LightBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap = 0) noexcept;

  LightBound operator()(const DirectionalLight& light) const noexcept;
  LightBound operator()(const PointLight& light) const noexcept;
  LightBound operator()(const SpotLight& light) const noexcept;
  LightBound operator()(const SphereLight& light) const noexcept;

 private:
  const Rig* rig_;
  RigFrame worldFromRig_;
  float wrap_;
};

}  // namespace rigel
