// Exact irradiance: the ground truth, in double. True light shape, horizon clipped, true wrap kernel; no SH anywhere.
#pragma once

#include <rigel/light.h>

namespace rigel {

/// Irradiance [W/m2] at `p` with unit normal `n` and wrap `a` (clamped to [kMinWrap, kMaxWrap]). Closed form for
/// Lambert (a = 0) and half-Lambert (a = 1), adaptive Gauss-Kronrod quadrature over the cap otherwise, to 1e-9 of the
/// peak. Inside and touching a sphere: the continuous extension of project.h. Spot: the cone is evaluated at p, as in
/// project.h. A light with a NaN anywhere contributes 0. No allocation.
RgbD exactIrradiance(const DirectionalLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const PointLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const SpotLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const SphereLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;

/// Sum over all lights of the set.
RgbD exactIrradiance(const LightSet& lights, Vec3 p, Vec3 n, float wrap = 0) noexcept;

}  // namespace rigel
