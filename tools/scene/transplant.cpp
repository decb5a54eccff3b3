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
  std::vector<glm::vec3> points;
  for (const SceneObject& object : objects) {
    poseObject(scene, object, pose, posed);
    points.insert(points.end(), posed.positions.begin(), posed.positions.end());
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

Result<LightDonor> LightDonor::create(Scene scene) {
  LightDonor out;
  out.scene_ = std::move(scene);
  out.objects_ = litObjects(out.scene_);
  ScenePose pose;
  poseScene(out.scene_, firstClip(out.scene_), 0, pose);
  PosedLights lights;
  poseLights(out.scene_, pose, lights);
  if (lights.set.size() == 0) return Error{"has no lights to lend", out.scene_.name};
  if (out.objects_.empty()) return out;
  out.radius_ = boundingSphere(out.scene_, out.objects_, pose).radius;
  if (!(out.radius_ > 0)) return Error{"its objects have no extent to scale lights by", out.scene_.name};
  return out;
}

double LightDonor::duration() const noexcept {
  return scene_.animations.empty() ? 0 : scene_.animations.front().duration;
}

Result<LightTransplant> LightTransplant::create(const LightDonor& donor, const Scene& target, int clip) {
  if (!donor.hasObjects()) return LightTransplant(donor);
  ScenePose pose;
  poseScene(target, clip, 0, pose);
  const Sphere bound = boundingSphere(target, litObjects(target), pose);
  if (!(bound.radius > 0)) return Error{"its objects have no extent to scale lights by", target.name};
  LightTransplant out(donor);
  out.targetCentre_ = bound.centre;
  out.ratio_ = bound.radius / donor.radius_;
  return out;
}

void LightTransplant::lightsAt(double time, PosedLights& out) const {
  const Scene& scene = donor_->scene_;
  ScenePose pose;
  poseScene(scene, firstClip(scene), time, pose);
  PosedLights lights;
  poseLights(scene, pose, lights);
  const glm::vec3 donorCentre = boundingSphere(scene, donor_->objects_, pose).centre;
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
  for (int i = 0; i < from.diskCount(); ++i) moveLocal(from.disk(i));
}

}  // namespace rigel::tools
