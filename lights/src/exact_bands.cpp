// A light that is symmetric about the direction w to it has q_lm = F k_l Y_lm(w), so that by the addition theorem its
// first bands give
//
//   E(n) = pi sum_l f_l F k_l sum_m Y_lm(w) Y_lm(n) = F/4 sum_l (2l+1) f_l k_l P_l(n.w).
#include <rigel/disk.h>
#include <rigel/exact_bands.h>

#include <algorithm>
#include <cmath>

#include "local_light.h"
#include "wrap_bands.h"
#include "zonal.h"

namespace rigel {
namespace {

using detail::Vec3d;

/// sum_l (2l+1)/4 f_l k_l P_l(x).
double zonalSum(const double* k, double x, float wrap, int bands) noexcept {
  double f[kMaxBands];
  detail::wrapBands<kMaxBands>(wrap, f);
  double sum = 0, last = 0, p = 1;  // P_{l-1}, P_l by Bonnet's recursion
  for (int l = 0; l < std::clamp(bands, kMinBands, kMaxBands); ++l) {
    sum += (2 * l + 1) / 4.0 * f[l] * k[l] * p;
    const double next = ((2 * l + 1) * x * p - l * last) / (l + 1);
    last = p;
    p = next;
  }
  return sum;
}

RgbD localBands(const detail::LocalTerm& term, Rgb colour, Vec3 n, float wrap, int bands) noexcept {
  const Vec3d normal = detail::directionOf(n);
  if (!term.view.valid || !(term.modulation.value > 0) || detail::dot(normal, normal) == 0) return {};
  double k[kMaxBands];
  detail::zonalFactors<kMaxBands>(term.view.s2, term.view.c, term.view.inside, k);
  const double x = std::clamp(detail::dot(normal, term.view.w), -1.0, 1.0);
  return colour * (term.fluxScale * term.modulation.value * zonalSum(k, x, wrap, bands));
}

/// Y_lm of a unit vector in their order: associated Legendre functions over sin^m theta, by recursion in l, times the
/// real and imaginary part of (x + iy)^m.
void basis(const Vec3d& w, int bands, double* y) noexcept {
  double re = 1, im = 0, diagonal = std::sqrt(0.25 / kPi);  // normalised P_mm / sin^m
  for (int m = 0; m < bands; ++m) {
    double last = 0, p = diagonal, lastFactor = 0;
    for (int l = m; l < bands; ++l) {
      const double scale = m > 0 ? std::sqrt(2.0) * p : p;
      y[shIndex(l, m)] = scale * re;
      if (m > 0) y[shIndex(l, -m)] = scale * im;
      const int next = l + 1;
      const double factor = std::sqrt((4.0 * next * next - 1) / (next * next - m * m));
      const double above = factor * (w.z * p - (l > m ? last / lastFactor : 0));
      last = p;
      p = above;
      lastFactor = factor;
    }
    diagonal *= std::sqrt((2 * m + 3.0) / (2 * m + 2));
    const double turned = re * w.x - im * w.y;
    im = re * w.y + im * w.x;
    re = turned;
  }
}

}  // namespace

RgbD exactBandIrradiance(std::span<const RgbD> radiance, Vec3 n, float wrap, int bands) noexcept {
  const Vec3d normal = detail::directionOf(n);
  if (detail::dot(normal, normal) == 0) return {};
  bands = std::clamp(bands, kMinBands, kMaxBands);
  double f[kMaxBands], y[shCount(kMaxBands)];
  detail::wrapBands<kMaxBands>(wrap, f);
  basis(normal, bands, y);
  RgbD sum;
  for (int l = 0; l < bands; ++l) {
    for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) {
      const double scale = kPi * f[l] * y[i];
      const RgbD& q = radiance[static_cast<std::size_t>(i)];
      sum += {q.r * scale, q.g * scale, q.b * scale};
    }
  }
  return sum;
}

RgbD exactBandIrradiance(const DirectionalLight& light, Vec3, Vec3 n, float wrap, int bands) noexcept {
  if (detail::anyNan(light.direction) || detail::anyNan(light.irradiance)) return {};
  const Vec3d normal = detail::directionOf(n);
  const Vec3d direction = detail::directionOf(light.direction);
  if (detail::dot(normal, normal) == 0 || detail::dot(direction, direction) == 0) return {};
  constexpr double kDelta[kMaxBands] = {1, 1, 1, 1, 1};
  return light.irradiance * zonalSum(kDelta, std::clamp(-detail::dot(normal, direction), -1.0, 1.0), wrap, bands);
}

RgbD exactBandIrradiance(const PointLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept {
  return localBands(detail::localTerm(light, p), light.intensity, n, wrap, bands);
}

RgbD exactBandIrradiance(const SpotLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept {
  return localBands(detail::localTerm(light, p), light.intensity, n, wrap, bands);
}

RgbD exactBandIrradiance(const SphereLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept {
  return localBands(detail::localTerm(light, p), light.radiance, n, wrap, bands);
}

RgbD exactBandIrradiance(const DiskLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept {
  bands = std::clamp(bands, kMinBands, kMaxBands);
  double sh[3 * shCount(kMaxBands)];
  projectDiskExact(light, p, bands, std::span(sh).first(static_cast<std::size_t>(3 * shCount(bands))));
  RgbD radiance[shCount(kMaxBands)];
  for (int i = 0; i < shCount(bands); ++i) radiance[i] = {sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]};
  return exactBandIrradiance(std::span<const RgbD>(radiance), n, wrap, bands);
}

}  // namespace rigel
