#include "reference/projection_reference.h"

#include <algorithm>

#include "reference/sh_reference.h"

namespace rigel::reference {
namespace {

/// Radiance 1 from all directions within the angle of cosine c about w: q_lm = 2 pi int_c^1 P_l Y_lm(w), and
/// int_c^1 P_l = (P_{l-1}(c) - P_{l+1}(c))/(2l+1).
Coefficients50 projectCap(const Vec50& w, const Real50& c, int bands) {
  Coefficients50 out;
  for (int l = 0; l < bands; ++l) {
    const Real50 zonal = l == 0 ? 1 - c : (legendreReference(l - 1, c) - legendreReference(l + 1, c)) / (2 * l + 1);
    for (int m = -l; m <= l; ++m) out.push_back(2 * pi50() * zonal * shReference(l, m, w));
  }
  return out;
}

Coefficients50 projectSphere(const Vec50& centre, const Real50& radius, const Vec50& p, int bands) {
  const Vec50 toCentre = centre - p;
  const Real50 d = length(toCentre);
  if (radius <= 0) return Coefficients50(bands * bands, Real50(0));
  const Vec50 w = d > 0 ? toCentre * (1 / d) : Vec50{0, 0, 1};
  const Real50 c = d >= radius ? sqrt(1 - (radius / d) * (radius / d)) : -sqrt(1 - (d / radius) * (d / radius));
  return projectCap(w, c, bands);
}

Real50 rangeWindow(const Vec50& centre, float range, const Vec50& p) {
  if (range == kNoRange) return 1;
  const Real50 x = length(centre - p) / Real50(range);
  const Real50 window = std::max(Real50(0), Real50(1 - x * x * x * x));
  return window * window;
}

Real50 spotCone(const SpotLight& light, const Vec50& p) {
  const Vec50 fromCentre = p - exactly(light.position);
  const Vec50 direction = exactly(light.direction);
  const Real50 reach = std::max(length(fromCentre), Real50(std::max(light.radius, kMinPointRadius)));
  const Real50 cosine = dot(fromCentre, direction) / (reach * length(direction));
  const Real50 outer = cos(Real50(light.outerAngle));
  const Real50 width = std::max(Real50(cos(Real50(light.innerAngle)) - outer), Real50(kMinConeWidth));
  const Real50 t = std::min(Real50(1), std::max(Real50(0), Real50((cosine - outer) / width)));
  return t * t * (3 - 2 * t);
}

Coefficients50 scaled(Coefficients50 q, const Real50& factor) {
  for (Real50& value : q) value *= factor;
  return q;
}

}  // namespace

Coefficients50 projectReference(const SphereLight& light, const Vec50& p, int bands) {
  return projectSphere(exactly(light.position), Real50(light.radius), p, bands);
}

Coefficients50 projectReference(const PointLight& light, const Vec50& p, int bands) {
  const Vec50 centre = exactly(light.position);
  const Real50 radius(std::max(light.radius, kMinPointRadius));
  return scaled(projectSphere(centre, radius, p, bands),
                rangeWindow(centre, light.range, p) / (pi50() * radius * radius));
}

Coefficients50 projectReference(const SpotLight& light, const Vec50& p, int bands) {
  const PointLight point{light.position, light.intensity, light.radius, light.range};
  return scaled(projectReference(point, p, bands), spotCone(light, p));
}

Coefficients50 projectReference(const DirectionalLight& light, const Vec50&, int bands) {
  const Vec50 direction = exactly(light.direction);
  const Vec50 w = direction * (-1 / length(direction));
  Coefficients50 out;
  for (int l = 0; l < bands; ++l) {
    for (int m = -l; m <= l; ++m) out.push_back(shReference(l, m, w));
  }
  return out;
}

}  // namespace rigel::reference
