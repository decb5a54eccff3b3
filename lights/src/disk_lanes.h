// The shaders' text on disk lights for Lane, and disk and points as it reads them. Included once per Highway target,
// after <hwy/highway.h>; what that text includes has to be there already, for it is not to be compiled for the target.
#if defined(RIGEL_DISK_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_DISK_LANES_H
#undef RIGEL_DISK_LANES_H
#else
#define RIGEL_DISK_LANES_H
#endif

#include "lane.h"

#undef RIGEL_FUNCTION
#define RIGEL_FUNCTION HWY_INLINE
#undef RIGEL_SHADER_NAMESPACE
#define RIGEL_SHADER_NAMESPACE rigel::HWY_NAMESPACE
#undef RIGEL_SHADER_DISK_H
#undef RIGEL_SHADER_DISK_IRRADIANCE_H
#undef RIGEL_SHADER_DISK_VIEW_H

HWY_BEFORE_NAMESPACE();
#include <rigel/shader_disk_irradiance.h>
#include <rigel/shader_disk_view.h>

namespace rigel::HWY_NAMESPACE {

constexpr std::size_t kDiskBlockLanes = kPointBlock / Lane::kCount;

/// What of a block's points needs more digits than floats: v . a, and |v|^2 - 1, in radii (shader_disk_view.h).
struct alignas(64) DiskGaps {
  float along[kPointBlock];
  float m[kPointBlock];
};

inline HWY_NOINLINE void gapsOfBlock(const DiskBatchLight& light, const float* x, const float* y, const float* z,
                                     std::size_t count, DiskGaps& gaps) {
  const DoubleLane perRadius(light.perRadius), perSquare(light.perRadius * light.perRadius);
  const DoubleLane ax(light.axis.x), ay(light.axis.y), az(light.axis.z);
  const DoubleLane px(light.position.x), py(light.position.y), pz(light.position.z);
  for (std::size_t i = 0; i < count; i += DoubleLane::kCount) {
    const DoubleLane dx = px - loadWidened(x + i), dy = py - loadWidened(y + i), dz = pz - loadWidened(z + i);
    storeNarrowed((dx * ax + dy * ay + dz * az) * perRadius, gaps.along + i);
    storeNarrowed((dx * dx + dy * dy + dz * dz) * perSquare - DoubleLane(1.0), gaps.m + i);
  }
}

HWY_INLINE DiskView<Lane> viewFrom(const DiskBatchLight& light, const float* x, const float* y, const float* z,
                                   const float* alongs, const float* ms) {
  const Lane perRadius(light.perRadius);
  Lane vx = (Lane(light.position.x) - Lane::load(x)) * perRadius;
  Lane vy = (Lane(light.position.y) - Lane::load(y)) * perRadius;
  Lane vz = (Lane(light.position.z) - Lane::load(z)) * perRadius;
  Lane along = Lane::load(alongs);
  Lane m = Lane::load(ms);
  const bool near = all(m < Lane(kRigelDiskReach * kRigelDiskReach));
  Lane dimmed(1.0f);
  if (!near) {
    // Held to the reach, and dimmed for that. NaN and infinity fail every comparison: they are put into the plane,
    // where there is no light.
    const Lane reach = abs(vx) + abs(vy) + abs(vz);
    const Lane held = min(Lane(kRigelDiskReach) / reach, Lane(1.0f));
    const auto there = reach < Lane(std::numeric_limits<float>::infinity());
    vx = select(there, vx * held, Lane(0.0f));
    vy = select(there, vy * held, Lane(0.0f));
    vz = select(there, vz * held, Lane(0.0f));
    along = select(there, along * held, Lane(0.0f));
    m = select(held < Lane(1.0f), vx * vx + vy * vy + vz * vz, m);
    m = select(there, m, Lane(0.0f));
    dimmed = held * held;
  }
  const DiskPlace<Lane> place =
      diskPlace(vx, vy, vz, Lane(light.axis.x), Lane(light.axis.y), Lane(light.axis.z), along, Lane(light.behind));
  DiskView<Lane> view = diskView(place, m);
  if (!near) view.flux = select(place.z > Lane(0.0f), view.flux * dimmed, Lane(0.0f));
  return view;
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
