#include "pareto/near_forms.h"

namespace rigel::tools {
namespace {

template <class Irradiance>
void addUp(std::span<const NearLight> lights, std::span<const PointAndNormal> points, std::span<const float> wrap,
           std::span<RigRunner::Shaded> shaded, Irradiance irradiance) {
  NearWrap material = nearWrap(0);
  float materialWrap = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (wrap[i] != materialWrap) material = nearWrap(materialWrap = wrap[i]);
    Rgb sum;
    for (const NearLight& light : lights) sum += irradiance(light, points[i].position, points[i].normal, material);
    shaded[i].near = sum;
  }
}

}  // namespace

void addNearLights(NearForm form, std::span<const NearLight> lights, std::span<const PointAndNormal> points,
                   std::span<const float> wrap, std::span<RigRunner::Shaded> shaded) {
  switch (form) {
    case NearForm::exact:
      return addUp(lights, points, wrap, shaded, [](const NearLight& light, Vec3 p, Vec3 n, const NearWrap& w) {
        return nearIrradiance(light, p, n, w);
      });
    case NearForm::cheap:
      return addUp(lights, points, wrap, shaded, [](const NearLight& light, Vec3 p, Vec3 n, const NearWrap&) {
        return cheapIrradiance(light, p, n);
      });
    case NearForm::corrector:
      return addUp(lights, points, wrap, shaded, [](const NearLight& light, Vec3 p, Vec3 n, const NearWrap& w) {
        return correctorIrradiance(light, p, n, w);
      });
  }
}

}  // namespace rigel::tools
