// report.json: the names scripts rely on, the values behind them, and names from files that try to break it.
#include "report/formats/report_json.h"

#include "report_fixture.h"

#include <gmock/gmock.h>

#include <limits>

namespace rigel::tests {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

/// As a script sees it: written, then parsed again.
Json parsedReport(const tools::Report& report) {
  const auto document = tools::reportJson(report);
  EXPECT_TRUE(document) << (document ? "" : document.error().line());
  return document ? Json::parse(tools::jsonText(*document, 1)) : Json();
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

TEST(ReportJson, HasTheNamesOfTheDesign) {
  const Json json = parsedReport(madeUpReport());
  EXPECT_THAT(keys(json), testing::IsSupersetOf({"effects", "objects"}));
  ASSERT_EQ(json["objects"].size(), 2u);
  for (const Json& object : json["objects"]) {
    EXPECT_THAT(keys(object), testing::IsSupersetOf({"name", "triangles", "rigs", "scene"}));
    ASSERT_EQ(object["rigs"].size(), 8u);
    for (const Json& rig : object["rigs"]) {
      EXPECT_THAT(keys(rig), testing::IsSupersetOf({"spec", "sh_vectors", "projections", "near_lights", "spatial",
                                                    "total", "fit_us", "shade_ns_per_point", "bytes", "max_jump",
                                                    "estimate", "stages", "frames", "lights"}));
      EXPECT_THAT(keys(rig["spatial"]), testing::ElementsAre("rms", "max"));
      EXPECT_THAT(keys(rig["total"]), testing::ElementsAre("rms", "max"));
      ASSERT_FALSE(rig["frames"].empty());
      for (const Json& frame : rig["frames"])
        EXPECT_THAT(keys(frame),
                    testing::IsSupersetOf({"time", "spatial_rms", "total_rms", "estimate", "sh_vectors", "near"}));
      for (const Json& light : rig["lights"])
        EXPECT_THAT(keys(light), testing::IsSupersetOf({"name", "type", "bound", "share", "near_frames", "blend_frames",
                                                        "far_frames", "culled_frames", "why"}));
    }
  }
}

TEST(ReportJson, KeepsEveryValueToTheLastBit) {
  tools::Report report = madeUpReport();
  tools::RigReport& rig = report.scenes[0].objects[0].rigs[2];
  rig.spatial.rms = 0.1 + 0.2;  // 0.30000000000000004
  rig.total.max = std::numeric_limits<double>::denorm_min();
  rig.fitMicroseconds = std::numeric_limits<double>::max();
  const Json json = parsedReport(report);
  const Json& written = json["objects"][0]["rigs"][2];
  EXPECT_EQ(written["spec"], "mixed:l3,g,c");
  EXPECT_EQ(written["spatial"]["rms"].get<double>(), rig.spatial.rms);
  EXPECT_EQ(written["total"]["max"].get<double>(), rig.total.max);
  EXPECT_EQ(written["fit_us"].get<double>(), rig.fitMicroseconds);
  EXPECT_EQ(written["sh_vectors"], 6);
  EXPECT_EQ(written["projections"], 12);
  EXPECT_EQ(written["near_lights"], 0);
  EXPECT_EQ(written["bytes"], 672);
  EXPECT_EQ(written["stages"]["fit"].get<double>(), rig.stages[1].microseconds);
  ASSERT_EQ(written["frames"].size(), 61u);
  EXPECT_EQ(written["frames"][60]["time"].get<double>(), 2.0);
  EXPECT_EQ(written["frames"][60]["total_rms"].get<double>(), rig.frames[60].totalRms);
  EXPECT_EQ(written["frames"][60]["near"], Json::array());
}

TEST(ReportJson, DisksAreASectionOfScenesThatHaveThem) {
  const Json json = parsedReport(madeUpReport());
  EXPECT_FALSE(json["scenes"][1].contains("disks"));
  const Json& disks = json["scenes"][0]["disks"];
  EXPECT_THAT(keys(disks), testing::IsSupersetOf(
                               {"pairs", "sh_relative_to", "irradiance_relative_to", "methods", "choice", "uses"}));
  ASSERT_EQ(disks["methods"].size(), 4u);
  EXPECT_EQ(disks["methods"][1]["method"], "quadrature-6");
  EXPECT_EQ(disks["methods"][1]["sh"]["max"], 3.9e-5);
  EXPECT_EQ(disks["methods"][1]["irradiance"]["rms"], 0.021);
  EXPECT_EQ(disks["methods"][1]["ns"], 43.7);
  EXPECT_TRUE(disks["methods"][3]["sh"].is_null());
  ASSERT_EQ(disks["uses"].size(), 6u);
  EXPECT_EQ(disks["uses"][5], Json({{"light", "sconce 4"},
                                    {"object", "car"},
                                    {"rig", "auto"},
                                    {"method", "near, quadrature-6"},
                                    {"why", "close"}}));
}

TEST(ReportJson, FlattensScenesAndNamesThem) {
  const Json json = parsedReport(madeUpReport());
  EXPECT_EQ(json["objects"][0]["scene"], "sample:street");
  EXPECT_EQ(json["objects"][1]["scene"], "characters/soldier1.gltf");
  EXPECT_EQ(json["objects"][1]["scene_index"], 1);
  EXPECT_EQ(json["effects"], Json({"point", "spot", "sphere", "wrap"})) << "each once, in order of appearance";
  EXPECT_EQ(json["scenes"][0]["lights"].size(), 60u);
}

TEST(ReportJson, LeavesOutWhatWasNotWritten) {
  const Json json = parsedReport(madeUpReport());
  const Json& truth = json["objects"][0]["pictures"][0];
  EXPECT_EQ(truth["label"], "truth");
  EXPECT_TRUE(truth.contains("image_png"));
  EXPECT_FALSE(truth.contains("error_png"));
  EXPECT_FALSE(truth.contains("error_exr"));
  EXPECT_FALSE(truth.contains("heat_map_max"));
  EXPECT_FALSE(truth.contains("flip"));
  EXPECT_EQ(json["objects"][0]["pictures"][1]["heat_map_max"], 0.5);
  EXPECT_GT(json["objects"][0]["pictures"][1]["flip"], 0);
}

TEST(ReportJson, WhatWasNotMeasuredIsNull) {
  const Json json = parsedReport(madeUpReport());
  const Json& moving = json["objects"][0];
  EXPECT_TRUE(moving["truth"][0]["movement"].is_null());   // nothing precedes it
  EXPECT_TRUE(moving["truth"][40]["movement"].is_null());  // a clip starts over
  EXPECT_GT(moving["truth"][41]["movement"].get<double>(), 0);
  EXPECT_GT(moving["rigs"][0]["max_jump"].get<double>(), 0);
  const Json& still = json["objects"][1];
  ASSERT_EQ(still["truth"].size(), 1u);
  EXPECT_TRUE(still["truth"][0]["movement"].is_null());
  EXPECT_TRUE(still["rigs"][0]["max_jump"].is_null());
}

TEST(ReportJson, SaysWhereErrorsComeFrom) {
  const tools::Report report = madeUpReport();
  const Json json = parsedReport(report);
  const tools::RigReport& rig = report.scenes[0].objects[0].rigs[2];
  const Json& written = json["objects"][0]["rigs"][2];
  const Json& parts = written["parts"];
  ASSERT_EQ(parts["causes"].size(), tools::kErrorCauses);
  double sum = parts["interaction"];
  for (std::size_t k = 0; k < tools::kErrorCauses; ++k) {
    EXPECT_EQ(parts["causes"][k]["cause"], tools::kErrorCauseNames[k]);
    EXPECT_EQ(parts["causes"][k]["square"], rig.parts->parts[k].square);
    EXPECT_EQ(parts["causes"][k]["without"], rig.parts->parts[k].without);
    sum += parts["causes"][k]["square"].get<double>();
  }
  EXPECT_NEAR(sum, parts["total"], 1e-12);
  EXPECT_EQ(parts["unclamped"], rig.parts->unclamped);
  EXPECT_EQ(written["body_parts"][0]["parent"], nullptr);
  EXPECT_EQ(written["body_parts"][2]["parent"], 1);
  EXPECT_EQ(written["body_parts"][2]["name"], "mirror");
  EXPECT_THAT(keys(written["body_parts"][2]),
              testing::ElementsAre("name", "parent", "nodes", "samples", "area", "share", "rms", "max", "mean"));
  EXPECT_EQ(written["histogram"]["absolute"]["counts"].size(), tools::ErrorHistogram::kAbsoluteBins);
  EXPECT_EQ(written["histogram"]["signed"]["counts"][7], rig.histogram->signedBins[7]);
  EXPECT_EQ(written["histogram"]["p90"], rig.histogram->p90);
  const Json without = parsedReport(smallestReport())["objects"][0]["rigs"][0];
  for (const char* field : {"parts", "body_parts", "histogram"}) EXPECT_FALSE(without.contains(field)) << field;
}

TEST(ReportJson, SaysWhatSharingAFrameCost) {
  const Json json = parsedReport(crowdReport());
  const Json& budgets = json["scenes"][0]["budgets"];
  ASSERT_EQ(budgets.size(), 2u);
  EXPECT_THAT(keys(budgets[0]), testing::IsSupersetOf({"spec", "budget_us", "goal", "mean_us", "most_us"}));
  EXPECT_EQ(budgets[0]["goal"], 0.03);
  EXPECT_TRUE(budgets[1]["goal"].is_null());
  EXPECT_EQ(budgets[0]["sentence"],
            "2500 us a frame for 3 objects lit by auto: 2412 us on average, 2688 us at most; too long in 4 frames; no "
            "object takes more than an error of 3.00 % needs.");
  const auto budgetOf = [&](int object) { return json["objects"][object]["rigs"][7]["budget"]; };
  EXPECT_EQ(budgetOf(0)["gave_up"], true);
  EXPECT_EQ(budgetOf(0)["given_up"],
            "total RMS 6.11 % instead of 3.06 % with the frame to itself; the same 5.5 SH vectors, 1.3 near lights "
            "instead of 2");
  EXPECT_EQ(budgetOf(0)["alone"]["us"], 1640);
  EXPECT_EQ(budgetOf(2)["gave_up"], false);
  EXPECT_EQ(budgetOf(2)["given_up"], "nothing");
  EXPECT_FALSE(json["objects"][0]["rigs"][0].contains("budget"));
  EXPECT_EQ(parsedReport(madeUpReport())["scenes"][0]["budgets"], Json::array());
}

TEST(ReportJson, RefusesEveryNumberThatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  using Edit = void (*)(tools::ObjectReport&, double);
  const std::pair<const char*, Edit> edits[] = {
      {"object car: mean_irradiance", [](auto& object, double v) { object.meanIrradiance = v; }},
      {"object car: truth movement", [](auto& object, double v) { object.truth[3].movement = v; }},
      {"object car, rig gradient: spatial rms", [](auto& object, double v) { object.rigs[1].spatial.rms = v; }},
      {"object car, rig gradient: total max", [](auto& object, double v) { object.rigs[1].total.max = v; }},
      {"object car, rig gradient: max_jump", [](auto& object, double v) { object.rigs[1].maxJump = v; }},
      {"object car, rig gradient: condition", [](auto& object, double v) { object.rigs[1].condition = v; }},
      {"object car, rig gradient: total_rms", [](auto& object, double v) { object.rigs[1].frames[7].totalRms = v; }},
      {"object car, rig gradient: project", [](auto& object, double v) { object.rigs[1].stages[0].microseconds = v; }},
      {"object car, rig gradient: parts without",
       [](auto& object, double v) { object.rigs[1].parts->parts[2].without = v; }},
      {"object car, rig gradient: body part mean",
       [](auto& object, double v) { object.rigs[1].bodyParts[1].mean = v; }},
      {"object car, rig gradient: histogram p90", [](auto& object, double v) { object.rigs[1].histogram->p90 = v; }},
      {"object car: picture rms", [](auto& object, double v) { object.pictures[1].rms = v; }},
  };
  for (const auto& [place, edit] : edits) {
    for (const double value : {nan, infinity, -infinity}) {
      tools::Report report = madeUpReport();
      edit(report.scenes[0].objects[0], value);
      const auto document = tools::reportJson(report);
      ASSERT_FALSE(document) << place << " = " << value;
      EXPECT_THAT(document.error().line(), HasSubstr(place));
      EXPECT_THAT(document.error().line(), HasSubstr("sample:street"));
    }
  }
}

TEST(ReportJson, CarriesAnyName) {
  const Json json = parsedReport(hostileReport());
  EXPECT_EQ(json["objects"][0]["name"], kHostileMarkup);
  EXPECT_EQ(json["objects"][0]["scene"], kHostileQuotes);
  EXPECT_EQ(json["objects"][0]["rigs"][0]["spec"], kHostileSpec);
  EXPECT_EQ(json["scenes"][0]["notes"][1], "escape \x1b[2J bell \a");
  EXPECT_THAT(json["scenes"][0]["lights"][0]["name"].get<std::string>(), HasSubstr("\xEF\xBF\xBD"))
      << "bytes that are no UTF-8 become the replacement character";
  EXPECT_THAT(json["scenes"][0]["lights"][0]["name"].get<std::string>(), HasSubstr(" no UTF-8 "));
}

TEST(ReportJson, EmptyReport) {
  const Json json = parsedReport(tools::Report{});
  EXPECT_EQ(json["objects"], Json::array());
  EXPECT_EQ(json["effects"], Json::array());
}

}  // namespace
}  // namespace rigel::tests
