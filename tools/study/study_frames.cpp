#include "study/study_frames.h"

#include "scene/gltf_load.h"

#include <rigel/exact.h>

namespace rigel::tools {
namespace {

/// Poses a scene and its lights at a frame of a timeline.
class Clock {
 public:
  Clock(const Scene& scene, const Timeline& timeline, const LightTransplant* transplant)
      : scene_(scene), timeline_(timeline), transplant_(transplant) {}

  void pose(int frame) {
    poseScene(scene_, timeline_.clip, timeline_.clipTime(frame), nodes);
    if (transplant_ != nullptr) {
      transplant_->lightsAt(timeline_.lightTime(frame), lights);
    } else {
      poseLights(scene_, nodes, lights);
    }
  }
  ScenePose nodes;
  PosedLights lights;

 private:
  const Scene& scene_;
  const Timeline& timeline_;
  const LightTransplant* transplant_;
};

void measure(StudyFrame& frame) {
  const LightSet& set = frame.lights->set;
  const std::size_t row = frame.row();
  frame.exact.assign(row * set.size(), 0);
  frame.sh.assign(row * set.size(), 0);
  double sum = 0;
  for (int i = 0; i < set.size(); ++i)
    for (std::size_t p = 0; p < frame.points.size(); ++p) {
      const auto& [at, normal] = frame.points[p];
      const float wrap = frame.surface->wrap[p];
      const RgbD exact = set.visit(i, [&](const auto& light) { return exactIrradiance(light, at, normal, wrap); });
      const Rgb sh = set.visit(i, [&](const auto& light) {
        return irradiance<3>(project<3>(light, at), wrapCoefficients<3>(wrap), normal);
      });
      for (int c = 0; c < 3; ++c) {
        frame.exact[i * row + 3 * p + c] = static_cast<float>(exact[c]);
        frame.sh[i * row + 3 * p + c] = sh[c];
        sum += exact[c];
      }
    }
  frame.mean = sum / static_cast<double>(row);
}

}  // namespace

std::string StudyInput::label() const {
  const auto last = [](const std::string& text) { return text.substr(text.find_last_of("/:") + 1); };
  return last(scene) + (donor.empty() ? "" : " by " + last(donor));
}

std::vector<StudyInput> studyInputs(const std::string& data) {
  std::vector<StudyInput> inputs;
  for (const char* name : {"street", "stage", "dragon", "touch", "figure1"})
    inputs.push_back({std::string("sample:") + name, ""});
  if (data.empty()) return inputs;
  for (const char* asset : {"characters/soldier/soldier1.gltf", "characters/Fox.glb", "vehicles/car/car.gltf",
                            "scenes/collisions_level/level.gltf"})
    for (const char* donor : {"sample:street", "sample:dragon"}) inputs.push_back({data + "/" + asset, donor});
  return inputs;
}

std::optional<Error> visitFrames(const StudyInput& input, int step, int points, StudyVisitor& visitor) {
  auto scene = loadScene(input.scene);
  if (!scene) return scene.error();
  std::optional<LightDonor> donor;
  if (!input.donor.empty()) {
    auto lights = loadScene(input.donor);
    if (!lights) return lights.error();
    auto created = LightDonor::create(*std::move(lights));
    if (!created) return created.error();
    donor = *std::move(created);
  }
  RunOptions options;
  options.clip = "all";
  options.frames.step = step;
  const auto timelines = makeTimelines(*scene, options, donor ? donor->duration() : 0);
  if (!timelines) return timelines.error();
  const std::vector<SceneObject> objects = findObjects(*scene);
  for (const Timeline& timeline : timelines->all) {
    std::optional<LightTransplant> transplant;
    if (donor) {
      auto created = LightTransplant::create(*donor, *scene, timeline.clip);
      if (!created) return created.error();
      transplant = *created;
    }
    Clock clock(*scene, timeline, transplant ? &*transplant : nullptr);
    for (const SceneObject& object : objects) {
      if (object.isStatic) continue;
      ScenePose restPose;
      PosedObject posed;
      poseScene(*scene, kRestPose, 0, restPose);
      poseObject(*scene, object, restPose, posed);
      const auto surface = chooseSurface(object, posed, points, std::nullopt);
      if (!surface) return surface.error();
      const RigFrame restFrame = rigidFrame(posed.worldFromRig);
      std::vector<Vec3> candidates;
      for (const SurfacePoint& candidate : surface->candidates)
        candidates.push_back(restFrame.inversePoint(surfacePosition(object, posed, candidate)));
      const RigBox restBox = rigBox(restFrame, posed);

      StudyFrame frame;
      frame.object = &object;
      frame.surface = &*surface;
      double runMean = 0;
      for (int number : timeline.frames) {
        clock.pose(number);
        poseObject(*scene, object, clock.nodes, posed);
        frame.points.clear();
        for (const SurfacePoint& point : surface->measured)
          frame.points.push_back(evaluateSurface(object, posed, point));
        for (std::size_t p = 0; p < frame.points.size(); ++p) {
          const RgbD e =
              exactIrradiance(clock.lights.set, frame.points[p].position, frame.points[p].normal, surface->wrap[p]);
          runMean += (e.r + e.g + e.b) / (3.0 * static_cast<double>(frame.points.size()));
        }
      }
      runMean /= static_cast<double>(timeline.frames.size());
      if (runMean <= 0) continue;
      const std::string name =
          object.name + " of " + input.label() + (timeline.clipName.empty() ? "" : ", " + timeline.clipName);
      visitor.begin(input, name, {restBox, candidates}, runMean);
      for (int number : timeline.frames) {
        clock.pose(number);
        poseObject(*scene, object, clock.nodes, posed);
        frame.posed = &posed;
        frame.lights = &clock.lights;
        frame.frame = rigidFrame(posed.worldFromRig);
        frame.box = rigBox(frame.frame, posed);
        frame.points.clear();
        for (const SurfacePoint& point : surface->measured)
          frame.points.push_back(evaluateSurface(object, posed, point));
        measure(frame);
        visitor.frame(frame);
      }
      visitor.end();
    }
  }
  return std::nullopt;
}

}  // namespace rigel::tools
