#include "report/run/scene_run.h"

#include "report/measure/disk_methods.h"
#include "report/pictures/picture_names.h"
#include "report/pictures/picture_plan.h"
#include "report/run/describe_lights.h"
#include "report/run/effects.h"
#include "report/run/frame_budget.h"
#include "report/run/loaded_scene.h"
#include "report/run/object_run.h"
#include "report/view3d/view3d_run.h"
#include "report/words/disk_words.h"

#include <algorithm>
#include <chrono>

namespace rigel::tools {
namespace {

/// Where the pictures of a clip go, and how much of the page those of one object may take.
struct PictureSeriesPlace {
  GalleryFiles files;
  std::size_t bytesAnObject = 0;
};

/// `measure` takes one clip of a scene.
class SceneRun {
 public:
  /// Options and scene must outlive the run.
  /// `timelines`: of the whole report, which share the page.
  SceneRun(const RunOptions& options, const LoadedScene& scene, std::size_t timelines)
      : options_(options), scene_(scene), timelines_(timelines) {}

  Result<SceneReport> measure(const Timeline& timeline, const PictureSeriesPlace& pictures,
                              const Progress& progress) const {
    const auto start = std::chrono::steady_clock::now();
    auto runs = createObjectRuns(timeline);
    if (!runs) return runs.error();

    auto created = Stage::create(scene_, timeline);
    if (!created) return created.error();
    Stage& stage = *created;
    std::vector<FrameBudget> budgets;
    for (std::size_t r = 0; r < options_.rigs.size(); ++r)
      if (options_.budget && chooses(options_.rigs[r], options_)) budgets.emplace_back(*options_.budget, r);
    DiskPairs disks(surveyed(timeline) * runs->size());
    survey(timeline, stage, *runs, disks);
    for (std::size_t f = 0; f < timeline.frames.size(); ++f) {
      const int frame = timeline.frames[f];
      progress(0.8 * static_cast<double>(f) / static_cast<double>(timeline.frames.size()), title(timeline));
      stage.pose(frame);
      for (ObjectRun& run : *runs) {
        poseObject(scene_.scene(), run.object(), stage.nodes(), run.posed());
        run.measure({frame, timeline.time(frame), timeline.followsOn(f)}, stage.lights().set);
      }
      for (FrameBudget& budget : budgets) budget.measure(*runs, stage.lights().set);
    }

    SceneReport report;
    report.scene = scene_.source();
    report.clip = timeline.clipName;
    report.lightsFrom = scene_.donor() != nullptr ? options_.lights : "";
    report.frames = static_cast<int>(timeline.frames.size());
    report.notes = scene_.notes();
    report.lights = describeLights(stage.lights());
    std::vector<float> wraps;
    for (const ObjectRun& run : *runs) {
      report.objects.push_back(run.report(report.lights));
      if (run.meanIrradiance() <= 0)
        report.notes.push_back("no light reaches object '" + run.object().name + "': its errors are shown as 0");
      for (float wrap : run.object().triangleWrap) wraps.push_back(options_.wrap.value_or(wrap));
    }
    for (const FrameBudget& budget : budgets) report.budgets.push_back(budget.report(options_));
    if (!disks.pairs().empty()) report.disks = reportDisks(disks, *runs, report);
    report.effects = effectsOf(stage.lights().set, wraps, options_.rigs, report.objects);

    if (options_.images) {
      if (auto error = takeAllPictures(timeline, stage, *runs, pictures, report, progress)) return *error;
      addViews(scene_, timeline, stage, *runs, options_, shareOf(ViewBudget{}, timelines_), report);
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
  }

 private:
  std::string title(const Timeline& timeline) const {
    return scene_.source() + (timeline.clipName.empty() ? "" : " (" + timeline.clipName + ")");
  }

  Result<std::vector<ObjectRun>> createObjectRuns(const Timeline& timeline) const {
    constexpr int kLeastTimings = 16;
    ObjectRun::Setting setting;
    setting.timings = std::max(1, kLeastTimings / static_cast<int>(timeline.frames.size()));
    setting.shares = std::ranges::count(scene_.objects(), false, &SceneObject::isStatic) > 1;
    ScenePose rest;
    poseScene(scene_.scene(), kRestPose, 0, rest);
    PosedObject posed;
    std::vector<ObjectRun> runs;
    for (const SceneObject& object : scene_.objects()) {
      if (object.isStatic) continue;
      poseObject(scene_.scene(), object, rest, posed);
      auto run = ObjectRun::create(object, posed, options_, setting);
      if (!run) return Error{run.error().line(), scene_.source()};
      run->setBodyParts(findBodyParts(scene_.scene(), object, run->surface().measured));
      runs.push_back(*std::move(run));
    }
    return runs;
  }

  static std::size_t surveyed(const Timeline& timeline) {
    constexpr std::size_t kFrames = 64;
    return std::min(kFrames, timeline.frames.size());
  }

  /// Shows the runs a few frames, spread over the timeline.
  void survey(const Timeline& timeline, Stage& stage, std::vector<ObjectRun>& runs, DiskPairs& disks) const {
    const std::size_t count = surveyed(timeline);
    for (std::size_t k = 0; k < count; ++k) {
      stage.pose(timeline.frames[k * timeline.frames.size() / count]);
      for (ObjectRun& run : runs) {
        poseObject(scene_.scene(), run.object(), stage.nodes(), run.posed());
        run.survey(stage.lights().set);
        disks.add(run.object(), run.posed(), run.surface(), stage.lights().set);
      }
    }
  }

  DiskReport reportDisks(const DiskPairs& disks, const std::vector<ObjectRun>& runs, const SceneReport& report) const {
    DiskReport out;
    out.pairs = disks.pairs().size();
    out.methods = measureDiskMethods(disks.pairs(), options_.bands);
    out.choice = diskChoice(out.methods);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const bool wraps = std::ranges::any_of(runs[i].surface().wrap, [](float wrap) { return wrap != 0; });
      std::ranges::move(diskUses(report.objects[i], wraps), std::back_inserter(out.uses));
    }
    return out;
  }

