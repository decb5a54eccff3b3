// Area-stratified points on an object's surface that ride on its pose.
#pragma once

#include "scene/pose.h"

namespace rigel::tools {

/// A point of a triangle, by barycentric coordinates of its corners (b0 = 1 - b1 - b2).
struct SurfacePoint {
  std::uint32_t triangle = 0;
  float b1 = 0, b2 = 0;
};

struct PointAndNormal {
  Vec3 position;  // world
  Vec3 normal;    // world, unit; interpolated, or the triangle's own where the mesh has none or they cancel
};

/// `count` points, area-stratified over the object in `rest` (point i lies in the i-th of `count` equal shares of the
/// area, in triangle order), reproducible for a `seed`. Error when the object has no area.
Result<std::vector<SurfacePoint>> sampleSurface(const SceneObject& object, const PosedObject& rest, int count,
                                                std::uint32_t seed);

/// World position alone, for points that need no normal.
Vec3 surfacePosition(const SceneObject& object, const PosedObject& posed, SurfacePoint point);

PointAndNormal evaluateSurface(const SceneObject& object, const PosedObject& posed, SurfacePoint point);

}  // namespace rigel::tools
