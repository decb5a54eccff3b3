// A fitted rig with its arithmetic in double: what rounding in the fit and in evaluation costs is the difference.
#pragma once

#include <rigel/object_lighting.h>

#include <vector>

namespace rigel::tools {

template <int B>
class DoubleRig {
 public:
  /// Fits in double to the float functionals of the far shares of `lights`, with the rig's own operator (in float, as
  /// it has it). `verdicts` may be empty: all light is far. The rig must outlive it, and keep its pose and falloff.
  static DoubleRig fitted(const Rig& rig, const RigFrame& worldFromRig, const LightSet& lights,
                          std::span<const LightVerdict> verdicts);

  /// Takes coefficients as they are, for rigs that are not fitted by Rig::fit (`auto`): evaluation alone is in double.
  static DoubleRig widened(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients);

  /// Irradiance at a world point, not clamped. Basis functions are the rig's, in float.
  RgbD shade(Vec3 point, Vec3 normal, float wrap) const;

 private:
  using Coefficients = std::array<RgbD, shCount(B)>;
  DoubleRig(const Rig& rig, const RigFrame& frame, std::size_t vectors) : rig_(&rig), frame_(frame), c_(vectors) {}

  const Rig* rig_;
  RigFrame frame_;
  std::vector<Coefficients> c_;  // as many as are in use
};

}  // namespace rigel::tools
