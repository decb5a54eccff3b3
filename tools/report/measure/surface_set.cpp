#include "report/measure/surface_set.h"

#include <rigel/glm.h>

#include <algorithm>
#include <limits>
#include <map>

namespace rigel::tools {
namespace {

// Fixed seeds: the same file gives the same figures.
constexpr std::uint32_t kMeasuredSeed = 1;
constexpr std::uint32_t kCandidateSeed = 2;

/// The first of `wanted` that has a direction left when made perpendicular to `other` (unit, or zero for none), as a
/// unit vector; else an axis so made.
glm::dvec3 firstDirection(std::initializer_list<glm::dvec3> wanted, const glm::dvec3& other) {
  constexpr double kLeast = 1e-9;  // of a vector's length: what remains of less is rounding
  const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  glm::dvec3 direction{0};
  const auto leaves = [&](const glm::dvec3& v) {
    const glm::dvec3 left = v - other * glm::dot(v, other);
    const double size = glm::length(left);
    if (!(size > kLeast * glm::length(v))) return false;  // NaN too
    direction = left / size;
    return true;
  };
  if (std::ranges::none_of(wanted, leaves)) std::ranges::any_of(axes, leaves);
  return direction;
}

}  // namespace

RigFrame rigidFrame(const glm::mat4& worldFromNode) {
  const glm::dmat4 m(worldFromNode);
  // A node flattened along one axis still turns: its other two columns say how.
  const glm::dvec3 x = firstDirection({glm::dvec3(m[0]), glm::cross(glm::dvec3(m[1]), glm::dvec3(m[2]))}, {0, 0, 0});
  const glm::dvec3 y = firstDirection({glm::dvec3(m[1]), glm::cross(glm::dvec3(m[2]), x)}, x);
  const glm::dvec3 z = glm::cross(x, y);
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

float commonWrap(std::span<const float> wraps) {
  std::map<float, int> counts;
  for (const float wrap : wraps) ++counts[wrap];
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

}  // namespace rigel::tools
