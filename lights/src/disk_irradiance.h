// A disk light of the near path at one point, in float.
#pragma once

#include <rigel/near_light.h>

namespace rigel::detail {

/// Irradiance over the light's colour and share; `light` is a disk.
float diskIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept;
float diskCheap(const NearLight& light, Vec3 p, Vec3 n) noexcept;
float diskCorrector(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept;

}  // namespace rigel::detail
