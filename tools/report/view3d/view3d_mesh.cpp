// J. Rossignac, P. Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993.
#include "report/view3d/view3d_mesh.h"

#include <rigel/glm.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace rigel::tools {
namespace {

constexpr SurfacePoint corner(std::size_t triangle, std::size_t which) {
  return {static_cast<std::uint32_t>(triangle), which == 1 ? 1.0f : 0.0f, which == 2 ? 1.0f : 0.0f};
}

struct Vertex {
  glm::dvec3 position;
  glm::vec3 normal;
};

/// Which vertices are one.
struct Clustering {
  std::vector<std::uint32_t> clusterOf;  // per vertex
  std::size_t count = 0;
};

/// A grid over the vertices' box.
class Grid {
 public:
  explicit Grid(std::span<const Vertex> vertices) : lo_(std::numeric_limits<double>::infinity()) {
    glm::dvec3 hi(-lo_);
    for (const Vertex& vertex : vertices) {
      lo_ = glm::min(lo_, vertex.position);
      hi = glm::max(hi, vertex.position);
    }
    const glm::dvec3 size = hi - lo_;
    extent_ = std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
  }

  static constexpr double kFinest = 65535;  // cells: 16 bits an axis

  /// `cells` along the longest side; normals told apart by `steps` an axis (at most 15), 0: by the axis they are
  /// nearest to.
  Clustering cluster(std::span<const Vertex> vertices, double cells, int steps) const {
    Clustering out;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    for (const Vertex& vertex : vertices) {
      const std::uint64_t key = cellOf(vertex.position, cells) << 15 | classOf(vertex.normal, steps);
      out.clusterOf.push_back(numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second);
    }
    out.count = numbers.size();
    return out;
  }

 private:
  std::uint64_t cellOf(const glm::dvec3& p, double cells) const {
    std::uint64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis)
      cell = cell << 16 |
             static_cast<std::uint64_t>(std::clamp((p[axis] - lo_[axis]) / extent_ * cells + 0.5, 0.0, kFinest));
    return cell;
  }

  static std::uint64_t classOf(const glm::vec3& n, int steps) {
    if (steps == 0) {
      const glm::vec3 size = glm::abs(n);
      const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      return static_cast<std::uint64_t>(2 * axis + (n[axis] < 0));
    }
    std::uint64_t id = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float step = std::clamp(n[axis], -1.0f, 1.0f) * static_cast<float>(steps);
      id = id << 5 | static_cast<std::uint64_t>(std::lround(step) + steps);
    }
    return id;
  }

  glm::dvec3 lo_;
  double extent_ = 1;
};

/// With at most `most` clusters, if possible not far below.
Clustering coarser(const Grid& grid, std::span<const Vertex> vertices, std::size_t most) {
  constexpr int kAttempts = 8;
  constexpr double kEnough = 0.97;                 // of `most`
  Clustering best = grid.cluster(vertices, 0, 0);  // at most six: an axis and a sign each
  if (best.count > most) return {std::vector<std::uint32_t>(vertices.size(), 0), 1};
  double cells = std::sqrt(static_cast<double>(most) / 3), fits = 0, tooFine = Grid::kFinest;
  for (int i = 0; i < kAttempts && static_cast<double>(best.count) < kEnough * static_cast<double>(most); ++i) {
    Clustering tried = grid.cluster(vertices, cells, 0);
    (tried.count <= most ? fits : tooFine) = cells;
    // A surface meets cells as the square of their number.
    const double guess = cells * std::sqrt(0.99 * static_cast<double>(most) / static_cast<double>(tried.count));
    cells = guess > fits && guess < tooFine ? guess : (fits + tooFine) / 2;
    if (tried.count <= most && tried.count > best.count) best = std::move(tried);
  }
  return best;
}

/// Of each cluster the vertex nearest to the mean of all.
std::vector<std::uint32_t> representatives(std::span<const Vertex> vertices, const Clustering& clusters) {
  std::vector<glm::dvec4> sums(clusters.count, glm::dvec4(0));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    sums[clusters.clusterOf[i]] += glm::dvec4(vertices[i].position, 1.0);
  std::vector<std::uint32_t> nearest(clusters.count, 0);
  std::vector<double> least(clusters.count, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t k = clusters.clusterOf[i];
    const glm::dvec3 away = vertices[i].position - glm::dvec3(sums[k]) / sums[k].w;
    const double distance = glm::dot(away, away);
    if (!(distance < least[k])) continue;
    nearest[k] = static_cast<std::uint32_t>(i);
    least[k] = distance;
  }
  return nearest;
}

}  // namespace

ViewMesh viewMesh(const SceneObject& object, const PosedObject& rest, std::size_t most) {
  assert(most >= 1 && most <= 65535);
  std::vector<Vertex> corners;
  for (std::size_t t = 0; t < object.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [p, n] = evaluateSurface(object, rest, corner(t, c));
      corners.push_back({toGlm(p), toGlm(n)});
    }
  constexpr int kNormalSteps = 15;  // of the same normal, rounded
  const Grid grid(corners);
  const Clustering welded = grid.cluster(corners, Grid::kFinest, kNormalSteps);
  std::vector<std::uint32_t> cornerOf = representatives(corners, welded);
  std::vector<std::uint32_t> vertexOf = welded.clusterOf;
  if (welded.count > most) {
    std::vector<Vertex> vertices;
    for (const std::uint32_t i : cornerOf) vertices.push_back(corners[i]);
    const Clustering fewer = coarser(grid, vertices, most);
    std::vector<std::uint32_t> kept = representatives(vertices, fewer);
    for (std::uint32_t& k : kept) k = cornerOf[k];
    for (std::uint32_t& k : vertexOf) k = fewer.clusterOf[k];
    cornerOf = std::move(kept);
  }

  ViewMesh mesh;
  for (const std::uint32_t i : cornerOf) mesh.vertices.push_back(corner(i / 3, i % 3));
  std::unordered_set<std::uint64_t> seen;
  for (std::size_t t = 0; t < object.triangles.size(); ++t) {
    std::array<std::uint16_t, 3> triangle;
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = static_cast<std::uint16_t>(vertexOf[3 * t + c]);
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    const std::uint64_t key = std::uint64_t{triangle[0]} << 32 | std::uint64_t{triangle[1]} << 16 | triangle[2];
    if (seen.insert(key).second) mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace rigel::tools
