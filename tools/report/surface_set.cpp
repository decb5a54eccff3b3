#include "report/surface_set.h"

#include <rigel/glm.h>

#include <limits>

namespace rigel::tools {
namespace {

// Fixed seeds: the same file gives the same figures.
constexpr std::uint32_t kMeasuredSeed = 1;
constexpr std::uint32_t kCandidateSeed = 2;

/// `v` made perpendicular to `others` and unit, or an axis made so where nothing of v is left.
glm::dvec3 orthonormal(glm::dvec3 v, std::initializer_list<glm::dvec3> others) {
  const double size = glm::length(v);
  for (int attempt = 0;; ++attempt) {
    for (const glm::dvec3& other : others) v -= other * glm::dot(v, other);
    const double left = glm::length(v);
    if (left > 1e-9 * (attempt == 0 ? size : 1.0)) return v / left;
    v = glm::dvec3(attempt == 0, attempt == 1, attempt == 2);
  }
}

}  // namespace

RigFrame rigidFrame(const glm::mat4& worldFromNode) {
  const glm::dmat4 m(worldFromNode);
  const glm::dvec3 x = orthonormal(glm::dvec3(m[0]), {});
  const glm::dvec3 y = orthonormal(glm::dvec3(m[1]), {x});
  const glm::dvec3 z = orthonormal(glm::dvec3(m[2]), {x, y});
  return {fromGlm(glm::vec3(x)), fromGlm(glm::vec3(y)), fromGlm(glm::vec3(z)), fromGlm(glm::vec3(m[3]))};
}

RigBox rigBox(const RigFrame& worldFromRig, const PosedObject& posed) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  RigBox box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const glm::vec3& world : posed.positions) {
    const Vec3 p = worldFromRig.inversePoint(fromGlm(world));
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis]);
      box.hi[axis] = std::max(box.hi[axis], p[axis]);
    }
  }
  return box;
}

Result<SurfaceSet> chooseSurface(const SceneObject& object, const PosedObject& rest, int measured,
                                 std::optional<float> wrap) {
  auto points = sampleSurface(object, rest, measured, kMeasuredSeed);
  if (!points) return points.error();
  auto candidates = sampleSurface(object, rest, kRigCandidates, kCandidateSeed);
  if (!candidates) return candidates.error();
  SurfaceSet set{*std::move(points), *std::move(candidates), {}};
  for (const SurfacePoint& point : set.measured) set.wrap.push_back(wrap.value_or(object.triangleWrap[point.triangle]));
  return set;
}

}  // namespace rigel::tools
