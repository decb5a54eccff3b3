#include "scene/transplant.h"

#include <rigel/glm.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace rigel::tools {
namespace {

struct Sphere {
  glm::vec3 centre{0};
  float radius = 0;
};

// The objects that count: those that get rigs, or all where everything is scenery.
std::vector<SceneObject> litObjects(const Scene& scene) {
  std::vector<SceneObject> objects = findObjects(scene);
  if (std::ranges::any_of(objects, [](const SceneObject& o) { return !o.isStatic; })) {
    std::erase_if(objects, [](const SceneObject& o) { return o.isStatic; });
  }
  return objects;
}

Sphere boundingSphere(const Scene& scene, const std::vector<SceneObject>& objects, const ScenePose& pose) {
  PosedObject posed;
  std::vector<glm::vec3> points;  // corners of triangles only: files may hold stray vertices
  for (const SceneObject& object : objects) {
    poseObject(scene, object, pose, posed);
    for (const glm::uvec3& t : object.triangles) {
      for (const glm::uint v : {t.x, t.y, t.z}) points.push_back(posed.positions[v]);
    }
  }
  if (points.empty()) return {};
  glm::vec3 low = points.front(), high = points.front();
  for (const glm::vec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  Sphere sphere{0.5f * low + 0.5f * high, 0};
  for (const glm::vec3& p : points) sphere.radius = std::max(sphere.radius, glm::distance(p, sphere.centre));
  return sphere;
}

int firstClip(const Scene& scene) { return scene.animations.empty() ? kRestPose : 0; }

}  // namespace

double LightTransplant::duration() const noexcept {
  return donor_.animations.empty() ? 0 : donor_.animations.front().duration;
}

Result<LightTransplant> LightTransplant::create(Scene donor, const Scene& target) {
  LightTransplant out;
  out.donor_ = std::move(donor);
  out.objects_ = litObjects(out.donor_);
  ScenePose pose;
  poseScene(out.donor_, firstClip(out.donor_), 0, pose);
  PosedLights lights;
  poseLights(out.donor_, pose, lights);
  if (lights.set.size() == 0) return Error{"has no lights to lend", out.donor_.name};
  const float donorRadius = boundingSphere(out.donor_, out.objects_, pose).radius;
  if (!(donorRadius > 0)) return Error{"its objects have no extent to scale lights by", out.donor_.name};

  poseScene(target, firstClip(target), 0, pose);
  const Sphere bound = boundingSphere(target, litObjects(target), pose);
  if (!(bound.radius > 0)) return Error{"its objects have no extent to scale lights by", target.name};
  out.targetCentre_ = bound.centre;
  out.ratio_ = bound.radius / donorRadius;
  return out;
}

void LightTransplant::lightsAt(double time, PosedLights& out) const {
  ScenePose pose;
  poseScene(donor_, firstClip(donor_), time, pose);
  PosedLights lights;
  poseLights(donor_, pose, lights);
  const glm::vec3 donorCentre = boundingSphere(donor_, objects_, pose).centre;
  const auto moved = [&](Vec3 p) { return fromGlm(targetCentre_ + (toGlm(p) - donorCentre) * ratio_); };

  const LightSet& from = lights.set;
  out.set.clear();
  out.names = std::move(lights.names);
  for (int i = 0; i < from.directionalCount(); ++i) out.set.add(from.directional(i));
  const auto moveLocal = [&](auto light) {
    light.position = moved(light.position);
    light.radius *= ratio_;
    if constexpr (requires { light.range; }) light.range *= ratio_;
    if constexpr (requires { light.intensity; }) light.intensity = light.intensity * (ratio_ * ratio_);
    out.set.add(light);
  };
  for (int i = 0; i < from.pointCount(); ++i) moveLocal(from.point(i));
  for (int i = 0; i < from.spotCount(); ++i) moveLocal(from.spot(i));
  for (int i = 0; i < from.sphereCount(); ++i) moveLocal(from.sphere(i));
}

}  // namespace rigel::tools
