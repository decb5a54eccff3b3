#include "report/truth.h"

#include <tbb/parallel_for.h>

namespace rigel::tools {

void Truth::update(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface,
                   const LightSet& lights, int bands) {
  const std::size_t count = surface.measured.size();
  points.resize(count);
  exact.resize(count);
  sh.resize(count);
  withBands(bands, [&]<int B>() {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      points[i] = evaluateSurface(object, posed, surface.measured[i]);
      const auto& [p, n] = points[i];
      exact[i] = exactIrradiance(lights, p, n, surface.wrap[i]);
      sh[i] = irradiance<B>(project<B>(lights, p), wrapCoefficients<B>(surface.wrap[i]), n);
    });
  });
  mean = 0;
  for (const RgbD& e : exact) mean += e.r + e.g + e.b;
  mean /= 3 * static_cast<double>(count);
}

}  // namespace rigel::tools
