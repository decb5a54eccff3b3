#include "pareto/pareto_json.h"

#include "pareto/pareto_axes.h"
#include "report/formats/report_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

/// A point as names and values, of which JSON and CSV are two spellings.
Json row(const ParetoPoint& p) {
  const auto number = [](double value) -> Json {
    if (!std::isfinite(value)) return value;
    return std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr);
  };
  const auto orNull = [&](std::optional<double> value) { return value ? number(*value) : Json(nullptr); };
  return {{"spec", p.spec},
          {"family", p.family},
          {"fit", p.fit},
          {"near", p.near},
          {"target", p.target},
          {"near_form", nearFormName(p.form)},
          {"bands", p.bands},
          {"storage", p.half ? "half" : "float"},
          {"arguments", p.arguments},
          {"sh_vectors", number(p.shVectors)},
          {"near_lights", number(p.nearLights)},
          {"projections", p.projections},
          {"bytes", p.bytes},
          {"spatial_rms", number(p.spatial.rms)},
          {"spatial_max", number(p.spatial.max)},
          {"total_rms", number(p.total.rms)},
          {"total_max", number(p.total.max)},
          {"frame_uncertainty", number(p.frameUncertainty)},
          {"fit_us", orNull(p.fitMicroseconds)},
          {"shade_ns_per_point", orNull(p.shadeNanoseconds)},
          {"gpu_ns_per_point", orNull(p.gpuNanoseconds)},
          {"modelled_ns_per_point", orNull(p.modelledNanoseconds)}};
}

Json fronts(const ParetoObject& object) {
  Json all = Json::array();
  for (const ParetoAxis& cost : costAxes())
    for (const ParetoAxis& error : errorAxes())
      all.push_back(
          {{"cost", cost.name}, {"error", error.name}, {"points", paretoFront(compared(object.points, cost, error))}});
  return all;
}

/// Of each `auto` point, for every pair of axes that it was measured by.
Json autoDistances(const ParetoObject& object) {
  Json all = Json::array();
  const int bands = comparedBands(object.points);
  for (std::size_t i = 0; i < object.points.size(); ++i) {
    const ParetoPoint& point = object.points[i];
    if (point.family != "auto" || !isCompared(point, bands)) continue;
    Json distances = Json::array();
    for (const ParetoAxis& cost : costAxes())
      for (const ParetoAxis& error : errorAxes()) {
        if (!std::isfinite(cost.of(point))) continue;
        const FrontDistance d =
            distanceToFront({cost.of(point), error.of(point)}, compared(object.points, cost, error));
        const auto ratio = [](double r) { return std::isfinite(r) ? Json(r) : Json(nullptr); };
        distances.push_back({{"cost", cost.name},
                             {"error", error.name},
                             {"cost_ratio", ratio(d.cost)},
                             {"error_ratio", ratio(d.error)}});
      }
    all.push_back({{"point", i}, {"distances", std::move(distances)}});
  }
  return all;
}

std::optional<Error> firstNotFinite(const Json& row, const std::string& object) {
  for (const auto& [name, value] : row.items())
    if (value.is_number_float() && !std::isfinite(value.get<double>()))
      return Error{fmt::format("{} is not a finite number", name),
                   fmt::format("{}: {}", object, row["arguments"].get<std::string>())};
  return std::nullopt;
}

std::string csvField(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  return csvCell(value.get<std::string>());
}

}  // namespace

Result<Json> paretoJson(const Pareto& pareto) {
  Json objects = Json::array();
  for (const ParetoObject& object : pareto.objects) {
    Json points = Json::array();
    for (const ParetoPoint& point : object.points) {
      points.push_back(row(point));
      if (auto error = firstNotFinite(points.back(), object.name)) return *error;
    }
    objects.push_back({{"name", object.name},
                       {"triangles", object.triangles},
                       {"samples", object.samples},
                       {"lights", object.lights},
                       {"mean_irradiance", object.meanIrradiance},
                       {"points", std::move(points)},
                       {"fronts", fronts(object)},
                       {"auto", autoDistances(object)}});
  }
  return Json{{"version", pareto.version},
              {"command", pareto.commandLine},
              {"machine",
               {{"cpu", pareto.machine.cpu}, {"vector", pareto.machine.vector}, {"threads", pareto.machine.threads}}},
              {"gpu", pareto.gpu.empty() ? Json(nullptr) : Json(pareto.gpu)},
              {"scene", pareto.scene},
              {"clip", pareto.clip},
              {"lights_from", pareto.lightsFrom},
              {"rate", pareto.rate},
              {"frames", pareto.frames},
              {"timed_frames", pareto.timed},
              {"repetitions", pareto.repetitions},
              {"points_per_frame", kShadedPoints},
              {"seconds", pareto.seconds},
              {"notes", pareto.notes},
              {"objects", std::move(objects)}};
}

std::string paretoCsv(const Pareto& pareto) {
  std::string text = "object";
  const Json names = row({});
  for (const auto& [name, value] : names.items()) text += ',' + name;
  text += '\n';
  for (const ParetoObject& object : pareto.objects)
    for (const ParetoPoint& point : object.points) {
      text += csvField(object.name);
      const Json fields = row(point);
      for (const auto& [name, value] : fields.items()) text += ',' + csvField(value);
      text += '\n';
    }
  return text;
}

}  // namespace rigel::tools
