// Exact irradiance: the ground truth, in double. True light shape, horizon clipped, true wrap kernel; no SH anywhere.
#pragma once

#include <rigel/light.h>

namespace rigel {

/// Irradiance [W/m2] at `p` with normal `n` (normalised in double; without direction it receives 0) and wrap `a`
/// (clamped to [kMinWrap, kMaxWrap]): int L f(n.w|a) dw. Closed form for Lambert (a = 0) and half-Lambert (a = 1),
/// 15-30 ns a light; otherwise adaptive Gauss-Kronrod quadrature over the cap to 2e-8 of the peak, 0.4-5 us. Inside and
/// touching a sphere: the continuous extension of project.h. Spot: the cone is evaluated at p, as in project.h. Disk:
/// Lambert in closed form, 120 ns; any other wrap by the contour integral over its rim, to 1e-8 of the peak over
/// normals, 1-5 us, where the horizon cuts a rim close by 20. A light contributes 0 where it, p or n holds a NaN. No
/// allocation; any number of threads.
RgbD exactIrradiance(const DirectionalLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const PointLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const SpotLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const SphereLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;
RgbD exactIrradiance(const DiskLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;

/// Sum over all lights of the set.
RgbD exactIrradiance(const LightSet& lights, Vec3 p, Vec3 n, float wrap = 0) noexcept;

}  // namespace rigel
