// Irradiance of a light's first SH bands alone, in double: what a perfect rig of that many bands would give, and with
// exact.h what the bands left out hold.
#pragma once

#include <rigel/light.h>
#include <rigel/sh.h>

#include <span>

namespace rigel {

/// pi sum_{l<bands} f_l(a) sum_m q_lm Y_lm(n) [W/m2], not clamped, q the light's radiance SH at `p`. `bands` 2 to 5
/// (held within); n is normalised in double, without direction nothing is received; wrap `a` as in exact.h. Special
/// cases are those of exact.h: what is behind a disk, NaN, missing radii or directions give 0, inside a sphere the
/// continuous extension holds. Nothing is held to kMaxProjectionScale. To 1e-13 of the light's peak over normals, disks
/// 1e-10. 30 ns a light, disks 1.2 us. No allocation; any number of threads.
RgbD exactBandIrradiance(const DirectionalLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept;
RgbD exactBandIrradiance(const PointLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept;
RgbD exactBandIrradiance(const SpotLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept;
RgbD exactBandIrradiance(const SphereLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept;
RgbD exactBandIrradiance(const DiskLight& light, Vec3 p, Vec3 n, float wrap, int bands) noexcept;

/// The same sum for SH that are given: `radiance` holds bands^2 colours.
RgbD exactBandIrradiance(std::span<const RgbD> radiance, Vec3 n, float wrap, int bands) noexcept;

}  // namespace rigel
