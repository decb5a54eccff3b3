#include "expect.h"
#include "report/run/run_settings.h"
#include "scene/gltf_load.h"
#include "scene/pose.h"
#include "scene/surface.h"
#include "targets.h"

#include <cmath>

namespace rigel::fuzz {
namespace {

using namespace rigel::tools;

// A few bytes may name millions of vertices, which are checked elsewhere and would only make this slow.
constexpr int kMostVertices = 100'000;

bool isFinite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void useObject(const Scene& scene, const SceneObject& object, const ScenePose& pose) {
  PosedObject posed;
  poseObject(scene, object, pose, posed);
  expect(posed.positions.size() == static_cast<std::size_t>(object.vertexCount), "every vertex is posed");
  for (const glm::uvec3& t : object.triangles)
    expect(t.x < posed.positions.size() && t.y < posed.positions.size() && t.z < posed.positions.size(),
           "triangles have vertices");
  const auto points = sampleSurface(object, posed, 16, 1);
  if (!points) return;
  for (const SurfacePoint& point : *points)
    expect(isFinite(evaluateSurface(object, posed, point).normal), "normals are finite");
}

}  // namespace

void gltf(std::string_view bytes) {
  const auto scene = loadGltfFromMemory(std::string(bytes), "fuzz");
  if (!scene) {
    const std::string line = scene.error().line();
    expect(line.find('\n') == std::string::npos && line.starts_with("fuzz: "), "an error is one line: " + line);
    return;
  }
  if (const auto settings = parseRunSettings(scene->settings); !settings) {
    const std::string line = settings.error().line();
    expect(scene->settings.empty() || line.find('\n') == std::string::npos, "an error is one line: " + line);
  }
  const std::vector<SceneObject> objects = findObjects(*scene);
  ScenePose pose;
  PosedLights lights;
  const int clips = std::min(static_cast<int>(scene->animations.size()), 4);
  for (int clip = kRestPose; clip < clips; ++clip) {
    poseScene(*scene, clip, 0.3, pose);
    poseLights(*scene, pose, lights);
    expect(lights.names.size() == static_cast<std::size_t>(lights.set.size()), "every light has a name");
    int vertices = 0;
    for (const SceneObject& object : objects) {
      if ((vertices += object.vertexCount) > kMostVertices) break;
      useObject(*scene, object, pose);
    }
  }
}

}  // namespace rigel::fuzz
