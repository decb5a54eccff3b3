#include <rigel/near_light.h>
#include <rigel/project.h>

#include <algorithm>
#include <cmath>

#include "vec3d.h"

namespace rigel {
namespace {

using detail::Vec3d;

static_assert(sizeof(NearLight) == 15 * sizeof(float), "copied to GPUs as it is");

NearLight black(NearLight::Kind kind) noexcept {
  NearLight out;
  out.kind = kind;
  out.share = 0;
  return out;
}

float held(float value) noexcept { return std::clamp(value, -kMaxProjectionScale, kMaxProjectionScale); }

NearLight lit(NearLight::Kind kind, Rgb colour, float share) noexcept {
  NearLight out;
  out.kind = kind;
  out.share = share > 0 ? std::min(share, 1.0f) : 0.0f;
  out.colour = {held(colour.r), held(colour.g), held(colour.b)};
  return out;
}

}  // namespace

NearLight nearLight(const DirectionalLight& light, float share) noexcept {
  constexpr auto kKind = NearLight::Kind::directional;
  const Vec3d direction = detail::directionOf(light.direction);
  if (detail::anyNan(light.irradiance) || detail::dot(direction, direction) == 0) return black(kKind);
  NearLight out = lit(kKind, light.irradiance, share);
  out.position = detail::narrow(direction * -1.0);
  return out;
}

NearLight nearLight(const PointLight& light, float share) noexcept {
  constexpr auto kKind = NearLight::Kind::point;
  const bool nan = detail::anyNan(light.position) || detail::anyNan(light.radius) || detail::anyNan(light.intensity);
  if (nan || !(light.range > 0)) return black(kKind);
  NearLight out = lit(kKind, light.intensity, share);
  out.position = light.position;
  out.radius = std::max(light.radius, kMinPointRadius);
  out.range = light.range;
  return out;
}

NearLight nearLight(const SpotLight& light, float share) noexcept {
  constexpr auto kKind = NearLight::Kind::spot;
  const Vec3d axis = detail::directionOf(light.direction);
  if (detail::anyNan(light.innerAngle, light.outerAngle) || detail::dot(axis, axis) == 0) return black(kKind);
  NearLight out = nearLight(PointLight{light.position, light.intensity, light.radius, light.range}, share);
  out.kind = kKind;
  out.axis = detail::narrow(axis);
  out.cosOuter = static_cast<float>(std::cos(static_cast<double>(light.outerAngle)));
  out.cosInner = static_cast<float>(std::cos(static_cast<double>(light.innerAngle)));
  return out;
}

NearLight nearLight(const SphereLight& light, float share) noexcept {
  constexpr auto kKind = NearLight::Kind::sphere;
  if (detail::anyNan(light.position) || !(light.radius > 0) || detail::anyNan(light.radiance)) return black(kKind);
  NearLight out = lit(kKind, light.radiance, share);
  out.position = light.position;
  out.radius = light.radius;
  return out;
}

// Blur and highBandShare (near_cap.h) were fitted together, to exact irradiance over s in [0, 1] and all normals. The
// blur at s is `width` s sqrt(1-a^2)/(1+a), the light's angular size at the horizon. It adds a bump at x = -a to the
// kernel, whose bands are its area, (2/(2p+1) - 1/(p+1)) width^(p+1) for the power p = 1 + a, times P_l(-a); the fit's
// `area` stands for what is not width^2 in it.
NearWrap nearWrap(float wrap) noexcept {
  NearWrap out;
  out.a = clampWrap(wrap);
  out.inverse = 1 / (1 + out.a);
  const std::array<float, 5> f = wrapCoefficients<5>(out.a);
  for (int l = 0; l < 5; ++l) out.band[l] = 0.25f * static_cast<float>(2 * l + 1) * f[l];

  const double a = out.a;
  const double width = std::max(0.0, 0.746 + a * (0.3718 - a * 1.7425));
  const double area = 0.2042 + a * (-0.6257 + a * 0.5433);
  const double blur = width * std::sqrt((1 - a) / (1 + a));
  out.blur = static_cast<float>(blur);
  const double a2 = a * a;
  const double legendre[5] = {1, -a, 1.5 * a2 - 0.5, -a * (2.5 * a2 - 1.5), (35 * a2 * a2 - 30 * a2 + 3) / 8};
  for (int l = 0; l < 5; ++l)
    out.blurBand[l] = static_cast<float>((l + 0.5) * (1 + a) * area * blur * blur * legendre[l]);
  return out;
}

}  // namespace rigel
