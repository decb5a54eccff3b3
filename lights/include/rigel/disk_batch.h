// One disk light at many points at once, in vectors as wide as the machine's (Highway, chosen at run time): what
// disk.h and near_light.h compute point by point, for those who have their points in structure of arrays.
#pragma once

#include <rigel/disk.h>
#include <rigel/light.h>

#include <cstddef>
#include <span>

namespace rigel {

/// Points or unit vectors, structure of arrays: three spans of one length, of any alignment.
struct Vec3Rows {
  std::span<const float> x, y, z;
  std::size_t size() const noexcept { return x.size(); }
};

/// SH that the disk gives per unit radiance: coefficient i at points[k] is sh[i * points.size() + k], and what each
/// colour of the light gives is that times its radiance. B in 2..5; sh holds B^2 numbers a point and overlaps no input.
/// Any count, none included. Up to rounding (1e-6 of the vector's norm) what projectDisk gives; 0 where a point holds a
/// NaN or is infinitely far. About 4 ns a point (3 bands, 6 nodes, AVX2). No allocation; any number of threads.
template <int B>
void projectDiskBatch(const DiskLight& light, const Vec3Rows& points, DiskNodes nodes, std::span<float> sh) noexcept;

/// Lambert irradiance per unit radiance at points with unit normals, clipped at the horizon: up to rounding what
/// nearIrradiance gives. irradiance[k] belongs to points[k].
void diskIrradianceBatch(const DiskLight& light, const Vec3Rows& points, const Vec3Rows& normals,
                         std::span<float> irradiance) noexcept;

}  // namespace rigel
