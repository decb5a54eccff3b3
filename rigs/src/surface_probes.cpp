#include "surface_probes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rigel {
namespace {

constexpr int kPerAnchor = 3;

// Of points, so many for each probe tell how far the surface is from them all.
constexpr std::size_t kTelling = 4;

/// Anchors and probes together, where the surface has as many points.
std::size_t pointsOf(std::size_t surface) noexcept { return std::clamp<std::size_t>(surface * 3 / 7, 256, 1024); }

float squaredDistance(Vec3 a, Vec3 b) noexcept { return dot(a - b, a - b); }

/// In the units of SurfaceProbes::patches; 0 along an axis of no extent.
Vec3 perHalf(Vec3 offset, Vec3 half) noexcept {
  for (int a = 0; a < 3; ++a) offset[a] = half[a] > 0 ? offset[a] / half[a] : 0;
  return offset;
}

Eigen::Vector3d widened(Vec3 v) noexcept { return Eigen::Vector3f(v.x, v.y, v.z).cast<double>(); }

/// Ellipsoids with room for more than the surface's own points, and with those that are nearest to each probe in it.
void measurePatches(std::span<const Vec3> surface, std::span<const Vec3> points, SurfaceProbes& out) {
  // A flat disk of radius r has second moments r^2/4.
  constexpr float kAround = 1.4f;
  constexpr double kMoments = 4 / (double{kAround} * double{kAround}), kRoom = 1.5, kLeast = 1e-3;
  constexpr double kReach = 1.2;  // between the surface's own points
  const float around = kAround * out.fineCover;
  std::vector<int> nearest(surface.size());
  std::vector<float> distance(surface.size(), std::numeric_limits<float>::max());
  for (std::size_t p = 0; p < points.size(); ++p) {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    int count = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const float d = squaredDistance(surface[i], points[p]);
      if (d < distance[i]) {
        distance[i] = d;
        nearest[i] = static_cast<int>(p);
      }
      if (!(d < around * around) || !(d > 0)) continue;
      const Eigen::Vector3d x = widened(perHalf(surface[i] - points[p], out.half));
      moments += x * x.transpose();
      ++count;
    }
    moments *= kRoom * kMoments / std::max(count, 1);
    // A little in every direction, or it would have no inverse.
    for (int a = 0; a < 3; ++a) {
      const double least = out.half[a] > 0 ? kLeast * static_cast<double>(out.fineCover / out.half[a]) : kLeast;
      moments(a, a) += least * least;
    }
    out.patches.push_back(ProbePatch(moments));
  }
  for (std::size_t i = 0; i < surface.size(); ++i)
    out.patches[nearest[i]].hold(kReach * widened(perHalf(surface[i] - points[nearest[i]], out.half)));
}

}  // namespace

Vec3 SurfaceProbes::posed(const Probe& probe, Vec3 anchor, const RigBox& box) const noexcept {
  Vec3 p;
  for (int a = 0; a < 3; ++a)
    p[a] = std::clamp(anchor[a] + probe.offset[a] * (box.hi[a] * 0.5f - box.lo[a] * 0.5f), box.lo[a], box.hi[a]);
  return p;
}

float SurfaceProbes::stretch(const RigBox& box) const noexcept {
  float most = 1;
  for (int a = 0; a < 3; ++a)
    if (half[a] > 0) most = std::max(most, (box.hi[a] * 0.5f - box.lo[a] * 0.5f) / half[a]);
  return most;
}

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
  std::vector<Vec3> placed;
  const auto add = [&](Vec3 p, int anchor) {
    out.probes.push_back({anchor, perHalf(p - surface[anchors[anchor]], out.half)});
    placed.push_back(p);
  };
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
      add(p, a);
      for (std::size_t i = 0; i < surface.size(); ++i)
        if (patch[i] == a) distance[i] = std::min(distance[i], squaredDistance(surface[i], p));
    }
  }
  // The surface goes on between its own points, by about their spacing.
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const float points = static_cast<float>(population[patch[i]]) / (1 + kPerAnchor);
    out.cover = std::max(out.cover, std::sqrt(distance[i]) * (1 + 1 / std::sqrt(std::max(1.0f, points))));
  }
  out.few = static_cast<int>(out.probes.size());
  if (!rest.tightBounds) return out;

  // The same over all of the surface. Half of its points' spacing follows from how far apart fewer of them are.
  const std::size_t most = pointsOf(surface.size());
  float spacing = 0;
  for (std::size_t points = anchors.size() + out.probes.size();; ++points) {
    const auto farthest = std::ranges::max_element(distance);
    const float reach = std::sqrt(*farthest);
    const float share = static_cast<float>(points) / static_cast<float>(surface.size());
    if (spacing == 0 || kTelling * points <= surface.size()) spacing = reach * std::sqrt(std::min(1.0f, share));
    out.fineCover = reach + spacing;
    if (points >= most || !(reach > 0)) break;
    const auto i = static_cast<std::size_t>(farthest - distance.begin());
    add(surface[i], patch[i]);
    for (std::size_t k = 0; k < surface.size(); ++k)
      distance[k] = std::min(distance[k], squaredDistance(surface[k], surface[i]));
  }
  std::vector<Vec3> points;
  for (const int anchor : anchors) points.push_back(surface[anchor]);
  points.insert(points.end(), placed.begin(), placed.end());
  measurePatches(surface, points, out);
  return out;
}

}  // namespace rigel
