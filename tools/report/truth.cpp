#include "report/truth.h"

#include "picture/parallel.h"

#include <algorithm>

namespace rigel::tools {
namespace {

// Enough samples a block that handing it out costs nothing, few enough that the last block is short.
constexpr std::size_t kBlock = 64;

}  // namespace

void Truth::update(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface,
                   const LightSet& lights, int bands) {
  const std::size_t count = surface.measured.size();
  points.resize(count);
  exact.resize(count);
  sh.resize(count);
  withBands(bands, [&]<int B>() {
    parallelFor(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
      const std::size_t first = kBlock * static_cast<std::size_t>(block);
      for (std::size_t i = first; i < std::min(first + kBlock, count); ++i) {
        points[i] = evaluateSurface(object, posed, surface.measured[i]);
        const auto& [p, n] = points[i];
        exact[i] = exactIrradiance(lights, p, n, surface.wrap[i]);
        sh[i] = irradiance<B>(project<B>(lights, p), wrapCoefficients<B>(surface.wrap[i]), n);
      }
    });
  });
  mean = 0;
  for (const RgbD& e : exact) mean += e.r + e.g + e.b;
  mean /= 3 * static_cast<double>(count);
}

}  // namespace rigel::tools
