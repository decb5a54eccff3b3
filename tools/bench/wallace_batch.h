// The form factor of Wallace, Elmquist and Haines for many points at once: what our disk kernels are measured against,
// vector against vector.
#pragma once

#include <rigel/light.h>

#include <span>

namespace rigel::tools {

/// Irradiance of unit radiance [W/m2] that a one-sided disk gives at points (x, y, z) with unit normals (nx, ny, nz),
/// as published: pi A cos cos' / (pi r^2 + A), the disk's centre standing for all of it. Wallace, Elmquist, Haines, "A
/// Ray Tracing Algorithm for Progressive Radiosity", 1989. Spans of one length; Highway takes the widest vectors there
/// are.
void wallaceBatch(const DiskLight& light, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                  std::span<const float> nx, std::span<const float> ny, std::span<const float> nz,
                  std::span<float> irradiance);

}  // namespace rigel::tools
