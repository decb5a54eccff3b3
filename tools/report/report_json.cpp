#include "report/report_json.h"

#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    return {{"version", report.version},      {"command", report.commandLine},
            {"bands", report.bands},          {"exposure", number(report.exposure, "exposure")},
            {"verdict_slack", kVerdictSlack}, {"usable_error", kUsableError},
            {"effects", std::move(effects)},  {"scenes", std::move(scenes)},
            {"objects", std::move(objects)}};
  }

  const std::string& notFinite() const { return notFinite_; }

 private:
  Json number(double value, std::string_view field) {
    if (!std::isfinite(value) && notFinite_.empty()) notFinite_ = fmt::format("{}: {} is {}", place_, field, value);
    return value;
  }

  Json numberOrNull(std::optional<double> value, std::string_view field) {
    return value ? number(*value, field) : Json(nullptr);
  }

  Json scene(const SceneReport& report) {
    place_ = report.scene;
    Json lights = Json::array();
    for (const LightRow& light : report.lights)
      lights.push_back({{"name", light.name}, {"type", light.type}, {"summary", light.summary}});
    return {{"scene", report.scene},
            {"clip", report.clip},
            {"lights_from", report.lightsFrom},
            {"frames", report.frames},
            {"seconds", number(report.seconds, "seconds")},
            {"effects", report.effects},
            {"notes", report.notes},
            {"lights", std::move(lights)}};
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
    for (const RigReport& rigReport : report.rigs) result["rigs"].push_back(rig(rigReport, report, sceneReport));
    place_ = fmt::format("{}, object {}", sceneReport.scene, report.name);
    result["pictures"] = Json::array();
    for (const Picture& pictureReport : report.pictures) result["pictures"].push_back(picture(pictureReport));
    return result;
  }

  Json rig(const RigReport& report, const ObjectReport& objectReport, const SceneReport& sceneReport) {
    place_ = fmt::format("{}, object {}, rig {}", sceneReport.scene, objectReport.name, report.spec);
    // Every light is in the rig, none is evaluated beside it: near lists are empty because nothing is near.
    Json result = {{"spec", report.spec},
                   {"sh_vectors", report.shVectors},
                   {"projections", report.projections},
                   {"near_lights", 0},
                   {"spatial", figures(report.spatial, "spatial")},
                   {"total", figures(report.total, "total")},
                   {"fit_us", number(report.fitMicroseconds, "fit_us")},
                   {"shade_ns_per_point", number(report.shadeNanosecondsPerPoint, "shade_ns_per_point")},
                   {"bytes", report.bytes},
                   {"max_jump", numberOrNull(report.maxJump, "max_jump")},
                   {"condition", number(report.condition, "condition")}};
    Json stages = Json::object();
    for (const StageTime& stage : report.stages) stages[stage.name] = number(stage.microseconds, stage.name);
    result["stages"] = std::move(stages);
    Json frames = Json::array();
    for (const RigFrame& frame : report.frames)
      frames.push_back({{"time", number(frame.time, "time")},
                        {"spatial_rms", number(frame.spatialRms, "spatial_rms")},
                        {"total_rms", number(frame.totalRms, "total_rms")},
                        {"sh_vectors", report.shVectors},
                        {"near", Json::array()}});
    result["frames"] = std::move(frames);
    Json lights = Json::array();
    for (const LightRow& light : sceneReport.lights) lights.push_back({{"name", light.name}, {"type", light.type}});
    result["lights"] = std::move(lights);
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
