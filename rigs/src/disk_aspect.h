// How the points that a rig serves, or its samples, lie before a disk light.
#pragma once

#include "light_place.h"

namespace rigel {

/// How a region lies before a disk, whose side is that of the region's centre where both faces emit.
struct DiskAspect {
  double low = 0, high = 0;     // heights over the disk's plane, least and largest; high >= 0
  double share = 1;             // of its light: falls to 0 within `margin` behind the plane, where there is none
  double gap = 0;               // distance to the disk itself, or less
  double off = 0, offMost = 0;  // distances from the disk's axis
  double near = 0;              // distance from the disk's centre to the nearest point
  Interval cosine;              // of directions from any point of the disk, within [0, 1]
  std::array<Front, 2> front;   // of the region's box and of its ball
};

/// Of a region that is behind the disk by less than `margin` it is what it would be at the plane.
DiskAspect diskAspect(const Region& region, const Triple& axis, double radius, bool twoSided, double margin) noexcept;

}  // namespace rigel
