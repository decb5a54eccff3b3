#include "report/measure/truth.h"

#include <algorithm>

namespace rigel::tools {
void Truth::update(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface,
                   const LightSet& lights, int bands) {
  const std::size_t count = surface.measured.size();
  points.resize(count);
  exact.resize(count);
  forSamples(count, [&](std::size_t i) {
    points[i] = evaluateSurface(object, posed, surface.measured[i]);
    exact[i] = exactIrradiance(lights, points[i].position, points[i].normal, surface.wrap[i]);
  });
  project(lights, surface, bands, sh);
  mean = 0;
  for (const RgbD& e : exact) mean += e.r + e.g + e.b;
  mean /= 3 * static_cast<double>(count);
}

void Truth::project(const LightSet& lights, const SurfaceSet& surface, int bands, std::vector<Rgb>& out) const {
  out.resize(points.size());
  withBands(bands, [&]<int B>() {
    forSamples(points.size(), [&](std::size_t i) {
      const auto& [p, n] = points[i];
      out[i] = irradiance<B>(rigel::project<B>(lights, p), wrapCoefficients<B>(surface.wrap[i]), n);
    });
  });
}

double quickMean(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface,
                 const LightSet& lights) {
  constexpr std::size_t kPoints = 256;
  const std::size_t count = surface.measured.size();
  const std::size_t points = std::min(kPoints, count);
  double sum = 0;
  for (std::size_t k = 0; k < points; ++k) {
    const std::size_t i = k * count / points;  // in triangle order: spread over the whole surface
    const auto [p, n] = evaluateSurface(object, posed, surface.measured[i]);
    const RgbD e = exactIrradiance(lights, p, n, surface.wrap[i]);
    sum += e.r + e.g + e.b;
  }
  return points > 0 ? sum / (3 * static_cast<double>(points)) : 0;
}

}  // namespace rigel::tools
