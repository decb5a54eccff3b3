// What the batches of disk_batch.h read of a light, the same for all Highway targets.
#pragma once

#include <rigel/disk_batch.h>
#include <rigel/shader_constants.h>
#include <rigel/shader_language.h>

#include <algorithm>
#include <limits>

#include "vec3d.h"

namespace rigel {

/// Points go through the stages of a kernel in blocks, which between two stages stay in the first-level cache.
inline constexpr std::size_t kDiskBlock = 64;

struct DiskBatchLight {
  Vec3 position;
  detail::Vec3d axis;    // unit
  double perRadius = 0;  // 0: no light
  float behind = 0;      // as GpuNearLight::cosOuter

  explicit DiskBatchLight(const DiskLight& light) noexcept
      : position(light.position), axis(detail::directionOf(light.direction)), behind(light.twoSided ? -1.0f : 0.0f) {
    const bool shines = light.radius > 0 && detail::dot(axis, axis) > 0;
    const double radius = std::min<double>(light.radius, std::numeric_limits<float>::max());
    if (shines) perRadius = 1 / radius;
  }
};

}  // namespace rigel
