// What rigs are measured against in one frame: exact irradiance, and SH of the same bands at every point.
#pragma once

#include "parallel/parallel.h"
#include "report/measure/surface_set.h"

#include <rigel/exact.h>

#include <algorithm>
#include <vector>

namespace rigel::tools {

/// World-space measured points of a frame with their reference values.
struct Truth {
  std::vector<PointAndNormal> points;
  std::vector<RgbD> exact;  // true light shape, horizon clipped, true wrap kernel, in double
  std::vector<Rgb> sh;      // irradiance of the point's own SH, unclamped: what a perfect rig would give
  double mean = 0;          // of `exact` over points and channels

  /// Irradiance at the points of their own SH of `lights`, for rigs that leave part of the light to exact evaluation.
  void project(const LightSet& lights, const SurfaceSet& surface, int bands, std::vector<Rgb>& out) const;

  /// Fills everything; uses all cores. Reuses the vectors.
  void update(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface, const LightSet& lights,
              int bands);
};

/// Mean exact irradiance over a few of an object's measured points: the scale of a run's errors before it is measured.
double quickMean(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface,
                 const LightSet& lights);

/// Calls body(i) for each of `count` samples, on all cores.
template <class Body>
void forSamples(std::size_t count, const Body& body) {
  // Enough samples a block that handing it out costs nothing, few enough that the last block is short.
  constexpr std::size_t kBlock = 64;
  parallelFor(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
    const std::size_t first = kBlock * static_cast<std::size_t>(block);
    for (std::size_t i = first; i < std::min(first + kBlock, count); ++i) body(i);
  });
}

/// Calls `f.template operator()<B>()` for a run-time band count from 2 to 5.
template <class F>
decltype(auto) withBands(int bands, F&& f) {
  switch (bands) {
    case 2:
      return f.template operator()<2>();
    case 4:
      return f.template operator()<4>();
    case 5:
      return f.template operator()<5>();
    default:
      return f.template operator()<3>();
  }
}

}  // namespace rigel::tools
