#include "report/effects.h"

#include <algorithm>

namespace rigel::tools {

std::vector<std::string> effectsOf(const LightSet& lights, std::span<const float> wraps) {
  std::vector<std::string> effects;
  if (lights.directionalCount() > 0) effects.push_back("light.directional");
  if (lights.pointCount() > 0) effects.push_back("light.point");
  if (lights.sphereCount() > 0) effects.push_back("light.sphere");
  if (lights.spotCount() > 0) effects.push_back("light.spot");
  if (std::ranges::any_of(wraps, [](float wrap) { return wrap != 0; })) effects.push_back("material.wrap");
  return effects;
}

}  // namespace rigel::tools
