#include "report/run/loaded_scene.h"

#include "report/run/describe_lights.h"
#include "scene/gltf_load.h"
#include "scene/surface.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigel::tools {
namespace {

int countLights(const Scene& scene) {
  ScenePose rest;
  poseScene(scene, kRestPose, 0, rest);
  PosedLights lights;
  poseLights(scene, rest, lights);
  return static_cast<int>(lights.names.size());
}

/// Objects without area (flattened to a line, to a point) have no surface to light: scenery, with a note. Error: all
/// are.
std::optional<Error> setFlatObjectsAside(const LoadedScene& loaded, std::vector<SceneObject>& objects,
                                         std::vector<std::string>& notes) {
  ScenePose rest;
  poseScene(loaded.scene(), kRestPose, 0, rest);
  PosedObject posed;
  std::size_t flat = 0;
  for (SceneObject& object : objects) {
    if (object.isStatic) continue;
    poseObject(loaded.scene(), object, rest, posed);
    if (sampleSurface(object, posed, 1, 1)) continue;
    object.isStatic = true;
    ++flat;
    notes.push_back("object '" + object.name + "' is left without a rig: it has no area");
  }
  if (flat > 0 && std::ranges::all_of(objects, &SceneObject::isStatic))
    return Error{"no object has an area: there is nothing to light", loaded.source()};
  return std::nullopt;
}

}  // namespace

Result<std::optional<LightDonor>> loadDonor(const RunOptions& options) {
  if (options.lights.empty()) return std::optional<LightDonor>();
  auto scene = loadScene(options.lights);
  if (!scene) return scene.error();
  if (auto error = scaleLights(*scene, options.exposure)) return Error{error->line(), options.lights};
  auto created = LightDonor::create(*std::move(scene));
  if (!created) return created.error();
  return std::optional(*std::move(created));
}

Result<LoadedScene> LoadedScene::load(const std::string& source, const RunOptions& options, const LightDonor* donor) {
  LoadedScene loaded;
  auto scene = loadScene(source);
  if (!scene) return scene.error();
  loaded.source_ = source;
  loaded.scene_ = std::make_unique<Scene>(*std::move(scene));
  if (auto error = scaleLights(*loaded.scene_, options.exposure)) return Error{error->line(), source};
  loaded.objects_ = findObjects(*loaded.scene_);
  if (loaded.objects_.empty()) return Error{"no mesh of triangles: there is nothing to light", source};
  const int ownLights = countLights(*loaded.scene_);
  if (donor == nullptr && ownLights == 0)
    return Error{"the scene has no lights (borrow some: --lights sample:street)", source};
  if (std::ranges::all_of(loaded.objects_, &SceneObject::isStatic))
    return Error{"every object is static scenery: nothing moves, so nothing needs a rig", source};
  loaded.notes_ = loaded.scene_->notes;
  if (auto error = setFlatObjectsAside(loaded, loaded.objects_, loaded.notes_)) return *error;
  loaded.donor_ = donor;
  auto timelines = makeTimelines(*loaded.scene_, options, donor != nullptr ? donor->duration() : 0);
  if (!timelines) return timelines.error();
  loaded.timelines_ = std::move(timelines->all);
  if (!options.settingsNote.empty()) loaded.notes_.push_back(options.settingsNote);
  if (donor != nullptr && ownLights > 0)
    loaded.notes_.push_back(fmt::format("its own {} light{} left out: --lights {}", ownLights,
                                        ownLights == 1 ? " is" : "s are", options.lights));
  if (donor != nullptr && !donor->hasObjects())
    loaded.notes_.push_back(
        fmt::format("--lights {} as they stand: it has no object to scale them by", options.lights));
  std::ranges::move(timelines->notes, std::back_inserter(loaded.notes_));
  return loaded;
}

Result<Stage> Stage::create(const LoadedScene& scene, const Timeline& timeline) {
  std::optional<LightTransplant> transplant;
  if (scene.donor() != nullptr) {
    auto created = LightTransplant::create(*scene.donor(), scene.scene(), timeline.clip);
    if (!created) return created.error();
    transplant = *created;
  }
  return Stage(scene.scene(), timeline, transplant);
}

void Stage::pose(int frame) {
  poseScene(*scene_, timeline_->clip, timeline_->clipTime(frame), pose_);
  if (donor_) {
    donor_->lightsAt(timeline_->lightTime(frame), lights_);
  } else {
    poseLights(*scene_, pose_, lights_);
  }
}

}  // namespace rigel::tools
