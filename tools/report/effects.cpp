#include "report/effects.h"

#include <algorithm>
#include <set>

namespace rigel::tools {

std::vector<std::string> effectsOf(const LightSet& lights, std::span<const float> wraps, std::span<const RigSpec> rigs,
                                   std::span<const ObjectReport> objects) {
  std::set<std::string> effects;
  if (lights.directionalCount() > 0) effects.insert("light.directional");
  if (lights.pointCount() > 0) effects.insert("light.point");
  if (lights.sphereCount() > 0) effects.insert("light.sphere");
  if (lights.spotCount() > 0) effects.insert("light.spot");
  const bool wrapped = std::ranges::any_of(wraps, [](float wrap) { return wrap != 0; });
  if (wrapped) effects.insert("material.wrap");
  if (std::ranges::any_of(rigs, &RigSpec::adaptive)) effects.insert("rig.auto");
  for (const ObjectReport& object : objects) {
    for (const RigReport& rig : object.rigs) {
      if (rig.highBandFrames > 0) effects.insert("rig.high_band");
      for (const LightUse& light : rig.lights) {
        if (light.weights.empty()) continue;
        effects.insert("light.near." + light.type);
        if (wrapped) effects.insert("light.near.wrap");
      }
    }
  }
  return {effects.begin(), effects.end()};
}

}  // namespace rigel::tools
