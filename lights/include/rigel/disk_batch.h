// One disk light at many points at once, in vectors as wide as the machine's (SSE4, AVX2, AVX-512 or NEON, chosen at
// run time by Highway): what disk.h and near_light.h compute point by point, by the same text (shader_disk*.h), for
// those who have their points in structure of arrays. No allocation; any number of threads.
#pragma once

#include <rigel/disk.h>
#include <rigel/light.h>
#include <rigel/vec3_rows.h>

#include <span>

namespace rigel {

/// SH that the disk gives per unit radiance: coefficient i at point k is sh[i * points.size() + k], and what each
/// colour of the light gives is that times its radiance. B in 2..5; sh holds B^2 numbers a point and overlaps no input.
/// Any count of points, none included. Within 2e-6 of the vector's norm what projectDisk gives, grazing and at the rim
/// too: what cancels there is formed in double. 0 where a point holds a NaN or is infinitely far. For 3 bands and 6
/// nodes 4.3 ns a point with AVX-512, 4.9 with AVX2, 9.7 with SSE4.
template <int B>
void projectDiskBatch(const DiskLight& light, const Vec3Rows& points, DiskNodes nodes, std::span<float> sh) noexcept;

/// Lambert irradiance per unit radiance at points with unit normals, clipped at the horizon; irradiance[k] belongs to
/// point k. Within 2e-6 of the peak over normals what nearIrradiance gives. 0 where a point or a normal holds a NaN, or
/// a point is infinitely far. About 5 ns a point with AVX-512 and 6 with AVX2, where every point's horizon crosses the
/// disk 7 and 11.
void diskIrradianceBatch(const DiskLight& light, const Vec3Rows& points, const Vec3Rows& normals,
                         std::span<float> irradiance) noexcept;

}  // namespace rigel
