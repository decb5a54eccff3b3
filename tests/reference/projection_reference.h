// SH projection of the light kinds in 50 digits, from the definitions in <rigel/light.h> and <rigel/project.h>, and
// their spatial derivative by central differences.
#pragma once

#include <rigel/light.h>

#include <vector>

#include "reference/real50.h"

namespace rigel::reference {

/// bands^2 coefficients for a light of colour 1 (irradiance, intensity, radiance) at receiver `p`.
using Coefficients50 = std::vector<Real50>;

Coefficients50 projectReference(const DirectionalLight& light, const Vec50& p, int bands);
Coefficients50 projectReference(const PointLight& light, const Vec50& p, int bands);
Coefficients50 projectReference(const SpotLight& light, const Vec50& p, int bands);
Coefficients50 projectReference(const SphereLight& light, const Vec50& p, int bands);

/// Derivative by coordinate `axis` of p: (q(p+h) - q(p-h))/2h with h = 1e-14 `scale`, the scale on which the light
/// changes. 1e-28 relative truncation, 36 digits left by the difference.
template <class Light>
Coefficients50 differentiateReference(const Light& light, const Vec50& p, int bands, int axis, const Real50& scale) {
  const Real50 h = scale * Real50("1e-14");
  Vec50 forward = p;
  Vec50 backward = p;
  forward[axis] += h;
  backward[axis] -= h;
  Coefficients50 slope = projectReference(light, forward, bands);
  const Coefficients50 behind = projectReference(light, backward, bands);
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - behind[i]) / (2 * h);
  return slope;
}

}  // namespace rigel::reference
