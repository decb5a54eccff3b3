#include <rigel/near_light.h>
#include <rigel/project.h>

#include <algorithm>
#include <cmath>

#include "near_cap.h"
#include "vec3d.h"

namespace rigel {
namespace {

using detail::Vec3d;

float heldShare(float share) noexcept { return share > 0 ? std::min(share, 1.0f) : 0.0f; }

float heldColour(float value) noexcept { return std::clamp(value, -kMaxProjectionScale, kMaxProjectionScale); }

NearLight black(NearLight::Kind kind) noexcept {
  NearLight out;
  out.kind = kind;
  out.share = 0;
  return out;
}

NearLight lit(NearLight::Kind kind, Rgb colour, float share) noexcept {
  NearLight out;
  out.kind = kind;
  out.share = heldShare(share);
  out.colour = {heldColour(colour.r), heldColour(colour.g), heldColour(colour.b)};
  return out;
}

float kernel(float x, const NearWrap& wrap) noexcept {
  return wrap.a == 0 ? std::max(x, 0.0f) : detail::wrapKernelFloat(x, wrap);
}

/// The factor of the light's colour, its share apart.
float response(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept {
  if (light.kind == NearLight::Kind::directional) return kernel(std::clamp(dot(n, light.position), -1.0f, 1.0f), wrap);

  // In double, as everywhere: d^2 - r^2 decides how far the light reaches beyond the horizon.
  const Vec3d toCentre = detail::widen(light.position) - detail::widen(p);
  const double d2 = detail::dot(toCentre, toCentre);
  const double r2 = static_cast<double>(light.radius) * light.radius;
  const double reach2 = std::max(d2, r2);
  const auto d = static_cast<float>(std::sqrt(d2));
  const float reach = std::max(d, light.radius);
  if (!(reach > 0 && reach <= std::numeric_limits<float>::max())) return 0;

  detail::NearView view;
  view.inside = d2 < r2;
  view.s = std::min(d, light.radius) / reach;
  view.c = std::sqrt(static_cast<float>(std::abs(d2 - r2) / reach2));
  const Vec3 w = d > 0 ? detail::narrow(toCentre * (1.0 / static_cast<double>(d))) : Vec3{0, 0, 1};
  view.x = std::clamp(dot(n, w), -1.0f, 1.0f);

  float factor = detail::nearSphere(view, wrap);
  if (light.kind == NearLight::Kind::sphere)
    return factor * static_cast<float>(kPi) * (view.inside ? 1 : view.s * view.s);
  factor *= 1 / reach / reach;
  const float ratio = d / light.range;
  const float window = std::max(0.0f, 1 - ratio * ratio * ratio * ratio);
  factor *= window * window;
  if (light.kind == NearLight::Kind::spot) {
    const float cosine = -dot(w, light.axis) * (view.inside ? view.s : 1.0f);
    const float t =
        std::clamp((cosine - light.cosOuter) / std::max(light.cosInner - light.cosOuter, kMinConeWidth), 0.0f, 1.0f);
    factor *= t * t * (3 - 2 * t);
  }
  return factor;
}

}  // namespace

NearLight nearLight(const DirectionalLight& light, float share) noexcept {
  const Vec3d direction = detail::directionOf(light.direction);
  if (detail::anyNan(light.irradiance) || detail::dot(direction, direction) == 0)
    return black(NearLight::Kind::directional);
  NearLight out = lit(NearLight::Kind::directional, light.irradiance, share);
  out.position = detail::narrow(direction * -1.0);
  return out;
}

NearLight nearLight(const PointLight& light, float share) noexcept {
  if (detail::anyNan(light.position) || detail::anyNan(light.radius) || detail::anyNan(light.intensity) ||
      !(light.range > 0))
    return black(NearLight::Kind::point);
  NearLight out = lit(NearLight::Kind::point, light.intensity, share);
  out.position = light.position;
  out.radius = std::max(light.radius, kMinPointRadius);
  out.range = light.range;
  return out;
}

NearLight nearLight(const SpotLight& light, float share) noexcept {
  const Vec3d axis = detail::directionOf(light.direction);
  NearLight out = nearLight(PointLight{light.position, light.intensity, light.radius, light.range}, share);
  out.kind = NearLight::Kind::spot;
  if (detail::anyNan(light.innerAngle, light.outerAngle) || detail::dot(axis, axis) == 0) return black(out.kind);
  out.axis = detail::narrow(axis);
  out.cosOuter = static_cast<float>(std::cos(static_cast<double>(light.outerAngle)));
  out.cosInner = static_cast<float>(std::cos(static_cast<double>(light.innerAngle)));
  return out;
}

NearLight nearLight(const SphereLight& light, float share) noexcept {
  if (detail::anyNan(light.position) || !(light.radius > 0) || detail::anyNan(light.radiance))
    return black(NearLight::Kind::sphere);
  NearLight out = lit(NearLight::Kind::sphere, light.radiance, share);
  out.position = light.position;
  out.radius = light.radius;
  return out;
}

NearWrap nearWrap(float a) noexcept {
  NearWrap out;
  out.a = clampWrap(a);
  out.f = wrapCoefficients<kMaxBands>(out.a);
  return out;
}

Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept {
  const float factor = light.share * response(light, p, n, wrap);
  if (!(factor > 0)) return {};
  const Rgb e = light.colour * factor;
  return {heldColour(e.r), heldColour(e.g), heldColour(e.b)};
}

Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, float wrap) noexcept {
  return nearIrradiance(light, p, n, nearWrap(wrap));
}

}  // namespace rigel
