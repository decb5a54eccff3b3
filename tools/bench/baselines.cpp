#include "bench/baselines.h"

#include <algorithm>
#include <cmath>

namespace rigel::tools {

void projectSphereTextbook(const SphereLight& light, Vec3 p, RadianceSH<3>& sum) {
  const Vec3 toLight = light.position - p;
  const float d = length(toLight);
  const Vec3 w = toLight * (1 / d);
  const float alpha = std::asin(std::min(light.radius / d, 1.0f));
  const float c = std::cos(alpha);
  const float s = std::sin(alpha);
  // Zonal coefficients of a cap of half-angle alpha, over sqrt((2l+1)/4pi): 2 pi int_c^1 P_l.
  const float pi = static_cast<float>(kPi);
  const float zonal[3] = {2 * pi * (1 - c), pi * s * s, pi * c * s * s};
  float y[9];
  shBasis<3>(w, y);
  for (int l = 0; l < 3; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum[i] += light.radiance * (zonal[l] * y[i]);
}

void projectSphereTextbookGradient(const SphereLight& light, Vec3 p, float step, RadianceSH<3>& value,
                                   RadianceShGradient<3>& gradient) {
  projectSphereTextbook(light, p, value);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 offset;
    offset[axis] = step;
    RadianceSH<3> ahead, behind;
    projectSphereTextbook(light, p + offset, ahead);
    projectSphereTextbook(light, p - offset, behind);
    gradient.d[axis] += ahead * (0.5f / step);
    gradient.d[axis] += behind * (-0.5f / step);
  }
}

float wallaceIrradiance(const DiskLight& light, Vec3 p, Vec3 n) {
  const Vec3 toLight = light.position - p;
  const float d2 = dot(toLight, toLight);
  const Vec3 w = toLight * (1 / std::sqrt(d2));
  const float cosine = -dot(w, light.direction) / length(light.direction);
  const float atLight = light.twoSided ? std::abs(cosine) : std::max(cosine, 0.0f);
  const float pi = static_cast<float>(kPi);
  const float area = pi * light.radius * light.radius;
  return pi * area * std::max(dot(n, w), 0.0f) * atLight / (pi * d2 + area);
}

}  // namespace rigel::tools