  std::optional<Error> takeAllPictures(const Timeline& timeline, Stage& stage, const std::vector<ObjectRun>& runs,
                                       const PictureSeriesPlace& pictures, SceneReport& report,
                                       const Progress& progress) const {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto part = [&](double share) {
        progress(0.8 + 0.2 * (static_cast<double>(i) + share) / static_cast<double>(runs.size()),
                 "pictures of " + runs[i].object().name);
      };
      auto taken =
          takePictures(scene_, timeline, stage, runs[i], options_, pictures.files, pictures.bytesAnObject, part);
      if (!taken) return taken.error();
      report.objects[i].pictures = std::move(taken->pictures);
      report.objects[i].pixels = std::move(taken->frames);
    }
    return std::nullopt;
  }

  const RunOptions& options_;
  const LoadedScene& scene_;
  std::size_t timelines_;
};

}  // namespace

Result<Report> runReport(const RunOptions& options, const std::filesystem::path& imageDirectory,
                         const Progress& progress) {
  if (auto error = checkOptions(options)) return *error;
  auto donor = loadDonor(options);
  if (!donor) return donor.error();

  // Everything is loaded and checked before the first minute is spent on measuring.
  std::vector<LoadedScene> scenes;
  std::size_t total = 0, pictured = 0;
  for (const std::string& source : options.scenes) {
    auto scene = LoadedScene::load(source, options, *donor ? &**donor : nullptr);
    if (!scene) return scene.error();
    total += scene->timelines().size();
    pictured += scene->timelines().size() *
                static_cast<std::size_t>(std::ranges::count(scene->objects(), false, &SceneObject::isStatic));
    scenes.push_back(*std::move(scene));
  }

  Report report;
  report.bands = options.bands;
  report.exposure = static_cast<double>(options.exposure);
  report.rate = options.rate;
  const std::size_t bytesAnObject = kPagePictureBytes / std::max<std::size_t>(pictured, 1);
  std::size_t done = 0;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const SceneRun run(options, scenes[s], total);
    const std::vector<Timeline>& timelines = scenes[s].timelines();
    for (std::size_t t = 0; t < timelines.size(); ++t) {
      const std::string pictureNames =
          pictureNamePrefix({options.scenes[s], s, scenes.size(), timelines[t].clipName, t, timelines.size()});
      const auto part = [&](double share, const std::string& what) {
        progress((static_cast<double>(done) + share) / static_cast<double>(total), what);
      };
      auto measured = run.measure(timelines[t], {{imageDirectory, pictureNames}, bytesAnObject}, part);
      if (!measured) return measured.error();
      report.scenes.push_back(*std::move(measured));
      ++done;
    }
  }
  progress(1, "done");
  return report;
}

}  // namespace rigel::tools
