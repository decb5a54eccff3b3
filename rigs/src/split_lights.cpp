#include <rigel/near_far.h>

#include <algorithm>
#include <cassert>

namespace rigel {
namespace {

template <class Light>
Light scaled(Light light, float s) noexcept {
  colourOf(light) = colourOf(light) * s;
  return light;
}

}  // namespace

void splitLights(const LightSet& lights, std::span<const float> weights, LightSet& inRig, std::vector<NearLight>& exact,
                 std::span<const std::uint8_t> culled) {
  assert(weights.size() == static_cast<std::size_t>(lights.size()));
  assert(culled.empty() || culled.size() == weights.size());
  inRig.clear();
  exact.clear();
  for (int i = 0; i < lights.size(); ++i) {
    if (!culled.empty() && culled[i]) continue;
    const float w = weights[i] > 0 ? std::min(weights[i], 1.0f) : 0.0f;
    lights.visit(i, [&](const auto& light) {
      if (colourOf(light) == Rgb{}) return;
      if (w > 0) exact.push_back(nearLight(light, w));
      if (w == 0) inRig.add(light, lights.groups(i));
      if (w > 0 && w < 1) inRig.add(scaled(light, 1 - w), lights.groups(i));
    });
  }
}

}  // namespace rigel
