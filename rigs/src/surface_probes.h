// Points of the surface between the anchors, for those who must know how a rig behaves there.
#pragma once

#include <rigel/rig.h>

#include "probe_patch.h"

namespace rigel {

/// The extremes of each anchor's patch of surface, as the anchor plus an offset. They follow a pose by their anchor and
/// by the box's extent.
struct SurfaceProbes {
  struct Probe {
    int anchor = 0;  // index into Rig::anchors()
    Vec3 offset;     // per half extent of the box
  };
  std::vector<Probe> probes;
  std::vector<ProbePatch> patches;  // with RigShape::tightBounds: of the anchors, then of the probes; per half extent
  int few = 0;                      // the first of them, three an anchor at most
  float cover = 0;      // m; every point of the rest surface is as close as this to an anchor or one of these few
  float fineCover = 0;  // m; or to an anchor or any probe
  Vec3 half;            // of the rest box

  /// Where a probe is in a pose with its anchor there, and what lengths are to be multiplied by.
  Vec3 posed(const Probe& probe, Vec3 anchor, const RigBox& box) const noexcept;
  float stretch(const RigBox& box) const noexcept;
};

/// Probes beyond the few and patches only with RigShape::tightBounds: 256 to 1024 points with the anchors, of a surface
/// of 600 to 2400 points, which has to tell how far it is from them all. Cost: surface points x (anchors + 3), then x
/// points. Allocates.
SurfaceProbes probeSurface(const RigShape& rest, std::span<const int> anchors);

}  // namespace rigel
