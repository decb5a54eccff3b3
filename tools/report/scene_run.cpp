#include "report/scene_run.h"

#include "report/describe_lights.h"
#include "report/effects.h"
#include "report/frame_budget.h"
#include "report/gallery.h"
#include "report/object_run.h"
#include "report/picture_names.h"
#include "report/timeline.h"
#include "scene/gltf_load.h"
#include "scene/transplant.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace rigel::tools {
namespace {

/// A scene with the lights it is seen under; ready to be posed at any frame of a timeline.
class Stage {
 public:
  Stage(const Scene& scene, const Timeline& timeline, std::optional<LightTransplant> donor)
      : scene_(scene), timeline_(timeline), donor_(donor) {}

  void pose(int frame) {
    poseScene(scene_, timeline_.clip, timeline_.clipTime(frame), pose_);
    if (donor_) {
      donor_->lightsAt(timeline_.lightTime(frame), lights_);
    } else {
      poseLights(scene_, pose_, lights_);
    }
  }
  const ScenePose& nodes() const { return pose_; }
  const PosedLights& lights() const { return lights_; }

 private:
  const Scene& scene_;
  const Timeline& timeline_;
  std::optional<LightTransplant> donor_;  // the scene's own lights without one
  ScenePose pose_;
  PosedLights lights_;
};

/// One scene, loaded once; `run` measures one clip of it.
class SceneRun {
 public:
  static Result<SceneRun> load(const std::string& source, const RunOptions& options, const LightDonor* donor) {
    SceneRun run(options);
    auto scene = loadScene(source);
    if (!scene) return scene.error();
    run.source_ = source;
    run.scene_ = std::make_unique<Scene>(*std::move(scene));
    if (auto error = scaleLights(*run.scene_, options.exposure)) return Error{error->line(), source};
    const int ownLights = run.countLights();
    if (donor == nullptr && ownLights == 0)
      return Error{"the scene has no lights (borrow some: --lights sample:street)", source};
    run.objects_ = findObjects(*run.scene_);
    if (std::ranges::all_of(run.objects_, &SceneObject::isStatic))
      return Error{"every object is static scenery: nothing moves, so nothing needs a rig", source};
    run.donor_ = donor;
    auto timelines = makeTimelines(*run.scene_, options, donor ? donor->duration() : 0);
    if (!timelines) return timelines.error();
    run.timelines_ = std::move(timelines->all);
    run.notes_ = run.scene_->notes;
    if (donor != nullptr && ownLights > 0)
      run.notes_.push_back(fmt::format("its own {} light{} left out: --lights {}", ownLights,
                                       ownLights == 1 ? " is" : "s are", options.lights));
    std::ranges::move(timelines->notes, std::back_inserter(run.notes_));
    return run;
  }

  const std::vector<Timeline>& timelines() const { return timelines_; }

