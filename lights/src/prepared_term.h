// One prepared light at one point, in double: what the vector kernels fall back to where float would not do, in contact
// with the light, inside it, at the ends of float's range.
#pragma once

#include <rigel/prepared_lights.h>
#include <rigel/project.h>

#include "local_light.h"

namespace rigel::detail {

/// Closer than sqrt(2) radii c takes its digits from d^2 - r^2 in double.
inline constexpr double kCloseSquare = 2;

/// Lights are small, and need no root, where the square of the sine of half their angle is below this.
inline constexpr double kSmallSquare = 1.0 / 64;

/// From this square of the distance on the kernels stay in float, up to where it overflows.
inline constexpr double kMinPreparedSquare = 1e-30;

/// Whether float holds what is made of a sphere's area and its radiance: down to slopes inside, of d / radius^4.
inline bool hasRoom(double radiusSquare, double peak) noexcept {
  const double flux = radiusSquare * peak;
  return radiusSquare > 1e-20 && radiusSquare < 1e18 && flux > 1e-28 && flux < 1e28;
}

inline double peakOf(Rgb colour) noexcept {
  return std::max({std::abs(colour.r), std::abs(colour.g), std::abs(colour.b)});
}

/// What e may be at most, so that 2 colour e stays within kMaxProjectionScale.
inline double largestFlux(Rgb colour) noexcept {
  return static_cast<double>(kMaxProjectionScale) / (2 * std::max(peakOf(colour), 1e-30));
}

/// `light` is a point, a spot or a sphere. SH are 2 colour fluxScale modulation times functions of view, as there.
inline LocalTerm preparedTerm(const PreparedLight& light, Vec3 p, float footprint) noexcept {
  LocalTerm term;
  term.view = viewSphere(light.position, std::max(light.radius, footprint), p);
  if (!term.view.valid) return term;
  const double perReach = (light.arealess ? light.radius : 1) / std::max(term.view.distance, term.view.radius);
  term.fluxScale = perReach * perReach;
  if (light.inverseRangeSquare > 0)
    term.modulation = rangeWindow(term.view, 1 / std::sqrt(static_cast<double>(light.inverseRangeSquare)));
  if (light.kind == PreparedKind::spot) {
    const Vec3d axis = widen(light.axis);
    const double along = dot(term.view.w, axis);
    const double t = (term.view.inside ? along * (term.view.distance / term.view.radius) : along) + light.coneOffset;
    const double held = std::clamp(t, 0.0, 1.0);
    const double slope = 6 * held * (1 - held);
    const Vec3d gradient =
        term.view.inside ? axis * (-1 / term.view.radius) : (term.view.w * along - axis) * (1 / term.view.distance);
    term.modulation = term.modulation * Modulation{held * held * (3 - 2 * held), gradient * slope};
  }
  return term;
}

/// The same as kernels take it, held to kMaxProjectionScale: e with window and cone, of band 0 with its factor of
/// zonal.h and of the others with min(1, (d/r)^2).
struct CarefulTerm {
  Vec3 w;
  float c = 1;
  float band0 = 0;
  float e = 0;
};

inline CarefulTerm carefulTerm(const PreparedLight& light, Vec3 p, float footprint) noexcept {
  const LocalTerm term = preparedTerm(light, p, footprint);
  if (!term.view.valid || !(term.modulation.value > 0)) return {};
  const SphereView& view = term.view;
  const double flux = std::min(term.fluxScale * term.modulation.value, largestFlux(light.colour));
  const double zonal = view.inside ? 1 - view.c : 1 / (1 + view.c);
  return {narrow(view.w), static_cast<float>(view.c), static_cast<float>(flux * zonal),
          static_cast<float>(view.inside ? flux * view.s2 : flux)};
}

}  // namespace rigel::detail
