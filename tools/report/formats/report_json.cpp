#include "report/formats/report_json.h"

#include "report/formats/breakdown_json.h"
#include "report/measure/light_log.h"
#include "report/words/budget_words.h"
#include "report/words/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Builds the document and remembers the first number JSON cannot hold.
class Writer {
 public:
  Json document(const Report& report) {
    Json effects = Json::array();
    Json scenes = Json::array();
    Json objects = Json::array();
    for (std::size_t i = 0; i < report.scenes.size(); ++i) {
      const SceneReport& sceneReport = report.scenes[i];
      for (const std::string& effect : sceneReport.effects)
        if (std::find(effects.begin(), effects.end(), effect) == effects.end()) effects.push_back(effect);
      scenes.push_back(scene(sceneReport));
      for (const ObjectReport& objectReport : sceneReport.objects)
        objects.push_back(object(objectReport, sceneReport, i));
    }
    place_ = "report";
    return {{"version", report.version},
            {"command", report.commandLine},
            {"bands", report.bands},
            {"exposure", number(report.exposure, "exposure")},
            {"rate", number(report.rate, "rate")},
            {"device", report.device.empty() ? Json(nullptr) : Json(report.device)},
            {"verdict_slack", kVerdictSlack},
            {"usable_error", kUsableError},
            {"effects", std::move(effects)},
            {"scenes", std::move(scenes)},
            {"objects", std::move(objects)}};
  }

  const std::string& notFinite() const { return notFinite_; }

 private:
  Json number(double value, std::string_view field) {
    if (!std::isfinite(value) && notFinite_.empty()) notFinite_ = fmt::format("{}: {} is {}", place_, field, value);
    return value;
  }

  /// A count, or the mean of counts.
  Json wholeOrNumber(double value, std::string_view field) {
    const Json written = number(value, field);
    return value == std::floor(value) && std::abs(value) < 1e9 ? Json(static_cast<int>(value)) : written;
  }

  Json numberOrNull(std::optional<double> value, std::string_view field) {
    return value ? number(*value, field) : Json(nullptr);
  }

  Json scene(const SceneReport& report) {
    place_ = report.scene;
    Json lights = Json::array();
    for (const LightRow& light : report.lights)
      lights.push_back({{"name", light.name}, {"type", light.type}, {"summary", light.summary}});
    Json budgets = Json::array();
    for (const SharedBudget& budget : report.budgets) budgets.push_back(sharedBudget(budget, report.objects.size()));
    Json result = {{"scene", report.scene},
                   {"clip", report.clip},
                   {"lights_from", report.lightsFrom},
                   {"frames", report.frames},
                   {"seconds", number(report.seconds, "seconds")},
                   {"effects", report.effects},
                   {"notes", report.notes},
                   {"lights", std::move(lights)},
                   {"budgets", std::move(budgets)}};
    if (report.disks) result["disks"] = disks(*report.disks);
    return result;
  }

  Json disks(const DiskReport& report) {
    Json methods = Json::array();
    for (const DiskMethodRow& row : report.methods) {
      methods.push_back({{"method", row.method},
                         {"meaning", row.meaning},
                         {"sh", row.sh ? figures(*row.sh, row.method + " sh") : Json(nullptr)},
                         {"irradiance", figures(row.irradiance, row.method + " irradiance")},
                         {"ns", number(row.nanoseconds, row.method + " ns")}});
    }
    Json uses = Json::array();
    for (const DiskUse& use : report.uses) {
      uses.push_back(
          {{"light", use.light}, {"object", use.object}, {"rig", use.rig}, {"method", use.method}, {"why", use.why}});
    }
    return {{"pairs", report.pairs},
            {"sh_relative_to", "norm of the coefficients"},
            {"irradiance_relative_to", "peak over all normals of the disk's irradiance at the point"},
            {"methods", std::move(methods)},
            {"choice", report.choice},
            {"uses", std::move(uses)}};
  }

  Json sharedBudget(const SharedBudget& budget, std::size_t objects) {
    return {{"spec", budget.spec},
            {"budget_us", number(budget.budget, "budget_us")},
            {"goal", numberOrNull(budget.goal, "goal")},
            {"mean_us", number(budget.mean, "mean_us")},
            {"most_us", number(budget.most, "most_us")},
            {"frames_over", budget.framesOver},
            {"sentence", budgetSentence(budget, objects)}};
  }

