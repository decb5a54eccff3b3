// What one local light (point, spot, sphere) is at one receiver point, in double: the sphere's geometry, the factor
// that turns its colour into flux, and the modulation by range window and spot cone. Both the SH projection and the
// exact irradiance start here, so that they agree about every special case.
#pragma once

#include <rigel/light.h>
#include <rigel/sh.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vec3d.h"

namespace rigel::detail {

/// A sphere of radius r at distance d, seen from the receiver. Outside s2 = (r/d)^2, c = sqrt(1-s2), the cosine of the
/// half-angle; inside the continuous extension s2 = (d/r)^2, c = -sqrt(1-s2).
struct SphereView {
  Vec3d w;  // unit vector from receiver to centre; arbitrary at d = 0, where nothing depends on it
  double distance = 0;
  double radius = 0;
  double s2 = 0;
  double c = 1;
  bool inside = false;
  bool valid = false;  // false: no light arrives (zero radius, infinite distance)

  double capSolidAngleShare() const noexcept { return inside ? 1.0 : s2; }  // min(1, (r/d)^2)
};

inline SphereView viewSphere(Vec3 centre, double radius, Vec3 p) noexcept {
  SphereView view;
  const Vec3d toCentre = widen(centre) - widen(p);
  const double d2 = dot(toCentre, toCentre);
  const double r2 = radius * radius;
  if (!(radius > 0) || !std::isfinite(d2)) return view;
  view.valid = true;
  view.radius = radius;
  view.distance = std::sqrt(d2);
  view.w = view.distance > 0 ? toCentre * (1 / view.distance) : Vec3d{0, 0, 1};
  view.inside = d2 < r2;
  // 1 - s2 from the difference of the squares: the textbook form loses half the digits where the light is near.
  if (view.inside) {
    view.s2 = d2 / r2;
    view.c = std::isfinite(r2) ? -std::sqrt((r2 - d2) / r2) : -1.0;
  } else {
    view.s2 = r2 / d2;
    view.c = std::sqrt((d2 - r2) / d2);
  }
  return view;
}

/// A factor of position and its derivative by the receiver point.
struct Modulation {
  double value = 1;
  Vec3d gradient;
};

inline Modulation operator*(const Modulation& a, const Modulation& b) noexcept {
  return {a.value * b.value, a.gradient * b.value + b.gradient * a.value};
}

/// clamp(1-(d/R)^4, 0, 1)^2.
inline Modulation rangeWindow(const SphereView& view, double range) noexcept {
  if (!(range > 0)) return {0, {}};
  const double x = view.distance / range;
  const double u = 1 - x * x * x * x;
  if (!(u > 0)) return {0, {}};
  return {u * u, view.w * (8 * u * x * x * x / range)};
}

/// Smoothstep of the cosine between the spot's axis and the direction to the receiver, which inside the light is
/// scaled by d/r: it passes through 0 at the centre, where the direction has no limit.
inline Modulation spotCone(const SphereView& view, const SpotLight& spot) noexcept {
  const Vec3d axis = directionOf(spot.direction);
  if (dot(axis, axis) == 0) return {0, {}};
  const double cosOuter = std::cos(static_cast<double>(spot.outerAngle));
  const double cosInner = std::cos(static_cast<double>(spot.innerAngle));
  const double width = std::max<double>(cosInner - cosOuter, kMinConeWidth);
  const double along = -dot(view.w, axis);
  const double cosine = view.inside ? along * (view.distance / view.radius) : along;
  const double t = std::clamp((cosine - cosOuter) / width, 0.0, 1.0);
  const double slope = 6 * t * (1 - t) / width;
  const Vec3d cosineGradient = view.inside ? axis * (1 / view.radius) : (axis + view.w * cosine) * (1 / view.distance);
  return {t * t * (3 - 2 * t), cosineGradient * slope};
}

/// A local light at a point: SH and irradiance are colour * fluxScale * modulation * (functions of view), with
/// functions of view normalised by min(1, (r/d)^2).
struct LocalTerm {
  SphereView view;
  double fluxScale = 0;  // 2 pi L min(1, (r/d)^2) per unit of the light's colour
  Modulation modulation;
};

// `footprint`: the receiver is a patch of this radius rather than a point. The light is seen as if it were at least
// that large, with the same power: what a patch receives on average stays bounded however close the light comes.

inline LocalTerm localTerm(const SphereLight& light, Vec3 p, float footprint = 0) noexcept {
  LocalTerm term;
  if (anyNan(light.position) || anyNan(light.radius) || anyNan(light.radiance)) return term;
  term.view = viewSphere(light.position, light.radius > 0 ? std::max(light.radius, footprint) : 0, p);
  term.fluxScale = 2 * kPi * term.view.capSolidAngleShare();
  if (light.radius < footprint) {
    const double share = light.radius / term.view.radius;
    term.fluxScale *= share * share;
  }
  return term;
}

inline LocalTerm localTerm(const PointLight& light, Vec3 p, float footprint = 0) noexcept {
  LocalTerm term;
  if (anyNan(light.position) || anyNan(light.radius, light.range) || anyNan(light.intensity)) return term;
  term.view = viewSphere(light.position, std::max({light.radius, kMinPointRadius, footprint}), p);
  // L = I / (pi r^2); r^2 cancels outside, so that tiny radii neither overflow nor lose bits.
  const double reach = std::max(term.view.distance, term.view.radius);
  term.fluxScale = 2 / (reach * reach);
  term.modulation = rangeWindow(term.view, light.range);
  return term;
}

inline LocalTerm localTerm(const SpotLight& light, Vec3 p, float footprint = 0) noexcept {
  LocalTerm term;
  if (anyNan(light.direction) || anyNan(light.innerAngle, light.outerAngle)) return term;
  term = localTerm(PointLight{light.position, light.intensity, light.radius, light.range}, p, footprint);
  if (term.view.valid && term.modulation.value > 0) term.modulation = term.modulation * spotCone(term.view, light);
  return term;
}

}  // namespace rigel::detail
