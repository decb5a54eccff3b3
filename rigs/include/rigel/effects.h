// Which effects a scene and a frame call for. What is not in the set is neither loaded, compiled nor computed: it
// selects CPU stages and, by its ids, the shaders' specialisation (shader_effects.h has the list).
#pragma once

#include <rigel/near_light.h>
#include <rigel/object_lighting.h>
#include <rigel/shader_effects.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

namespace rigel {

enum class Effect : std::uint8_t {
#define RIGEL_EFFECT(name, id) name = id,
  RIGEL_EFFECTS(RIGEL_EFFECT)
#undef RIGEL_EFFECT
};

/// All effects, in the order of their ids.
inline constexpr Effect kAllEffects[] = {
#define RIGEL_EFFECT(name, id) Effect::name,
    RIGEL_EFFECTS(RIGEL_EFFECT)
#undef RIGEL_EFFECT
};

/// "light.near.sphere". Allocates.
std::string effectName(Effect effect);

/// A set of effects.
class Effects {
 public:
  constexpr Effects() noexcept = default;
  constexpr Effects(std::initializer_list<Effect> all) noexcept {
    for (Effect effect : all) add(effect);
  }
  constexpr void add(Effect effect) noexcept { bits_ |= bit(effect); }
  constexpr void add(Effects other) noexcept { bits_ |= other.bits_; }
  constexpr void remove(Effect effect) noexcept { bits_ &= ~bit(effect); }
  constexpr bool has(Effect effect) const noexcept { return (bits_ & bit(effect)) != 0; }
  constexpr bool hasAny(Effects other) const noexcept { return (bits_ & other.bits_) != 0; }
  constexpr bool empty() const noexcept { return bits_ == 0; }
  constexpr std::uint64_t bits() const noexcept { return bits_; }
  friend constexpr bool operator==(Effects, Effects) = default;

 private:
  static constexpr std::uint64_t bit(Effect effect) noexcept { return std::uint64_t{1} << static_cast<int>(effect); }
  std::uint64_t bits_ = 0;
};

/// Everything near: what a frame without near lights lacks.
inline constexpr Effects kNearEffects{Effect::light_near_directional, Effect::light_near_point,
                                      Effect::light_near_spot,        Effect::light_near_sphere,
                                      Effect::light_near_wrap,        Effect::light_near_disk,
                                      Effect::light_near_diskTable,   Effect::light_near_diskQuadrature};

/// What shaders take the bands of a near disk from where the material wraps: light_near_diskTable or
/// light_near_diskQuadrature. This one is the faster (shaders/README.md).
inline constexpr Effect kWrappedDisk = Effect::light_near_diskQuadrature;

/// The kinds of light that the set holds.
Effects lightEffects(const LightSet& lights) noexcept;

/// The kinds of near light with a share above 0, and their wrap where the material has one: of disks by kWrappedDisk.
Effects nearEffects(std::span<const NearLight> lights, float wrap) noexcept;

/// What the rig's family calls for, `auto` and its choice aside.
Effects rigEffects(const RigSpec& spec) noexcept;

/// What shading an object of this wrap calls for in a frame: rig, high band, near lights. A rig without SH vectors in
/// the frame (only near lights) calls for none.
template <int B>
Effects frameEffects(const ObjectLighting<B>& lighting, float wrap) noexcept {
  Effects effects = nearEffects(lighting.nearLights(), wrap);
  if (!lighting.coefficients().empty()) effects.add(rigEffects(lighting.rig().spec()));
  if (lighting.highBand().band > 0) effects.add(Effect::rig_highBand);
  const bool shaded = !lighting.coefficients().empty() || lighting.highBand().band > 0;
  if (shaded && wrap != 0) effects.add(Effect::material_wrap);
  return effects;
}

/// The stages of a frame that some effect or wish calls for: a stage that ran without being called for is a defect.
/// `wanted` are the options of the object's lighting.
bool callsFor(LightingStage stage, Effects effects, const LightingOptions& wanted) noexcept;

}  // namespace rigel