  Json budgetUse(const RigReport& report) {
    const BudgetUse& use = *report.budget;
    Json result = {{"us", number(use.microseconds, "budget us")}, {"granted", number(use.granted, "granted")}};
    if (!use.alone) return result;
    const BudgetUse::Alone& alone = *use.alone;
    result["alone"] = {{"us", number(alone.microseconds, "us alone")},
                       {"granted", number(alone.granted, "granted alone")},
                       {"spatial", number(alone.spatialRms, "spatial alone")},
                       {"total", number(alone.totalRms, "total alone")},
                       {"sh_vectors", wholeOrNumber(alone.shVectors, "sh_vectors alone")},
                       {"near_lights", wholeOrNumber(alone.nearLights, "near_lights alone")}};
    result["gave_up"] = gaveUp(report);
    result["given_up"] = givenUp(report);
    return result;
  }

  Json object(const ObjectReport& report, const SceneReport& sceneReport, std::size_t sceneIndex) {
    place_ = fmt::format("{}, object {}", sceneReport.scene, report.name);
    Json result = {{"name", report.name},
                   {"scene", sceneReport.scene},
                   {"scene_index", sceneIndex},
                   {"clip", sceneReport.clip},
                   {"triangles", report.triangles},
                   {"samples", report.samples},
                   {"mean_irradiance", number(report.meanIrradiance, "mean_irradiance")}};
    if (const std::optional<Verdict> verdict = verdictOf(report))
      result["verdict"] = {{"spec", report.rigs[verdict->chosen].spec},
                           {"best", report.rigs[verdict->best].spec},
                           {"advised", verdict->advised},
                           {"sentence", verdict->sentence}};
    Json truth = Json::array();
    for (const TruthFrame& frame : report.truth)
      truth.push_back({{"time", number(frame.time, "truth time")},
                       {"mean_irradiance", number(frame.meanIrradiance, "truth mean_irradiance")},
                       {"movement", numberOrNull(frame.movement, "truth movement")}});
    result["truth"] = std::move(truth);
    result["rigs"] = Json::array();
    for (const RigReport& rigReport : report.rigs) {
      place_ = fmt::format("{}, object {}, rig {}", sceneReport.scene, report.name, rigReport.spec);
      result["rigs"].push_back(rig(rigReport));
    }
    place_ = fmt::format("{}, object {}", sceneReport.scene, report.name);
    result["pictures"] = Json::array();
    for (const Picture& pictureReport : report.pictures) result["pictures"].push_back(picture(pictureReport));
    return result;
  }

  Json rig(const RigReport& report) {
    Json result = {{"spec", report.spec},
                   {"asked", report.asked},
                   {"sh_vectors", wholeOrNumber(report.shVectors, "sh_vectors")},
                   {"projections", report.projections},
                   {"near_lights", wholeOrNumber(report.nearLights, "near_lights")},
                   {"spatial", figures(report.spatial, "spatial")},
                   {"total", figures(report.total, "total")},
                   {"estimate", numberOrNull(report.estimate, "estimate")},
                   {"total_estimate", numberOrNull(report.totalEstimate, "total_estimate")},
                   {"fit_us", number(report.fitMicroseconds, "fit_us")},
                   {"shade_ns_per_point", number(report.shadeNanosecondsPerPoint, "shade_ns_per_point")},
                   {"modelled_ns_per_point", number(report.modelledNanoseconds, "modelled_ns_per_point")},
                   {"high_band_frames", report.highBandFrames},
                   {"bytes", report.bytes},
                   {"max_jump", numberOrNull(report.maxJump, "max_jump")},
                   {"condition", number(report.condition, "condition")}};
    if (report.halfFloat)
      result["half_float"] = {{"rms", number(report.halfFloat->rms, "half_float.rms")},
                              {"max", number(report.halfFloat->max, "half_float.max")},
                              {"bytes", report.bytes / 2}};
    if (report.budget) result["budget"] = budgetUse(report);
    addBreakdown(report, result, [this](double value, std::string_view field) { return number(value, field); });
    Json stages = Json::object();
    for (const StageTime& stage : report.stages) stages[stage.name] = number(stage.microseconds, stage.name);
    result["stages"] = std::move(stages);
    Json frames = Json::array();
    for (const FrameReport& rigFrame : report.frames) frames.push_back(frame(rigFrame, report.lights));
    result["frames"] = std::move(frames);
    Json lights = Json::array();
    for (const LightReport& use : report.lights) lights.push_back(light(use));
    result["lights"] = std::move(lights);
    return result;
  }

