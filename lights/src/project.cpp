// Projection of lights into SH. With fluxScale F, modulation M (range window, spot cone), w towards the light:
//
//   q_lm      = F M k_l Y_lm(w)
//   d q_lm/dp = F M e [ (P_l(c)/|c|) Y_lm(w) w - h_l (I - w w^T) grad Y_lm(w) ] + F (dM/dp) k_l Y_lm(w)
//
// where e = 1/d outside and d/r^2 inside: both follow from g_l' = -s2 P_l(c)/(d |c|) and dw/dp = -(I - w w^T)/d.
// Sphere projection: P.-P. Sloan, "Stupid Spherical Harmonics Tricks", 2008 (spherical light sources); the zonal
// factors in the form of zonal.h, which holds for every distance.
#include <rigel/project.h>

#include <algorithm>
#include <cmath>

#include "bounded_colour.h"
#include "local_light.h"
#include "sh_polynomials.h"
#include "zonal.h"

namespace rigel {
namespace {

using detail::boundedColour;
using detail::LocalTerm;
using detail::Vec3d;

template <int B>
void accumulate(const DirectionalLight& light, RadianceSH<B>& sh) noexcept {
  if (detail::anyNan(light.direction) || detail::anyNan(light.irradiance)) return;
  const Vec3d towardsLight = detail::directionOf(light.direction) * -1.0;
  if (detail::dot(towardsLight, towardsLight) == 0) return;

  float y[shCount(B)];
  detail::basisPolynomials<B>(detail::narrow(towardsLight), y);
  const Rgb scale = boundedColour(light.irradiance, 1);
  for (int i = 0; i < shCount(B); ++i) sh[i] += scale * y[i];
}

template <int B>
void accumulateValue(const LocalTerm& term, Rgb colour, RadianceSH<B>& sh) noexcept {
  float y[shCount(B)];
  float k[B];
  detail::basisPolynomials<B>(detail::narrow(term.view.w), y);
  detail::zonalFactors<B>(static_cast<float>(term.view.s2), static_cast<float>(term.view.c), term.view.inside, k);
  const Rgb scale = boundedColour(colour, term.fluxScale * term.modulation.value);
  for (int l = 0; l < B; ++l) {
    for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) sh[i] += scale * (k[l] * y[i]);
  }
}

template <int B>
void accumulateGradient(const LocalTerm& term, Rgb colour, RadianceShGradient<B>& gradient) noexcept {
  const detail::SphereView& view = term.view;
  const auto s2 = static_cast<float>(view.s2);
  const auto c = static_cast<float>(view.c);
  const Vec3 w = detail::narrow(view.w);
  float y[shCount(B)];
  Vec3 dy[shCount(B)];
  detail::basisPolynomials<B>(w, y);
  detail::basisGradientPolynomials<B>(w, dy);
  float k[B], h[B], radial[B];
  detail::zonalFactors<B>(s2, c, view.inside, k);
  detail::slopeFactors<B>(s2, c, h);
  detail::legendre<B>(s2, c, radial);
  const float perCosine = 1 / std::max(std::abs(c), kMinGradientCosine);

  const double perMetre = view.inside ? view.distance / (view.radius * view.radius) : 1 / view.distance;
  const Rgb scale = boundedColour(colour, term.fluxScale * term.modulation.value * perMetre);
  const Vec3d& slope = term.modulation.gradient;
  const bool modulated = slope.x != 0 || slope.y != 0 || slope.z != 0;
  Rgb slopeScale[3];
  if (modulated) {
    for (int axis = 0; axis < 3; ++axis) slopeScale[axis] = boundedColour(colour, term.fluxScale * slope[axis]);
  }

  for (int l = 0; l < B; ++l) {
    // (I - w w^T) grad Y = grad Y - l Y w, since the polynomials are homogeneous.
    const float along = radial[l] * perCosine + h[l] * static_cast<float>(l);
    for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) {
      const Vec3 direction = w * (along * y[i]) - dy[i] * h[l];
      for (int axis = 0; axis < 3; ++axis) gradient.d[axis][i] += scale * direction[axis];
      if (modulated) {
        for (int axis = 0; axis < 3; ++axis) gradient.d[axis][i] += slopeScale[axis] * (k[l] * y[i]);
      }
    }
  }
}

template <int B, class Light>
void accumulate(const Light& light, Vec3 p, float footprint, RadianceSH<B>& sh) noexcept {
  const LocalTerm term = detail::localTerm(light, p, footprint);
  if (!term.view.valid || !(term.modulation.value > 0)) return;
  accumulateValue<B>(term, colourOf(light), sh);
}

