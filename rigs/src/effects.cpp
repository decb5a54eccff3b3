#include <rigel/effects.h>

#include <cctype>

namespace rigel {

std::string effectName(Effect effect) {
  const char* identifier = "";
  switch (effect) {
#define RIGEL_EFFECT(name, id) \
  case Effect::name:           \
    identifier = #name;        \
    break;
    RIGEL_EFFECTS(RIGEL_EFFECT)
#undef RIGEL_EFFECT
  }
  std::string text;
  for (const char* c = identifier; *c != 0; ++c) {
    if (std::isupper(static_cast<unsigned char>(*c)) != 0) text += '_';
    text += *c == '_' ? '.' : static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
  }
  return text;
}

Effects lightEffects(const LightSet& lights) noexcept {
  Effects effects;
  if (lights.directionalCount() > 0) effects.add(Effect::light_directional);
  if (lights.pointCount() > 0) effects.add(Effect::light_point);
  if (lights.spotCount() > 0) effects.add(Effect::light_spot);
  if (lights.sphereCount() > 0) effects.add(Effect::light_sphere);
  if (lights.diskCount() > 0) effects.add(Effect::light_disk);
  return effects;
}

Effects nearEffects(std::span<const NearLight> lights, float wrap) noexcept {
  Effects effects;
  for (const NearLight& light : lights) {
    if (!(light.share > 0)) continue;
    switch (light.kind) {
      case NearLight::Kind::directional:
        effects.add(Effect::light_near_directional);
        break;
      case NearLight::Kind::point:
        effects.add(Effect::light_near_point);
        break;
      case NearLight::Kind::spot:
        effects.add(Effect::light_near_spot);
        break;
      case NearLight::Kind::sphere:
        effects.add(Effect::light_near_sphere);
        break;
      case NearLight::Kind::disk:
        effects.add(Effect::light_near_disk);
        break;
    }
  }
  if (!effects.empty() && wrap != 0) effects.add(Effect::light_near_wrap);
  if (effects.has(Effect::light_near_disk) && wrap != 0) effects.add(kWrappedDisk);
  return effects;
}

Effects rigEffects(const RigSpec& spec) noexcept {
  if (spec.family == RigSpec::Family::poly) {
    Effects effects;
    if (spec.adaptive) effects.add(Effect::rig_auto);
    effects.add(spec.falloff ? Effect::rig_invquad : Effect::rig_poly);
    return effects;
  }
  if (spec.family == RigSpec::Family::rbf) return {Effect::rig_rbf};
  if (spec.family == RigSpec::Family::latticegrad) return {Effect::rig_latticegrad};
  if (spec.family == RigSpec::Family::hermite) return {Effect::rig_hermite};
  if (spec.shVectors() == 1) return {Effect::rig_constant};
  if (spec.fit == FitMethod::gauss) return {Effect::rig_tensor, Effect::rig_gauss};
  return {Effect::rig_tensor};
}

bool callsFor(LightingStage stage, Effects effects, const LightingOptions& wanted) noexcept {
  const bool chooses = wanted.target.kind != LightingTarget::Kind::none;
  switch (stage) {
    case LightingStage::bound:
      return chooses || wanted.slots() > 0 || wanted.estimate;
    case LightingStage::choose:
      return chooses || wanted.slots() > 0;
    case LightingStage::estimate:
      return wanted.estimate && !chooses;  // who chooses has the estimate from its choice
    case LightingStage::project:
    case LightingStage::fit:
      return chooses || effects.hasAny({Effect::rig_auto, Effect::rig_constant, Effect::rig_poly, Effect::rig_invquad,
                                        Effect::rig_tensor, Effect::rig_texture, Effect::rig_rbf,
                                        Effect::rig_latticegrad, Effect::rig_hermite});
  }
  return false;
}

}  // namespace rigel
