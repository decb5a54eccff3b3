#include "report/run/effects.h"

#include <rigel/effects.h>

#include <algorithm>
#include <cassert>

namespace rigel::tools {
namespace {

/// Reports know near lights by the name of their kind alone.
Effect nearEffect(const std::string& kind) {
  const auto* effect = std::ranges::find(kAllEffects, "light.near." + kind, effectName);
  assert(effect != std::end(kAllEffects));
  return *effect;
}

}  // namespace

std::vector<std::string> effectsOf(const LightSet& lights, std::span<const float> wraps, std::span<const RigSpec> rigs,
                                   std::span<const ObjectReport> objects) {
  Effects effects = lightEffects(lights);
  if (std::ranges::any_of(wraps, [](float wrap) { return wrap != 0; })) effects.add(Effect::material_wrap);
  if (std::ranges::any_of(rigs, &RigSpec::adaptive)) effects.add(Effect::rig_auto);
  for (const ObjectReport& object : objects) {
    for (const RigReport& rig : object.rigs) {
      if (rig.highBandFrames > 0) effects.add(Effect::rig_highBand);
      for (const LightReport& light : rig.lights)
        if (!light.weights.empty()) effects.add(nearEffect(light.type));
    }
  }
  if (effects.hasAny(kNearEffects) && effects.has(Effect::material_wrap)) effects.add(Effect::light_near_wrap);
  if (effects.has(Effect::light_near_disk) && effects.has(Effect::light_near_wrap)) effects.add(kWrappedDisk);

  std::vector<std::string> names;
  for (const Effect effect : kAllEffects)
    if (effects.has(effect)) names.push_back(effectName(effect));
  std::ranges::sort(names);
  return names;
}

}  // namespace rigel::tools
