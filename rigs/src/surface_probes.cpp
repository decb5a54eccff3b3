#include "surface_probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

constexpr int kPerAnchor = 3;

float squaredDistance(Vec3 a, Vec3 b) noexcept { return dot(a - b, a - b); }

}  // namespace

SurfaceProbes probeSurface(const RigShape& rest, std::span<const int> anchors) {
  SurfaceProbes out;
  out.half = rest.box.hi * 0.5f - rest.box.lo * 0.5f;
  if (anchors.empty()) return out;
  const std::span<const Vec3> surface = rest.surface;
  const auto count = static_cast<int>(anchors.size());
  std::vector<int> patch(surface.size());
  std::vector<int> population(anchors.size());
  std::vector<float> distance(surface.size(), std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    for (int a = 0; a < count; ++a) {
      const float d = squaredDistance(surface[i], surface[anchors[a]]);
      if (d < distance[i]) {
        distance[i] = d;
        patch[i] = a;
      }
    }
    ++population[patch[i]];
  }
  // Farthest points of each patch, one after another (T. Gonzalez 1985).
  for (int round = 0; round < kPerAnchor; ++round) {
    std::vector<int> farthest(anchors.size(), -1);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      int& best = farthest[patch[i]];
      if (distance[i] > 0 && (best < 0 || distance[i] > distance[best])) best = static_cast<int>(i);
    }
    for (int a = 0; a < count; ++a) {
      if (farthest[a] < 0) continue;
      const Vec3 p = surface[farthest[a]];
      Vec3 offset = p - surface[anchors[a]];
      for (int axis = 0; axis < 3; ++axis) offset[axis] = out.half[axis] > 0 ? offset[axis] / out.half[axis] : 0;
      out.probes.push_back({a, offset});
      for (std::size_t i = 0; i < surface.size(); ++i)
        if (patch[i] == a) distance[i] = std::min(distance[i], squaredDistance(surface[i], p));
    }
  }
  // The surface goes on between its own points, by about their spacing.
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const float points = static_cast<float>(population[patch[i]]) / (1 + kPerAnchor);
    out.cover = std::max(out.cover, std::sqrt(distance[i]) * (1 + 1 / std::sqrt(std::max(1.0f, points))));
  }
  return out;
}

}  // namespace rigel