  Result<SceneReport> run(const Timeline& timeline, const std::filesystem::path& imageDirectory,
                          const std::string& pictureNames, const Progress& progress) const {
    const auto start = std::chrono::steady_clock::now();
    auto runs = createObjectRuns(timeline);
    if (!runs) return runs.error();

    std::optional<LightTransplant> transplant;
    if (donor_ != nullptr) {
      auto created = LightTransplant::create(*donor_, *scene_, timeline.clip);
      if (!created) return created.error();
      transplant = *created;
    }
    Stage stage(*scene_, timeline, transplant);
    std::vector<FrameBudget> budgets;
    for (std::size_t r = 0; r < options_.rigs.size(); ++r)
      if (options_.budget && chooses(options_.rigs[r], options_)) budgets.emplace_back(*options_.budget, r);
    survey(timeline, stage, *runs);
    for (std::size_t f = 0; f < timeline.frames.size(); ++f) {
      const int frame = timeline.frames[f];
      progress(0.8 * static_cast<double>(f) / static_cast<double>(timeline.frames.size()), title(timeline));
      stage.pose(frame);
      for (ObjectRun& run : *runs) {
        poseObject(*scene_, run.object(), stage.nodes(), run.posed());
        run.measure({frame, timeline.time(frame), timeline.followsOn(f)}, stage.lights().set);
      }
      for (FrameBudget& budget : budgets) budget.measure(*runs, stage.lights().set);
    }

    SceneReport report;
    report.scene = source_;
    report.clip = timeline.clipName;
    report.lightsFrom = donor_ ? options_.lights : "";
    report.frames = static_cast<int>(timeline.frames.size());
    report.notes = notes_;
    report.lights = describeLights(stage.lights());
    std::vector<float> wraps;
    for (const ObjectRun& run : *runs) {
      report.objects.push_back(run.report(report.lights));
      if (run.meanIrradiance() <= 0)
        report.notes.push_back("no light reaches object '" + run.object().name + "': its errors are shown as 0");
      for (float wrap : run.object().triangleWrap) wraps.push_back(options_.wrap.value_or(wrap));
    }
    for (const FrameBudget& budget : budgets) report.budgets.push_back(budget.report(options_));
    report.effects = effectsOf(stage.lights().set, wraps, options_.rigs, report.objects);

    if (options_.images) {
      if (auto error = takePictures(timeline, stage, *runs, {imageDirectory, pictureNames}, report, progress))
        return *error;
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
  }

 private:
  explicit SceneRun(const RunOptions& options) : options_(options) {}

  int countLights() const {
    ScenePose rest;
    poseScene(*scene_, kRestPose, 0, rest);
    PosedLights lights;
    poseLights(*scene_, rest, lights);
    return static_cast<int>(lights.names.size());
  }

  std::string title(const Timeline& timeline) const {
    return source_ + (timeline.clipName.empty() ? "" : " (" + timeline.clipName + ")");
  }

  Result<std::vector<ObjectRun>> createObjectRuns(const Timeline& timeline) const {
    constexpr int kLeastTimings = 16;
    ObjectRun::Setting setting;
    setting.timings = std::max(1, kLeastTimings / static_cast<int>(timeline.frames.size()));
    setting.shares = std::ranges::count(objects_, false, &SceneObject::isStatic) > 1;
    ScenePose rest;
    poseScene(*scene_, kRestPose, 0, rest);
    PosedObject posed;
    std::vector<ObjectRun> runs;
    for (const SceneObject& object : objects_) {
      if (object.isStatic) continue;
      poseObject(*scene_, object, rest, posed);
      auto run = ObjectRun::create(object, posed, options_, setting);
      if (!run) return Error{run.error().line(), source_};
      runs.push_back(*std::move(run));
    }
    return runs;
  }

  /// Shows the runs a few frames, spread over the timeline.
  void survey(const Timeline& timeline, Stage& stage, std::vector<ObjectRun>& runs) const {
    constexpr std::size_t kFrames = 64;
    const std::size_t count = std::min(kFrames, timeline.frames.size());
    for (std::size_t k = 0; k < count; ++k) {
      stage.pose(timeline.frames[k * timeline.frames.size() / count]);
      for (ObjectRun& run : runs) {
        poseObject(*scene_, run.object(), stage.nodes(), run.posed());
        run.survey(stage.lights().set);
      }
    }
  }

  /// The worst frame of each object; the middle one too where there are few objects.
  std::optional<Error> takePictures(const Timeline& timeline, Stage& stage, std::vector<ObjectRun>& runs,
                                    const GalleryFiles& files, SceneReport& report, const Progress& progress) const {
    constexpr std::size_t kFewObjects = 3;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      std::vector<std::size_t> frames{runs[i].worstFrame()};
      if (runs.size() <= kFewObjects) frames.push_back(timeline.frames.size() / 2);
      std::ranges::sort(frames);
      frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
      for (std::size_t f : frames) {
        progress(0.8 + 0.2 * static_cast<double>(i) / static_cast<double>(runs.size()),
                 "pictures of " + runs[i].object().name);
        const int frame = timeline.frames[f];
        stage.pose(frame);
        auto pictures = photograph(*scene_, objects_, stage.nodes(), stage.lights().set, runs[i],
                                   {f, frame, timeline.time(frame)}, options_, files);
        if (!pictures) return pictures.error();
        std::ranges::move(*pictures, std::back_inserter(report.objects[i].pictures));
      }
    }
    return std::nullopt;
  }

  const RunOptions& options_;
  std::string source_;
  std::unique_ptr<Scene> scene_;
  std::vector<SceneObject> objects_;
  const LightDonor* donor_ = nullptr;  // of --lights
  std::vector<Timeline> timelines_;
  std::vector<std::string> notes_;  // of the file, and of what the options leave out
};

}  // namespace

Result<Report> runReport(const RunOptions& options, const std::filesystem::path& imageDirectory,
                         const Progress& progress) {
  if (auto error = checkOptions(options)) return *error;
  std::optional<LightDonor> donor;
  if (!options.lights.empty()) {
    auto scene = loadScene(options.lights);
    if (!scene) return scene.error();
    if (auto error = scaleLights(*scene, options.exposure)) return Error{error->line(), options.lights};
    auto created = LightDonor::create(*std::move(scene));
    if (!created) return created.error();
    donor = *std::move(created);
  }

  // Everything is loaded and checked before the first minute is spent on measuring.
  std::vector<SceneRun> scenes;
  std::size_t total = 0;
  for (const std::string& source : options.scenes) {
    auto scene = SceneRun::load(source, options, donor ? &*donor : nullptr);
    if (!scene) return scene.error();
    total += scene->timelines().size();
    scenes.push_back(*std::move(scene));
  }

  Report report;
  report.bands = options.bands;
  report.exposure = static_cast<double>(options.exposure);
  report.rate = options.rate;
  std::size_t done = 0;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const std::vector<Timeline>& timelines = scenes[s].timelines();
    for (std::size_t t = 0; t < timelines.size(); ++t) {
      const std::string pictureNames =
          pictureNamePrefix({options.scenes[s], s, scenes.size(), timelines[t].clipName, t, timelines.size()});
      const auto part = [&](double share, const std::string& what) {
        progress((static_cast<double>(done) + share) / static_cast<double>(total), what);
      };
      auto measured = scenes[s].run(timelines[t], imageDirectory, pictureNames, part);
      if (!measured) return measured.error();
      report.scenes.push_back(*std::move(measured));
      ++done;
    }
  }
  progress(1, "done");
  return report;
}

}  // namespace rigel::tools
