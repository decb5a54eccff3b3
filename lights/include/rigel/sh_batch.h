// Irradiance of SH that vary from point to point, at many points at once, in vectors as wide as the machine's (SSE4,
// AVX2, AVX-512 or NEON, chosen at run time by Highway): what shaders do with a rig, for those who have vertices in
// structure of arrays.
#pragma once

#include <rigel/sh.h>
#include <rigel/vec3_rows.h>

#include <array>
#include <span>

namespace rigel {

inline constexpr std::size_t kMaxShBatch = 64;

/// E(n) = pi sum_l f_l sum_m L_lm Y_lm(n) [W/m2], L the sum of `sh` times `weights`, of which row k (normals.size()
/// numbers) belongs to sh[k], kMaxShBatch of them at most: row c of `irradiance` is its colour c. `bands` are the f_l
/// (wrap.h). Errors as those of `irradiance` of the sum, a few roundings of its largest term; a NaN in a weight, normal
/// or vector makes that point NaN and no other. What a point gets depends on no other point; instruction sets differ by
/// rounding. `irradiance` overlaps no input. No allocation; any number of threads.
template <int B>
void irradianceBatch(std::span<const RadianceSH<B>> sh, std::span<const float> weights,
                     const std::array<float, B>& bands, const Vec3Rows& normals, std::span<float> irradiance) noexcept;

/// Adds what one band, l = 3 or 4, gives that is the same at all points: pi f_l sum_m c_m Y_lm(n), `c` its 2 l + 1
/// colours.
void addBandIrradianceBatch(int l, std::span<const Rgb> c, float f, const Vec3Rows& normals,
                            std::span<float> irradiance) noexcept;

}  // namespace rigel