template <int B, class Light>
void accumulate(const Light& light, Vec3 p, ProjectionWithGradient<B>& out) noexcept {
  const LocalTerm term = detail::localTerm(light, p);
  if (!term.view.valid || !(term.modulation.value > 0)) return;
  accumulateValue<B>(term, colourOf(light), out.value);
  accumulateGradient<B>(term, colourOf(light), out.gradient);
}

template <int B, class Light>
RadianceSH<B> valueOf(const Light& light, Vec3 p, float footprint) noexcept {
  RadianceSH<B> sh;
  accumulate<B>(light, p, footprint, sh);
  return sh;
}

template <int B, class Light>
ProjectionWithGradient<B> valueAndGradientOf(const Light& light, Vec3 p) noexcept {
  ProjectionWithGradient<B> out;
  accumulate<B>(light, p, out);
  return out;
}

}  // namespace

template <int B>
RadianceSH<B> project(const DirectionalLight& light, Vec3, float) noexcept {
  RadianceSH<B> sh;
  accumulate<B>(light, sh);
  return sh;
}
template <int B>
RadianceSH<B> project(const PointLight& light, Vec3 p, float footprint) noexcept {
  return valueOf<B>(light, p, footprint);
}
template <int B>
RadianceSH<B> project(const SpotLight& light, Vec3 p, float footprint) noexcept {
  return valueOf<B>(light, p, footprint);
}
template <int B>
RadianceSH<B> project(const SphereLight& light, Vec3 p, float footprint) noexcept {
  return valueOf<B>(light, p, footprint);
}

template <int B>
RadianceSH<B> project(const LightSet& lights, Vec3 p, float footprint) noexcept {
  RadianceSH<B> sh;
  for (int i = 0; i < lights.directionalCount(); ++i) accumulate<B>(lights.directional(i), sh);
  for (int i = 0; i < lights.pointCount(); ++i) accumulate<B>(lights.point(i), p, footprint, sh);
  for (int i = 0; i < lights.spotCount(); ++i) accumulate<B>(lights.spot(i), p, footprint, sh);
  for (int i = 0; i < lights.sphereCount(); ++i) accumulate<B>(lights.sphere(i), p, footprint, sh);
  for (int i = 0; i < lights.diskCount(); ++i) sh += project<B>(lights.disk(i), p, footprint);
  return sh;
}

template <int B>
ProjectionWithGradient<B> projectWithGradient(const DirectionalLight& light, Vec3) noexcept {
  ProjectionWithGradient<B> out;
  accumulate<B>(light, out.value);
  return out;
}
template <int B>
ProjectionWithGradient<B> projectWithGradient(const PointLight& light, Vec3 p) noexcept {
  return valueAndGradientOf<B>(light, p);
}
template <int B>
ProjectionWithGradient<B> projectWithGradient(const SpotLight& light, Vec3 p) noexcept {
  return valueAndGradientOf<B>(light, p);
}
template <int B>
ProjectionWithGradient<B> projectWithGradient(const SphereLight& light, Vec3 p) noexcept {
  return valueAndGradientOf<B>(light, p);
}

template <int B>
ProjectionWithGradient<B> projectWithGradient(const LightSet& lights, Vec3 p) noexcept {
  ProjectionWithGradient<B> out;
  for (int i = 0; i < lights.directionalCount(); ++i) accumulate<B>(lights.directional(i), out.value);
  for (int i = 0; i < lights.pointCount(); ++i) accumulate<B>(lights.point(i), p, out);
  for (int i = 0; i < lights.spotCount(); ++i) accumulate<B>(lights.spot(i), p, out);
  for (int i = 0; i < lights.sphereCount(); ++i) accumulate<B>(lights.sphere(i), p, out);
  for (int i = 0; i < lights.diskCount(); ++i) {
    const ProjectionWithGradient<B> disk = projectWithGradient<B>(lights.disk(i), p);
    out.value += disk.value;
    for (int axis = 0; axis < 3; ++axis) out.gradient.d[axis] += disk.gradient.d[axis];
  }
  return out;
}

#define RIGEL_INSTANTIATE_FOR(B, Light)                                  \
  template RadianceSH<B> project<B>(const Light&, Vec3, float) noexcept; \
  template ProjectionWithGradient<B> projectWithGradient<B>(const Light&, Vec3) noexcept;
#define RIGEL_INSTANTIATE(B)                                                \
  RIGEL_INSTANTIATE_FOR(B, DirectionalLight)                                \
  RIGEL_INSTANTIATE_FOR(B, PointLight)                                      \
  RIGEL_INSTANTIATE_FOR(B, SpotLight)                                       \
  RIGEL_INSTANTIATE_FOR(B, SphereLight)                                     \
  template RadianceSH<B> project<B>(const LightSet&, Vec3, float) noexcept; \
  template ProjectionWithGradient<B> projectWithGradient<B>(const LightSet&, Vec3) noexcept;

RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
