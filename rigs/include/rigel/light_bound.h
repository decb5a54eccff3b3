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

namespace detail {

/// What the bounds need of the wrap; light_field.h explains.
struct WrapField {
  double s0 = 0, s1 = 0, s2 = 0;
  double across = 0;
  double lobe = 0;
  double inside = 0;
  double fullSphere = 0;
};

/// What the bounds need of a rig in a pose.
struct BoundPlan {
  enum class Kind { tensor, ball, surface };
  struct Axis {
    double half = 0;      // of the box
    double node = 0;      // of the box of the rig's own samples
    double first = 0;     // error per largest slope along the axis ...
    double second = 0;    // ... and per largest curvature
    double gradient = 0;  // half extent, where the axis is modelled by a slope
  };
  Kind kind = Kind::tensor;
  std::array<Axis, 3> axis;
  std::array<double, 3> centre{};
  double radius = 0;      // of a ball about the centre that holds all points served
  double lebesgue = 1;    // largest sum of |weights| of the samples, slopes apart
  bool numeric = false;   // slopes are secants
  bool constant = false;  // no slope, no lattice: one value
};

}  // namespace detail

/// The bounds of one rig in one pose. Made once a frame and object; the light loop allocates nothing.
class LightBounds {
 public:
  /// `wrap` is that of the object's materials (the one with the larger bound where they differ). `radius` [m]: of a
  /// ball about the box's centre that holds the object, where one smaller than the box's own is known.
  LightBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap = 0, float radius = kNoRange) noexcept;

  LightBound operator()(const DirectionalLight& light) const noexcept;
  LightBound operator()(const PointLight& light) const noexcept;
  LightBound operator()(const SpotLight& light) const noexcept;
  LightBound operator()(const SphereLight& light) const noexcept;

 private:
  RigFrame worldFromRig_;
  detail::WrapField wrap_;
  detail::BoundPlan plan_;
};

}  // namespace rigel
