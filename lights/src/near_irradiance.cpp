// Sphere lights at a point, in float. Only the vector to the light and d^2 - r^2 are formed in double: they decide how
// far a light that nearly touches reaches beyond the horizon. Plain float is 3e-4 of the peak off there; pairs of
// floats are as good as double where there is none (float_pair.glsl).
#include <rigel/near_light.h>
#include <rigel/project.h>
#include <rigel/shader_near_cap.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "disk_irradiance.h"
#include "vec3d.h"

namespace rigel {
namespace {

constexpr auto kPiFloat = static_cast<float>(kPi);

/// nearWrap(0) as far as Lambert looks at it.
constexpr NearWrap lambertWrap() noexcept {
  NearWrap wrap{};
  wrap.inverse = 1;
  wrap.gain = 1;
  return wrap;
}

/// A light as one receiver sees it: outside s = r/d, inside s = d/r; the irradiance is `scale` times the light's colour
/// times a function of x, s and c.
struct NearView {
  float x = 0;
  float s = 0;
  float c = 1;
  bool inside = false;
  float scale = 0;
};

/// Between these float holds a square as well as double does; its root is cheaper.
constexpr double kMinFloatSquare = 1e-30;
constexpr double kMaxFloatSquare = 1e36;

float held(float value) noexcept { return detail::clamp(value, -kMaxProjectionScale, kMaxProjectionScale); }

Rgb scaled(Rgb colour, float factor) noexcept {
  // Also false for NaN.
  if (!(std::abs(factor) > 0)) return {};
  return {held(colour.r * factor), held(colour.g * factor), held(colour.b * factor)};
}

float rangeWindow(float d, float range) noexcept {
  const float ratio = d / range;
  const float square = ratio * ratio;
  const float u = std::max(0.0f, 1 - square * square);
  return u * u;
}

float spotCone(const NearLight& light, Vec3 w, const NearView& view) noexcept {
  const float cosine = -dot(w, light.axis) * (view.inside ? view.s : 1.0f);
  const float width = std::max(light.cosInner - light.cosOuter, kMinConeWidth);
  const float t = detail::clamp((cosine - light.cosOuter) / width, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

NearView viewLocal(const NearLight& light, Vec3 p, Vec3 n) noexcept {
  NearView view;
  const detail::Vec3d toCentre = detail::widen(light.position) - detail::widen(p);
  const double r2 = static_cast<double>(light.radius) * light.radius;
  const double d2 = detail::dot(toCentre, toCentre);
  float d = std::sqrt(static_cast<float>(d2));
  float gap = std::sqrt(static_cast<float>(std::abs(d2 - r2)));
  if (!(d2 + r2 > kMinFloatSquare && d2 + r2 < kMaxFloatSquare)) {
    d = static_cast<float>(std::sqrt(d2));
    gap = static_cast<float>(std::sqrt(std::abs(d2 - r2)));
  }
  const float reach = std::max(d, light.radius);
  // Distances whose inverse float does not hold: only NaN, infinity and what no scene has.
  if (!(reach >= static_cast<float>(kRigelMinReach) && reach <= static_cast<float>(kRigelMaxReach))) return view;

  const float inverse = 1 / reach;
  view.inside = d2 < r2;
  view.s = std::min(d, light.radius) * inverse;
  view.c = gap * inverse;
  const float inverseDistance = view.inside ? 1 / std::max(d, 1e-37f) : inverse;
  const Vec3 w = detail::narrow(toCentre) * inverseDistance;
  view.x = detail::clamp(dot(n, w), -1.0f, 1.0f);
  if (light.kind == NearLight::Kind::sphere) {
    view.scale = kPiFloat * (view.inside ? 1.0f : view.s * view.s);
    return view;
  }
  view.scale = rangeWindow(d, light.range) * inverse * inverse;
  if (light.kind == NearLight::Kind::spot) view.scale *= spotCone(light, w, view);
  return view;
}

/// A directional light is a sphere of no size.
NearView viewOf(const NearLight& light, Vec3 p, Vec3 n) noexcept {
  if (light.kind != NearLight::Kind::directional) return viewLocal(light, p, n);
  NearView view;
  view.x = detail::clamp(dot(n, light.position), -1.0f, 1.0f);
  view.scale = 1;
  return view;
}

/// `cap(x, s, c)` outside; inside the whole sphere less a cap on the other side.
template <class Cap>
float outsideOrIn(const NearView& view, float wholeSphere, const Cap& cap) noexcept {
  const float e = cap(view.inside ? -view.x : view.x, view.s, view.c);
  return view.inside ? wholeSphere - view.s * view.s * e : e;
}

}  // namespace

Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept {
  if (light.kind == NearLight::Kind::disk) {
    return scaled(light.colour, light.share * detail::diskIrradiance(light, p, n, wrap));
  }
  const NearView view = viewOf(light, p, n);
  const float e = wrap.a == 0 ? wrap.gain * outsideOrIn(view, 1, detail::lambertCap<float>)
                              : outsideOrIn(view, wrap.f.x, [&](float x, float s, float c) noexcept {
                                  return detail::wrapCap(x, s, c, wrap);
                                });
  return scaled(light.colour, light.share * view.scale * e);
}

Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, float wrap) noexcept {
  return nearIrradiance(light, p, n, wrap == 0 ? lambertWrap() : nearWrap(wrap));
}

Rgb cheapIrradiance(const NearLight& light, Vec3 p, Vec3 n) noexcept {
  if (light.kind == NearLight::Kind::disk) return scaled(light.colour, light.share * detail::diskCheap(light, p, n));
  const NearView view = viewOf(light, p, n);
  const float e = outsideOrIn(
      view, 1, [](float x, float s, float c) noexcept { return detail::lambertCapCheap(x, std::max(s, 1e-6f), c); });
  return scaled(light.colour, light.share * view.scale * e);
}

Rgb correctorIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept {
  if (light.kind == NearLight::Kind::disk) {
    return scaled(light.colour, light.share * detail::diskCorrector(light, p, n, wrap));
  }
  const NearView view = viewOf(light, p, n);
  if (view.inside) return {};
  const float share = detail::highBandShare(view.s * view.s);
  return scaled(light.colour, light.share * view.scale * share * detail::kernelAboveBand2(view.x, wrap));
}

}  // namespace rigel
