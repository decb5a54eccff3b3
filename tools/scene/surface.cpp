// Sample points on a surface. The three dimensions (place within the share, two barycentrics) follow the R3 sequence:
// M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018 (multiples of the inverse powers of the
// root of x^4 = x + 1), shifted by the seed.
#include "scene/surface.h"

#include "scene/transform.h"

#include <rigel/glm.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rigel::tools {
namespace {

constexpr double kRoot = 1.2207440846057594753616853491088319144;
constexpr double kStep[3] = {1 / kRoot, 1 / (kRoot * kRoot), 1 / (kRoot * kRoot * kRoot)};

double fraction(double x) { return x - std::floor(x); }

// Three shifts in [0, 1) out of the seed, by the finaliser of MurmurHash3 on a Weyl sequence (SplitMix64).
struct Shifts {
  double s[3];
  explicit Shifts(std::uint32_t seed) {
    std::uint64_t state = seed;
    for (double& shift : s) {
      std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      z ^= z >> 31;
      shift = static_cast<double>(z >> 11) * 0x1p-53;
    }
  }
};

double triangleArea(const PosedObject& posed, const glm::uvec3& t) {
  const glm::dvec3 a = posed.positions[t.x], b = posed.positions[t.y], c = posed.positions[t.z];
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

Result<std::vector<SurfacePoint>> sampleSurface(const SceneObject& object, const PosedObject& rest, int count,
                                                std::uint32_t seed) {
  if (count < 1) return Error{"needs at least one surface sample", "object \"" + object.name + "\""};
  std::vector<double> areaUpTo(object.triangles.size());
  double total = 0;
  for (std::size_t i = 0; i < areaUpTo.size(); ++i) {
    total += triangleArea(rest, object.triangles[i]);
    areaUpTo[i] = total;
  }
  if (!std::isfinite(total)) return Error{"its area is not finite", "object \"" + object.name + "\""};
  if (!(total > 0)) return Error{"has no area: nothing to light", "object \"" + object.name + "\""};

  const Shifts shifts(seed);
  // The first triangle at which the running area reaches the total: none beyond it has an area.
  const auto lastUsed = std::lower_bound(areaUpTo.begin(), areaUpTo.end(), total);
  std::vector<SurfacePoint> points(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    double u[3];
    for (int d = 0; d < 3; ++d) u[d] = fraction(shifts.s[d] + i * kStep[d]);
    const double area = (i + u[0]) / count * total;
    const auto found = std::min(std::upper_bound(areaUpTo.begin(), areaUpTo.end(), area), lastUsed);
    if (u[1] + u[2] > 1) {
      u[1] = 1 - u[1];
      u[2] = 1 - u[2];
    }
    points[i] = {static_cast<std::uint32_t>(found - areaUpTo.begin()), static_cast<float>(u[1]),
                 static_cast<float>(u[2])};
  }
  return points;
}

Vec3 surfacePosition(const SceneObject& object, const PosedObject& posed, SurfacePoint point) {
  const glm::uvec3& t = object.triangles[point.triangle];
  return fromGlm((1 - point.b1 - point.b2) * posed.positions[t.x] + point.b1 * posed.positions[t.y] +
                 point.b2 * posed.positions[t.z]);
}

PointAndNormal evaluateSurface(const SceneObject& object, const PosedObject& posed, SurfacePoint point) {
  const glm::uvec3& t = object.triangles[point.triangle];
  const float b0 = 1 - point.b1 - point.b2;
  const glm::vec3 &n0 = posed.normals[t.x], &n1 = posed.normals[t.y], &n2 = posed.normals[t.z];
  glm::vec3 normal = b0 * n0 + point.b1 * n1 + point.b2 * n2;
  // Of unit normals at most 1e-3 remains only where they all but cancel and rounding decides the direction.
  if (glm::dot(normal, normal) > 1e-6f) {
    normal = glm::normalize(normal);
  } else {
    // In double, where the product of two edges of any length neither overflows nor vanishes.
    const glm::dvec3 p0 = posed.positions[t.x], p1 = posed.positions[t.y], p2 = posed.positions[t.z];
    const glm::dvec3 own = glm::cross(p1 - p0, p2 - p0);
    const double size = glm::length(own);
    normal = size > 0 && std::isfinite(size) ? glm::vec3(own / size) : glm::vec3(0);
    // A triangle that the pose collapsed has no normal of its own: any vertex normal, or up, keeps the point lit.
    for (const glm::vec3& n : {n0, n1, n2, glm::vec3(0, 1, 0)}) {
      if (normal == glm::vec3(0)) normal = n;
    }
  }
  return {surfacePosition(object, posed, point), fromGlm(normal)};
}

}  // namespace rigel::tools
