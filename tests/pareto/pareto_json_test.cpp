#include "pareto/pareto_json.h"

#include "made_up_pareto.h"
#include "pareto/pareto_axes.h"

#include <gmock/gmock.h>

#include <limits>
#include <sstream>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using nlohmann::ordered_json;

constexpr const char* kNumbers[] = {"sh_vectors", "near_lights", "projections",
                                    "bytes",      "spatial_rms", "spatial_max",
                                    "total_rms",  "total_max",   "frame_uncertainty"};
constexpr const char* kTimes[] = {"fit_us", "shade_ns_per_point", "gpu_ns_per_point", "modelled_ns_per_point"};
constexpr const char* kTexts[] = {"spec", "family", "fit", "near", "target", "near_form", "storage", "arguments"};

TEST(ParetoJson, HoldsItsNames) {
  const auto document = paretoJson(madeUpPareto(true));
  ASSERT_TRUE(document) << document.error().line();
  for (const char* name : {"version", "command", "machine", "gpu", "scene", "clip", "lights_from", "rate", "frames",
                           "timed_frames", "repetitions", "points_per_frame", "seconds", "notes", "objects"})
    EXPECT_TRUE(document->contains(name)) << name;
  for (const char* name : {"cpu", "vector", "threads"}) EXPECT_TRUE((*document)["machine"].contains(name)) << name;
  ASSERT_EQ((*document)["objects"].size(), 3u);
  for (const ordered_json& object : (*document)["objects"]) {
    for (const char* name : {"name", "triangles", "samples", "lights", "mean_irradiance", "points", "fronts", "auto"})
      EXPECT_TRUE(object.contains(name)) << name;
    ASSERT_GE(object["points"].size(), 2u);
    for (const ordered_json& point : object["points"]) {
      for (const char* name : kNumbers) EXPECT_TRUE(point[name].is_number()) << name;
      for (const char* name : kTimes) EXPECT_TRUE(point[name].is_number() || point[name].is_null()) << name;
      for (const char* name : kTexts) EXPECT_TRUE(point[name].is_string()) << name;
    }
  }
}

TEST(ParetoJson, FrontsAreOfWhatCompares) {
  const Pareto pareto = madeUpPareto(true);
  const auto document = paretoJson(pareto);
  ASSERT_TRUE(document) << document.error().line();
  const ordered_json& object = (*document)["objects"][0];
  EXPECT_EQ(object["fronts"].size(), costAxes().size() * errorAxes().size());
  for (const ordered_json& front : object["fronts"]) {
    EXPECT_FALSE(front["points"].empty()) << front["cost"] << front["error"];
    for (const ordered_json& index : front["points"]) {
      const ordered_json& point = object["points"][index.get<std::size_t>()];
      EXPECT_EQ(point["bands"], 3);
      EXPECT_EQ(point["storage"], "float");
      EXPECT_EQ(point["near_form"], "exact");
    }
  }
  const auto points = [&](const char* cost, const char* error) {
    for (const ordered_json& front : object["fronts"])
      if (front["cost"] == cost && front["error"] == error) return front["points"];
    return ordered_json();
  };
  // The lattices are worse and as dear, so that on this front are poly:4, 6, 12 and the auto that knows no error below.
  const ordered_json bytes = points("bytes", "spatial_rms");
  ASSERT_GE(bytes.size(), 3u);
  for (const ordered_json& index : bytes)
    EXPECT_NE(object["points"][index.get<std::size_t>()]["family"], "lattice") << index;
}

TEST(ParetoJson, TellsHowFarAutoIs) {
  const Pareto pareto = madeUpPareto(true);
  const auto document = paretoJson(pareto);
  ASSERT_TRUE(document) << document.error().line();
  const ordered_json& object = (*document)["objects"][0];
  ASSERT_EQ(object["auto"].size(), 2u);
  const ParetoAxis &cost = axisNamed("modelled_ns_per_point"), &error = axisNamed("total_rms");
  const ParetoObject& car = pareto.objects[0];
  int compares = 0;
  for (const ordered_json& entry : object["auto"]) {
    const ParetoPoint& point = car.points[entry["point"].get<std::size_t>()];
    EXPECT_EQ(point.family, "auto");
    for (const ordered_json& d : entry["distances"]) {
      if (d["cost"] != cost.name || d["error"] != error.name) continue;
      const FrontDistance expected =
          distanceToFront({cost.of(point), error.of(point)}, compared(car.points, cost, error));
      EXPECT_DOUBLE_EQ(d["cost_ratio"].get<double>(), expected.cost);
      EXPECT_DOUBLE_EQ(d["error_ratio"].get<double>(), expected.error);
      ++compares;
    }
  }
  EXPECT_EQ(compares, 2);
}

TEST(ParetoJson, WithoutADeviceItsTimesAreNull) {
  const auto document = paretoJson(madeUpPareto(false));
  ASSERT_TRUE(document) << document.error().line();
  EXPECT_TRUE((*document)["gpu"].is_null());
  for (const ordered_json& point : (*document)["objects"][0]["points"])
    EXPECT_TRUE(point["gpu_ns_per_point"].is_null());
}

TEST(ParetoJson, AFigureThatIsNotFiniteIsAnError) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Pareto pareto = madeUpPareto(true);
    pareto.objects[0].points[3].total.max = bad;
    const auto document = paretoJson(pareto);
    ASSERT_FALSE(document);
    EXPECT_THAT(document.error().line(), testing::HasSubstr("total_max"));
    EXPECT_THAT(document.error().line(), testing::HasSubstr(pareto.objects[0].points[3].arguments));
  }
}

TEST(ParetoCsv, HasALineAPoint) {
  Pareto pareto = madeUpPareto(true);
  pareto.objects[0].name = "a \"car\", red";
  std::istringstream lines(paretoCsv(pareto));
  std::string head, line;
  std::getline(lines, head);
  EXPECT_THAT(head, testing::StartsWith("object,spec,family,fit,near,target,near_form,bands,storage,arguments,"));
  const auto fields = std::ranges::count(head, ',');
  std::getline(lines, line);
  EXPECT_THAT(line, testing::StartsWith("\"a \"\"car\"\", red\",poly:4,poly,,0,,exact,2,float,"));
  EXPECT_EQ(std::ranges::count(line, ','), fields + 1);  // one is in the name
  std::size_t count = 1;
  while (std::getline(lines, line)) ++count;
  std::size_t points = 0;
  for (const ParetoObject& object : pareto.objects) points += object.points.size();
  EXPECT_EQ(count, points);
}

}  // namespace
}  // namespace rigel::tests
