// The weights of slope_lanes.h at one point, in double: where the vector kernels fall back to that.
#pragma once

#include <algorithm>
#include <cmath>

#include "prepared_term.h"
#include "zonal.h"

namespace rigel::detail {

template <int B>
struct CarefulSlopes {
  float plus[B] = {}, excess[B] = {};
  float axial = 0, axialBand0 = 0;  // of the numbers that the cone's slope along its axis multiplies, as e and band0
};

/// Range window and cone of a prepared light at a view, with the derivative's part towards the light and along the
/// axis.
struct PreparedModulation {
  double value = 1, radial = 0, axial = 0;
};

inline PreparedModulation preparedModulation(const PreparedLight& light, const SphereView& view) noexcept {
  PreparedModulation out;
  if (light.inverseRangeSquare > 0) {
    const double range = 1 / std::sqrt(static_cast<double>(light.inverseRangeSquare));
    const double x = view.distance / range, u = std::max(0.0, 1 - x * x * x * x);
    out.value = u * u;
    out.radial = u > 0 ? 8 * u * x * x * x / range : 0;
  }
  if (light.kind != PreparedKind::spot) return out;
  const double along = dot(view.w, widen(light.axis));
  const double t = (view.inside ? along * (view.distance / view.radius) : along) + light.coneOffset;
  const double held = std::clamp(t, 0.0, 1.0), cone = held * held * (3 - 2 * held);
  const double slope = out.value * 6 * held * (1 - held);
  out.axial = slope / (view.inside ? view.radius : view.distance);
  out.radial = out.radial * cone + (view.inside ? 0 : slope * along / view.distance);
  out.value *= cone;
  return out;
}

template <int B>
CarefulSlopes<B> carefulSlopes(const PreparedLight& light, Vec3 p) noexcept {
  CarefulSlopes<B> out;
  const LocalTerm term = preparedTerm(light, p, 0);
  if (!term.view.valid || !(term.modulation.value > 0)) return out;
  const SphereView& view = term.view;
  const PreparedModulation modulation =
      light.kind == PreparedKind::sphere ? PreparedModulation{} : preparedModulation(light, view);
  double k[B], h[B], radial[B];
  zonalFactors<B>(view.s2, view.c, view.inside, k);
  slopeFactors<B>(view.s2, view.c, h);
  legendre<B>(view.s2, view.c, radial);
  const double perCosine = 1 / std::max<double>(std::abs(view.c), kMinGradientCosine);
  const double perMetre = view.inside ? view.distance / (view.radius * view.radius) : 1 / view.distance;
  const double limit = largestFlux(light.colour);
  const auto bounded = [&](double x) { return x == x ? std::clamp(x, -limit, limit) : 0.0; };
  const double scale = bounded(term.fluxScale * modulation.value * perMetre);
  const double modulated = bounded(term.fluxScale * modulation.radial);
  double plus[B];
  for (int l = 0; l < B; ++l) {
    plus[l] = scale * (radial[l] * perCosine + l * h[l]) + modulated * k[l];
    out.plus[l] = static_cast<float>(plus[l]);
    if (l == 0) continue;
    const double minus = scale * (radial[l] * perCosine - (l + 1) * h[l]) + modulated * k[l];
    out.excess[l] = static_cast<float>(minus + (l > 1 ? (l - 1.0) / l * plus[l - 2] : 0));
  }
  const double axial = bounded(term.fluxScale * modulation.axial);
  out.axial = static_cast<float>(view.inside ? axial * view.s2 : axial);
  out.axialBand0 = static_cast<float>(axial * k[0]);
  return out;
}

}  // namespace rigel::detail
