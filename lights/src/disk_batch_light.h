// What the batches of disk_batch.h read of a light, the same for all Highway targets.
#pragma once

#include <rigel/disk_batch.h>
#include <rigel/near_light.h>
#include <rigel/shader_constants.h>
#include <rigel/shader_language.h>

#include <algorithm>
#include <limits>

#include "point_block.h"
#include "vec3d.h"

namespace rigel {

struct DiskBatchLight {
  Vec3 position;
  detail::Vec3d axis;    // unit
  double perRadius = 0;  // 0: no light
  float behind = 0;      // as GpuNearLight::cosOuter

  explicit DiskBatchLight(const DiskLight& light) noexcept
      : DiskBatchLight(light.position, light.direction, light.radius, light.twoSided ? -1.0f : 0.0f) {}
  explicit DiskBatchLight(const NearLight& light) noexcept
      : DiskBatchLight(light.position, light.axis, light.radius, light.cosOuter) {}

 private:
  DiskBatchLight(Vec3 centre, Vec3 direction, float size, float emitsBehind) noexcept
      : position(centre), axis(detail::directionOf(direction)), behind(emitsBehind) {
    const bool shines = size > 0 && detail::dot(axis, axis) > 0;
    const double radius = std::min<double>(size, std::numeric_limits<float>::max());
    if (shines) perRadius = 1 / radius;
  }
};

}  // namespace rigel
