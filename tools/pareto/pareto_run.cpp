#include "pareto/pareto_run.h"

#include "pareto/gpu_times.h"
#include "pareto/machine.h"
#include "report/run/loaded_scene.h"

#include <algorithm>
#include <chrono>

namespace rigel::tools {
namespace {

constexpr std::size_t kTimedFrames = 4;
constexpr int kRepetitions = 6;

/// Up to `count` of them, spread evenly.
std::vector<int> spread(const std::vector<int>& frames, std::size_t count) {
  if (frames.size() <= count) return frames;
  std::vector<int> some;
  for (std::size_t k = 0; k < count; ++k) some.push_back(frames[k * frames.size() / count]);
  return some;
}

/// Shares of the whole work, by what they take where there is a device.
constexpr double kBuilt = 0.1, kMeasured = 0.5, kTimed = 0.75;

class Run {
 public:
  Run(const ParetoOptions& options, const LoadedScene& scene, Stage& stage, const Progress& progress)
      : options_(options), scene_(scene), stage_(stage), progress_(progress) {}

  std::optional<Error> build(const std::vector<RigFamilyMember>& members) {
    ScenePose rest;
    poseScene(scene_.scene(), kRestPose, 0, rest);
    PosedObject posed;
    const std::size_t moving = moves();
    for (const SceneObject& object : scene_.objects()) {
      if (object.isStatic) continue;
      poseObject(scene_.scene(), object, rest, posed);
      auto measured = ObjectPareto::create(object, posed, options_.run, members, [&](double share) {
        progress_(kBuilt * (static_cast<double>(objects_.size()) + share) / static_cast<double>(moving),
                  "building rigs");
      });
      if (!measured) return Error{measured.error().line(), scene_.source()};
      objects_.push_back(*std::move(measured));
    }
    return std::nullopt;
  }

  void measure(const std::vector<int>& frames) {
    for (const int frame : frames) pose(frame, [&](ObjectPareto& object) { object.survey(stage_.lights().set); });
    for (std::size_t f = 0; f < frames.size(); ++f) {
      progress_(between(kBuilt, kMeasured, f, frames.size()), "errors");
      pose(frames[f], [&](ObjectPareto& object) { object.measure(stage_.lights().set); });
    }
  }

  void time(const std::vector<int>& frames) {
    for (std::size_t r = 0; r < kRepetitions; ++r)
      for (std::size_t f = 0; f < frames.size(); ++f) {
        progress_(between(kMeasured, kTimed, r * frames.size() + f, kRepetitions * frames.size()), "times");
        pose(frames[f], [&](ObjectPareto& object) { object.time(f, stage_.lights().set); });
      }
  }

  std::optional<Error> report(int gpuFrame, Pareto& out) {
    for (const ObjectPareto& object : objects_) {
      ParetoObject& shown = out.objects.emplace_back();
      shown.name = object.object().name;
      shown.triangles = static_cast<int>(object.object().triangles.size());
      shown.samples = static_cast<int>(object.surface().measured.size());
      shown.lights = stage_.lights().set.size();
      shown.meanIrradiance = object.meanIrradiance();
      shown.points = object.report();
      if (object.meanIrradiance() <= 0)
        out.notes.push_back("no light reaches object '" + shown.name + "': its errors are shown as 0");
    }
    if (options_.device == nullptr) return std::nullopt;
    stage_.pose(gpuFrame);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      poseObject(scene_.scene(), objects_[i].object(), stage_.nodes(), objects_[i].posed());
      const auto step = [&](double share) {
        progress_(kTimed + (1 - kTimed) * (static_cast<double>(i) + share) / static_cast<double>(objects_.size()),
                  "times on " + options_.device->name());
      };
      if (auto error = measureGpuTimes(*options_.device, objects_[i], stage_.lights().set, out.objects[i].points, step))
        return error;
    }
    return std::nullopt;
  }

 private:
  static double between(double from, double to, std::size_t done, std::size_t all) {
    return from + (to - from) * static_cast<double>(done) / static_cast<double>(all);
  }

  std::size_t moves() const {
    return static_cast<std::size_t>(std::ranges::count(scene_.objects(), false, &SceneObject::isStatic));
  }

  void pose(int frame, const std::function<void(ObjectPareto&)>& then) {
    stage_.pose(frame);
    for (ObjectPareto& object : objects_) {
      poseObject(scene_.scene(), object.object(), stage_.nodes(), object.posed());
      then(object);
    }
  }

  const ParetoOptions& options_;
  const LoadedScene& scene_;
  Stage& stage_;
  const Progress& progress_;
  std::vector<ObjectPareto> objects_;
};

}  // namespace

Result<Pareto> runPareto(const ParetoOptions& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  auto donor = loadDonor(options.run);
  if (!donor) return donor.error();
  auto scene = LoadedScene::load(options.run.scenes.front(), options.run, *donor ? &**donor : nullptr);
  if (!scene) return scene.error();
  if (scene->timelines().size() > 1) return Error{"shows one clip: name it", "--clip " + options.run.clip};
  const Timeline& timeline = scene->timelines().front();
  auto stage = Stage::create(*scene, timeline);
  if (!stage) return stage.error();

  Pareto out;
  out.machine = thisMachine();
  if (options.device != nullptr) out.gpu = options.device->name();
  out.scene = scene->source();
  out.clip = timeline.clipName;
  out.lightsFrom = scene->donor() != nullptr ? options.run.lights : "";
  out.rate = options.run.rate;
  out.frames = options.allFrames ? timeline.frames : spread(timeline.frames, kParetoFrames);
  out.timed = spread(out.frames, kTimedFrames);
  out.repetitions = kRepetitions;
  out.notes = scene->notes();

  Run run(options, *scene, *stage, progress);
  const std::vector<RigSpec> rigs = options.rigs.empty() ? paretoRigs() : options.rigs;
  if (auto error = run.build(configurations(rigs, options.bands))) return *error;
  run.measure(out.frames);
  run.time(out.timed);
  if (auto error = run.report(out.timed[out.timed.size() / 2], out)) return *error;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  progress(1, "done");
  return out;
}

}  // namespace rigel::tools
