// Near lights at many points at once, in vectors as wide as the machine's (SSE4, AVX2, AVX-512 or NEON, chosen at run
// time by Highway): what near_light.h computes point by point, by the same text (shader_near_cap.h, shader_disk*.h),
// for those who have vertices in structure of arrays.
#pragma once

#include <rigel/near_light.h>
#include <rigel/vec3_rows.h>

#include <span>

namespace rigel {

/// Sum over `lights`, of any kinds, of share * wrap.gain * irradiance [W/m2] at points with unit normals: row c of
/// `irradiance`, points.size() numbers, is its colour c. Any count of points and any alignment; `irradiance` overlaps
/// no input. Errors as nearIrradiance's, in the same measures: Lambert 7e-7 of a light's peak over normals (disks
/// 1.0e-6), wrap what its fit leaves. A light gives 0 where a point or a normal holds a NaN or a point is infinitely
/// far, and is held to kMaxProjectionScale. What it gives at a point depends on no other point; instruction sets differ
/// by rounding. No allocation; any number of threads. Vectors hold points, one light after another is broadcast; only
/// closer than sqrt(2) radii and inside is the geometry in double.
void nearIrradianceBatch(std::span<const NearLight> lights, const Vec3Rows& points, const Vec3Rows& normals,
                         const NearWrap& wrap, std::span<float> irradiance) noexcept;

}  // namespace rigel
