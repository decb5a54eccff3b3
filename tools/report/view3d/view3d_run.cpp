#include "report/view3d/view3d_run.h"

#include "report/view3d/view3d_json.h"
#include "report/view3d/view3d_lights.h"
#include "report/view3d/view3d_recorder.h"

#include <algorithm>

namespace rigel::tools {
namespace {

/// Mean over the rigs: that of one alone would be a matter of which was asked for.
double errorOf(const ObjectReport& object) {
  double sum = 0;
  for (const RigReport& rig : object.rigs) sum += rig.total.rms;
  return sum;
}

ViewDemand demandOf(const Timeline& timeline, const std::vector<ObjectRun>& runs, const RunOptions& options,
                    const SceneReport& report) {
  ViewDemand demand;
  bool wraps = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    demand.errors.push_back(errorOf(report.objects[i]));
    demand.worstFrames.push_back(runs[i].worstFrame());
    wraps = wraps || std::ranges::any_of(runs[i].surface().wrap, [](float wrap) { return wrap != 0; });
  }
  demand.frames = timeline.frames.size();
  demand.rigs = options.rigs.size();
  demand.evaluations = report.lights.size() * (wraps ? kWrapEvaluations : 1);
  return demand;
}

}  // namespace

void addViews(const LoadedScene& scene, const Timeline& timeline, Stage& stage, std::vector<ObjectRun>& runs,
              const RunOptions& options, const ViewBudget& budget, SceneReport& report) {
  const ViewPlan plan = planViews(demandOf(timeline, runs, options, report), budget);
  if (plan.objects.empty()) return;
  ScenePose rest;
  poseScene(scene.scene(), kRestPose, 0, rest);
  PosedObject posed;
  std::vector<ViewRecorder> recorders;
  for (const std::size_t i : plan.objects) {
    poseObject(scene.scene(), runs[i].object(), rest, posed);
    recorders.emplace_back(runs[i].object(), posed, plan.vertices, options.wrap);
  }

  SceneView view;
  view.frames = plan.frames;
  const std::vector<int> lights =
      foremostLights(report.objects, report.lights.size(), kViewLightPlaces / plan.frames.size());
  for (const std::size_t f : plan.frames) {
    stage.pose(timeline.frames[f]);
    const LightSet& set = stage.lights().set;
    if (view.lights.empty()) view.lights = viewLights(set, lights);
    view.places.push_back(lightPlaces(set, view.lights));
    for (std::size_t k = 0; k < recorders.size(); ++k) {
      const ObjectRun& run = runs[plan.objects[k]];
      poseObject(scene.scene(), run.object(), stage.nodes(), posed);
      recorders[k].record(run, f, posed, set, view.lights);
    }
  }
  report.view3d = packedScene(view);
  for (std::size_t k = 0; k < recorders.size(); ++k)
    report.objects[plan.objects[k]].view3d = packedView(std::move(recorders[k]).take(), plan.bytes);
}

}  // namespace rigel::tools
