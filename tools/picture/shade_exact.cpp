#include "picture/shade_exact.h"

#include "parallel/parallel.h"

#include <rigel/exact.h>

#include <algorithm>
#include <cassert>

namespace rigel::tools {

std::vector<Rgb> exactIrradiance(const VisibleSurface& surface, const LightSet& lights) {
  constexpr std::size_t kBlock = 1024;
  const std::size_t count = surface.samples.size();
  std::vector<Rgb> out(count);
  parallelFor(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
    const std::size_t begin = static_cast<std::size_t>(block) * kBlock, end = std::min(count, begin + kBlock);
    for (std::size_t i = begin; i < end; ++i) {
      const VisibleSample& s = surface.samples[i];
      if (s.kind == SampleKind::light) continue;
      const RgbD e = rigel::exactIrradiance(lights, s.position, s.normal, s.wrap);
      out[i] = {static_cast<float>(e.r), static_cast<float>(e.g), static_cast<float>(e.b)};
    }
  });
  return out;
}

std::vector<Rgb> shade(const VisibleSurface& surface, std::span<const Rgb> irradiance, float lightScale) {
  assert(irradiance.size() == surface.samples.size());
  std::vector<Rgb> out(irradiance.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const VisibleSample& sample = surface.samples[i];
    const float scale = sample.kind == SampleKind::scenery ? kSceneryDimming
                        : sample.kind == SampleKind::light ? lightScale
                                                           : 1.0f;
    out[i] = outgoingRadiance(sample, irradiance[i]) * scale;
  }
  return out;
}

}  // namespace rigel::tools
