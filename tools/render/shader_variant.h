// What a pipeline that lights an object is specialised to: its effects, and the make of its rig.
#pragma once

#include "gpu/shader.h"
#include "report/measure/rig_runner.h"

#include <rigel/effects.h>

#include <string>
#include <vector>

namespace rigel::tools {

/// The effects that are a matter of shaders; the others call for CPU stages alone.
inline constexpr Effects kShaderEffects{Effect::light_near_directional,
                                        Effect::light_near_point,
                                        Effect::light_near_spot,
                                        Effect::light_near_sphere,
                                        Effect::light_near_wrap,
                                        Effect::light_near_disk,
                                        Effect::light_near_diskTable,
                                        Effect::light_near_diskQuadrature,
                                        Effect::material_wrap,
                                        Effect::rig_constant,
                                        Effect::rig_poly,
                                        Effect::rig_invquad,
                                        Effect::rig_tensor,
                                        Effect::rig_gauss,
                                        Effect::rig_texture,
                                        Effect::rig_highBand};

struct ShaderVariant {
  int bands = 3;
  Effects effects;  // among kShaderEffects
  int vectors = 0;  // K where it is the same in every frame, else 0
  std::array<int, 3> nodes{0, 1, 1}, slope{};
  int perNode = 1, kernel = 0;
  bool termsKnown = false;
  std::array<int, 6> terms{};
  int loop = 0;  // over up to 24 or 56 monomials; 0: unrolled

  friend bool operator==(const ShaderVariant&, const ShaderVariant&) = default;

  /// "object.frag" and such, by the name of its binary.
  std::string binary(const std::string& entry) const;
  std::vector<ShaderConstant> constants() const;
};

/// What lights the rig of a frame: `packed` as its shader reads it, `effects` of RigRunner::effects. A near light more
/// or less changes nothing: the variant has all `nearKinds` of the scene, or none.
ShaderVariant variantOf(const RigRunner& runner, const GpuRig& packed, Effects effects, Effects nearKinds);

/// The near effects that lights of these kinds (lightEffects) may come to call for; disks on materials that wrap by
/// `wrappedDisk`.
Effects nearKindsOf(Effects lightKinds, float wrap, Effect wrappedDisk = kWrappedDisk);

/// Every variant that frames to come may want: with near lights and without, with a high band and without.
/// `nearKinds` as nearKindsOf gives them for `wrap`.
std::vector<ShaderVariant> possibleVariants(const RigRunner& runner, const GpuRig& packed, float wrap,
                                            Effects nearKinds);

/// Something lit by near lights alone.
ShaderVariant nearVariant(int bands, Effects nearKinds);

}  // namespace rigel::tools