  Json frame(const FrameReport& report, const std::vector<LightReport>& lights) {
    Json near = Json::array();
    for (const int i : report.near) near.push_back(lights.at(static_cast<std::size_t>(i)).name);
    Json result = {{"time", number(report.time, "time")},
                   {"spatial_rms", number(report.spatialRms, "spatial_rms")},
                   {"total_rms", number(report.totalRms, "total_rms")},
                   {"estimate", numberOrNull(report.estimate, "frame estimate")},
                   {"jump", numberOrNull(report.jump, "frame jump")},
                   {"sh_vectors", report.shVectors},
                   {"near", std::move(near)}};
    if (report.granted) result["granted"] = number(*report.granted, "frame granted");
    if (report.totalEstimate) result["total_estimate"] = number(*report.totalEstimate, "frame total_estimate");
    return result;
  }

  Json light(const LightReport& use) {
    Json result = {{"name", use.name},
                   {"type", use.type},
                   {"bound", number(use.bound, "bound of light " + use.name)},
                   {"share", number(use.share, "share of light " + use.name)},
                   {"near_frames", use.framesOf(LightRole::exact)},
                   {"blend_frames", use.framesOf(LightRole::blended)},
                   {"far_frames", use.framesOf(LightRole::inRig)},
                   {"culled_frames", use.framesOf(LightRole::culled)},
                   {"why", use.why},
                   {"roles", runs(use.roles)}};
    if (!use.weights.empty()) result["weights"] = shortNumbers(use.weights, "weights of light " + use.name);
    if (!use.bounds.empty()) result["bounds"] = shortNumbers(use.bounds, "bounds of light " + use.name);
    return result;
  }

  /// [[61, "far"], [4, "blended"], ...]: how many frames in a row.
  static Json runs(const std::vector<LightRole>& roles) {
    Json result = Json::array();
    for (std::size_t first = 0; first < roles.size();) {
      std::size_t end = first;
      while (end < roles.size() && roles[end] == roles[first]) ++end;
      result.push_back({end - first, roleName(roles[first])});
      first = end;
    }
    return result;
  }

  /// Three digits: they are drawn, and there is one for every light and frame.
  Json shortNumbers(const std::vector<float>& values, std::string_view field) {
    Json result = Json::array();
    for (const float value : values) {
      if (number(static_cast<double>(value), field) == 0)
        result.push_back(0);
      else
        result.push_back(std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr));
    }
    return result;
  }

  Json figures(const ErrorFigures& errors, std::string_view name) {
    return {{"rms", number(errors.rms, fmt::format("{} rms", name))},
            {"max", number(errors.max, fmt::format("{} max", name))}};
  }

  Json picture(const Picture& report) {
    Json result = {{"label", report.label},
                   {"frame", report.frame},
                   {"time", number(report.time, "picture time")},
                   {"rms", number(report.rms, "picture rms")}};
    const auto addFile = [&result](const char* key, const std::string& path) {
      if (!path.empty()) result[key] = path;
    };
    addFile("image_png", report.imagePng);
    addFile("image_exr", report.imageExr);
    if (report.heatMapMax > 0) result["heat_map_max"] = number(report.heatMapMax, "heat_map_max");
    if (report.flip) result["flip"] = number(*report.flip, "picture flip");
    addFile("error_png", report.errorPng);
    addFile("error_exr", report.errorExr);
    return result;
  }

  std::string place_;
  std::string notFinite_;
};

}  // namespace

Result<nlohmann::ordered_json> reportJson(const Report& report) {
  Writer writer;
  Json document = writer.document(report);
  if (!writer.notFinite().empty()) return Error{writer.notFinite(), "report.json"};
  return document;
}

std::string jsonText(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rigel::tools
