// k-means after S. Lloyd, "Least squares quantization in PCM", 1982, seeded by the farthest-point order of T. Gonzalez,
// "Clustering to minimize the maximum intercluster distance", 1985.
#include "anchors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace rigel {
namespace {

constexpr int kIterations = 24;

float squaredDistance(Vec3 a, Vec3 b) noexcept { return dot(a - b, a - b); }

Vec3 meanOf(std::span<const Vec3> points) {
  Vec3 sum;
  for (Vec3 p : points) sum += p;
  return sum * (1 / static_cast<float>(points.size()));
}

std::vector<Vec3> farthestPoints(std::span<const Vec3> surface, int count) {
  std::vector<float> distance(surface.size(), std::numeric_limits<float>::max());
  std::vector<Vec3> chosen;
  Vec3 latest = meanOf(surface);
  while (static_cast<int>(chosen.size()) < count) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      distance[i] = std::min(distance[i], squaredDistance(surface[i], latest));
      if (distance[i] > distance[farthest]) farthest = i;
    }
    latest = surface[farthest];
    chosen.push_back(latest);
  }
  return chosen;
}

int nearest(std::span<const Vec3> centres, Vec3 p) noexcept {
  int best = 0;
  for (int i = 1; i < static_cast<int>(centres.size()); ++i)
    if (squaredDistance(p, centres[i]) < squaredDistance(p, centres[best])) best = i;
  return best;
}

}  // namespace

Anchors chooseAnchors(std::span<const Vec3> surface, int count, SurfaceEnds ends) {
  Anchors anchors;
  if (static_cast<int>(surface.size()) <= count) {
    for (int i = 0; i < static_cast<int>(surface.size()); ++i) anchors.index.push_back(i);
    anchors.share.assign(surface.size(), 1 / static_cast<float>(surface.size()));
    anchors.radius.assign(surface.size(), 0);
    return anchors;
  }

  std::vector<Vec3> centres;
  if (ends == SurfaceEnds::anchored)
    for (int i : endsOf(surface, count / 2)) centres.push_back(surface[i]);
  const int fixed = static_cast<int>(centres.size());
  std::ranges::copy(farthestPoints(surface, count - fixed), std::back_inserter(centres));
  std::vector<int> cluster(surface.size());
  std::vector<int> population(count);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<Vec3> sum(count);
    population.assign(count, 0);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      cluster[i] = nearest(centres, surface[i]);
      sum[cluster[i]] += surface[i];
      ++population[cluster[i]];
    }
    for (int c = fixed; c < count; ++c)
      if (population[c] > 0) centres[c] = sum[c] * (1 / static_cast<float>(population[c]));
  }

  // The medoid is the cluster's own point nearest its centre: a mean need not lie on the surface. Clusters that
  // coincident points left empty drop out.
  std::vector<int> medoid(count, -1);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    int& best = medoid[cluster[i]];
    const Vec3 centre = centres[cluster[i]];
    if (best < 0 || squaredDistance(surface[i], centre) < squaredDistance(surface[best], centre))
      best = static_cast<int>(i);
  }
  std::vector<float> squares(count, 0);
  for (std::size_t i = 0; i < surface.size(); ++i)
    squares[cluster[i]] += squaredDistance(surface[i], surface[medoid[cluster[i]]]);
  for (int c = 0; c < count; ++c) {
    if (medoid[c] < 0) continue;
    anchors.radius.push_back(std::sqrt(2 * squares[c] / static_cast<float>(population[c])));
    anchors.index.push_back(medoid[c]);
    anchors.share.push_back(static_cast<float>(population[c]) / static_cast<float>(surface.size()));
  }
  return anchors;
}

Anchors patchesOf(std::span<const Vec3> surface, std::span<const int> index) {
  std::vector<Vec3> centres;
  for (int i : index) centres.push_back(surface[i]);
  std::vector<int> population(index.size());
  std::vector<float> squares(index.size());
  for (Vec3 p : surface) {
    const int c = nearest(centres, p);
    ++population[c];
    squares[c] += squaredDistance(p, centres[c]);
  }
  Anchors anchors;
  for (std::size_t c = 0; c < index.size(); ++c) {
    if (population[c] == 0) continue;
    const auto points = static_cast<float>(population[c]);
    anchors.index.push_back(index[c]);
    anchors.share.push_back(points / static_cast<float>(surface.size()));
    anchors.radius.push_back(std::sqrt(2 * squares[c] / points));
  }
  return anchors;
}

std::vector<int> endsOf(std::span<const Vec3> surface, int most) {
  std::vector<int> ends;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [first, last] = std::ranges::minmax_element(surface, {}, [axis](Vec3 p) { return p[axis]; });
    for (const auto end : {first, last}) {
      const bool known = std::ranges::any_of(ends, [&](int i) { return surface[i] == *end; });
      if (static_cast<int>(ends.size()) < most && !known) ends.push_back(static_cast<int>(end - surface.begin()));
    }
  }
  return ends;
}

}  // namespace rigel
