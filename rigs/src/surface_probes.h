// Points of the surface between the anchors, for those who must know how a rig behaves there.
#pragma once

#include <rigel/rig.h>

namespace rigel {

/// The extremes of each anchor's patch of surface, as the anchor plus an offset. They follow a pose by their anchor and
/// by the box's extent.
struct SurfaceProbes {
  struct Probe {
    int anchor = 0;  // index into Rig::anchors()
    Vec3 offset;     // per half extent of the box
  };
  std::vector<Probe> probes;
  float cover = 0;  // m; every point of the rest surface is as close as this to an anchor or a probe
  Vec3 half;        // of the rest box
};

/// Cost: surface points x (anchors + 3). Allocates.
SurfaceProbes probeSurface(const RigShape& rest, std::span<const int> anchors);

}  // namespace rigel
