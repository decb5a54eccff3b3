// The main job end to end: what the report says must make sense.
#include "cli/run_program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace rigel::test {
namespace {

using nlohmann::json;

json report(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.begin(), "report");
  arguments.insert(arguments.end(), {"--no-images", "--quiet", "--json", "--out", folder / "out"});
  const Outcome outcome = runProgram(arguments);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  return json::parse(outcome.out, nullptr, false);
}

const json& rigOf(const json& object, const std::string& spec) {
  for (const json& rig : object["rigs"])
    if (rig["spec"] == spec) return rig;
  throw std::runtime_error("no rig " + spec);
}

double spatialRms(const json& object, const std::string& spec) { return rigOf(object, spec)["spatial"]["rms"]; }

TEST(ReportCommand, ReproducesThePapersFigure) {
  // Lights just off the corners and the roof of a car's box. There, and only there, the six-vector mixed rig beats the
  // lattice of twelve corner samples and comes near the one of sixty-four.
  const json figure =
      report({"sample:figure1", "--rig", "constant;gradient;lattice:3x2x2;mixed:l3,g,c;lattice:8x4x2"})["objects"][0];
  const double mixed = spatialRms(figure, "mixed:l3,g,c");
  EXPECT_LT(mixed, spatialRms(figure, "constant"));
  EXPECT_LT(mixed, spatialRms(figure, "gradient"));
  EXPECT_LT(mixed, 0.5 * spatialRms(figure, "lattice:3x2x2"));
  EXPECT_LT(mixed, 1.15 * spatialRms(figure, "lattice:8x4x2"));

  const json street =
      report({"sample:street", "--frames", "::20", "--rig", "lattice:3x2x2;mixed:l3,g,c;lattice:8x4x2"})["objects"][0];
  EXPECT_GT(spatialRms(street, "mixed:l3,g,c"), spatialRms(street, "lattice:3x2x2"));
  EXPECT_GT(spatialRms(street, "mixed:l3,g,c"), 1.5 * spatialRms(street, "lattice:8x4x2"));
}

TEST(ReportCommand, JsonHoldsTheFixedNames) {
  const json document = report({"sample:touch", "--frames", "0:20:10", "--rig", "gradient;poly:6"});
  EXPECT_THAT(document["effects"].get<std::vector<std::string>>(), ::testing::Not(::testing::IsEmpty()));
  ASSERT_EQ(document["objects"].size(), 1u);
  const json& object = document["objects"][0];
  EXPECT_GT(object["triangles"].get<int>(), 1000);
  ASSERT_EQ(object["rigs"].size(), 2u);
  for (const json& rig : object["rigs"]) {
    for (const char* name :
         {"spec", "sh_vectors", "projections", "near_lights", "fit_us", "shade_ns_per_point", "bytes", "max_jump"})
      EXPECT_TRUE(rig.contains(name)) << name;
    for (const char* error : {"spatial", "total"}) {
      EXPECT_GT(rig[error]["rms"].get<double>(), 0);
      EXPECT_GE(rig[error]["max"].get<double>(), rig[error]["rms"].get<double>());
    }
    ASSERT_EQ(rig["frames"].size(), 3u);
    EXPECT_NEAR(rig["frames"][2]["time"].get<double>(), 20 / 30.0, 1e-9);
    EXPECT_EQ(rig["bytes"], 112 * rig["sh_vectors"].get<int>());
  }
}

TEST(ReportCommand, NearLightsLeaveTheRigAndLessError) {
  const std::vector<std::string> arguments{"sample:street", "--frames", "40:60:4", "--rig", "poly:6"};
  std::vector<std::string> near = arguments;
  near.insert(near.end(), {"--near", "2"});
  const json allFar = report(arguments), two = report(near);
  const json& far = allFar["objects"][0]["rigs"][0];
  const json& rig = two["objects"][0]["rigs"][0];
  EXPECT_EQ(far["near_lights"], 0);
  EXPECT_GT(rig["near_lights"].get<double>(), 1);
  EXPECT_LE(rig["near_lights"].get<double>(), 2);
  EXPECT_EQ(rig["asked"], "--near 2");
  EXPECT_LT(rig["spatial"]["rms"].get<double>(), 0.6 * far["spatial"]["rms"].get<double>());
  EXPECT_LT(rig["total"]["rms"].get<double>(), 0.6 * far["total"]["rms"].get<double>());
  for (const json& frame : far["frames"]) EXPECT_TRUE(frame["near"].empty());
  for (const json& frame : rig["frames"]) EXPECT_LE(frame["near"].size(), 2u);

  const auto effects = two["effects"].get<std::vector<std::string>>();
  EXPECT_THAT(effects, ::testing::Contains(::testing::StartsWith("light.near.")));
  EXPECT_THAT(effects, ::testing::Not(::testing::Contains("rig.auto")));
  EXPECT_THAT(allFar["effects"].get<std::vector<std::string>>(),
              ::testing::Not(::testing::Contains(::testing::StartsWith("light.near."))));
  EXPECT_FALSE(far["stages"].contains("choose")) << "nothing was chosen";
  EXPECT_TRUE(rig["stages"].contains("choose"));
}

TEST(ReportCommand, EveryLightIsAccountedForInEveryFrame) {
  const json document = report({"sample:stage", "--frames", "0:80:8", "--rig", "poly:6;auto", "--near", "auto"});
  for (const json& rig : document["objects"][0]["rigs"]) {
    const std::size_t frames = rig["frames"].size();
    ASSERT_EQ(rig["lights"].size(), document["scenes"][0]["lights"].size());
    double shares = 0;
    for (const json& light : rig["lights"]) {
      std::size_t counted = 0;
      for (const char* role : {"near_frames", "blend_frames", "far_frames", "culled_frames"})
        counted += light[role].get<std::size_t>();
      EXPECT_EQ(counted, frames) << light["name"];
      std::size_t weighed = 0;
      for (const json& frame : rig["frames"])
        for (const json& name : frame["near"]) weighed += name == light["name"] ? 1 : 0;
      EXPECT_EQ(weighed, light["near_frames"].get<std::size_t>() + light["blend_frames"].get<std::size_t>());
      EXPECT_FALSE(light["why"].get<std::string>().empty());
      EXPECT_GE(light["bound"].get<double>(), 0);
      shares += light["share"].get<double>();
    }
    EXPECT_NEAR(shares, 1, 1e-3) << rig["spec"];
  }
}

TEST(ReportCommand, AutoRigsMeetTheirTargetAndSayWhatTheyTook) {
  const auto rigFor = [](const char* target) {
    return report({"sample:street", "--frames", "::8", "--rig", "auto", "--error", target})["objects"][0]["rigs"][0];
  };
  const json rough = rigFor("0.1"), fine = rigFor("0.02");
  EXPECT_EQ(fine["asked"], "--near auto --error 0.02");
  EXPECT_LT(rough["spatial"]["rms"].get<double>(), 0.1);
  EXPECT_LT(fine["spatial"]["rms"].get<double>(), 0.02);
  EXPECT_LT(rough["modelled_ns_per_point"].get<double>(), fine["modelled_ns_per_point"].get<double>());
  for (const json& rig : {rough, fine}) {
    double vectors = 0, squares = 0;
    for (const json& frame : rig["frames"]) {
      vectors += frame["sh_vectors"].get<double>();
      squares += std::pow(frame["estimate"].get<double>(), 2);
    }
    const auto count = static_cast<double>(rig["frames"].size());
    EXPECT_NEAR(rig["sh_vectors"].get<double>(), vectors / count, 1e-9);
    EXPECT_NEAR(rig["estimate"].get<double>(), std::sqrt(squares / count), 1e-9);
  }
}

TEST(ReportCommand, RateCountsFrames) {
  const json at30 = report({"sample:touch", "--frames", "30:33", "--rig", "constant"});
  const json at120 = report({"sample:touch", "--frames", "120:132", "--rate", "120", "--rig", "constant"});
  EXPECT_EQ(at120["rate"], 120);
  const json& slow = at30["objects"][0];
  const json& fast = at120["objects"][0];
  EXPECT_EQ(slow["truth"][3]["time"], fast["truth"][12]["time"]);
  EXPECT_EQ(slow["truth"][3]["mean_irradiance"], fast["truth"][12]["mean_irradiance"]);
  EXPECT_LT(fast["rigs"][0]["max_jump"].get<double>(), slow["rigs"][0]["max_jump"].get<double>());
}

TEST(ReportCommand, FiguresAreReproducible) {
  const std::vector<std::string> arguments{"sample:stage", "--frames", "0:30:15", "--rig", "poly:6;lattice:3x2x2@lsq"};
  const json a = report(arguments);
  const json b = report(arguments);
  for (int r = 0; r < 2; ++r)
    for (const char* error : {"spatial", "total"})
      EXPECT_EQ(a["objects"][0]["rigs"][r][error], b["objects"][0]["rigs"][r][error]);
}

TEST(ReportCommand, ExposureLeavesRelativeErrors) {
  const std::vector<std::string> arguments{"sample:stage", "--frames", "20", "--rig", "mixed:l3,g,c"};
  std::vector<std::string> bright = arguments;
  bright.insert(bright.end(), {"--exposure", "16"});
  const double a = spatialRms(report(arguments)["objects"][0], "mixed:l3,g,c");
  const double b = spatialRms(report(bright)["objects"][0], "mixed:l3,g,c");
  EXPECT_NEAR(a, b, 1e-6 * a);  // a power of two: only the last bits of sums may differ
}

TEST(ReportCommand, HalfLambertNeedsNoMoreThanThreeBands) {
  // At wrap 1 three bands are the exact kernel: what is left of the total error is the spatial one (and the clamp).
  const json document = report({"sample:stage", "--frames", "45", "--wrap", "1", "--rig", "lattice:8x4x2"});
  const json& rig = document["objects"][0]["rigs"][0];
  EXPECT_NEAR(rig["total"]["rms"].get<double>(), rig["spatial"]["rms"].get<double>(),
              0.02 * rig["spatial"]["rms"].get<double>());
}

TEST(ReportCommand, AllClipsOfRealCharactersWithBorrowedLights) {
  const std::filesystem::path data(RIGEL_SHARED_DATA);
  if (!std::filesystem::exists(data)) {
    std::cout << "the shared data are absent: nothing to compare" << std::endl;
    return;
  }
  for (const std::string file : {"characters/soldier/soldier1.gltf", "characters/Fox.glb", "vehicles/car/car.gltf",
                                 "scenes/collisions_level/level.gltf"}) {
    const json document = report({(data / file).string(), "--clip", "all", "--frames", "::30", "--lights",
                                  "sample:street", "--rig", "constant;poly:6"});
    ASSERT_FALSE(document["objects"].empty()) << file;
    for (const json& object : document["objects"])
      EXPECT_LT(spatialRms(object, "poly:6"), spatialRms(object, "constant")) << file << " " << object["name"];
  }
}

TEST(ReportCommand, ACapturedRunIsOneFile) {
  const TemporaryFolder folder;
  const std::string file = folder / "bug.glb";
  const json first = report({"sample:touch", "--lights", "sample:street", "--rig", "constant", "--frames", "2:4",
                             "--bands", "2", "--capture", file});
  const json again = report({file});
  EXPECT_EQ(again["bands"], 2);
  EXPECT_EQ(again["objects"].size(), first["objects"].size());
  const json &a = rigOf(first["objects"][0], "constant"), &b = rigOf(again["objects"][0], "constant");
  EXPECT_EQ(b["frames"].size(), 3u);
  EXPECT_NEAR(b["total"]["rms"], a["total"]["rms"], 1e-5 * a["total"]["rms"].get<double>());
  EXPECT_THAT(again["scenes"][0]["notes"].dump(),
              testing::HasSubstr("settings from the file: rigs, clip, frames, rate, bands, exposure"));

  // What is said beside the file goes before what the file says.
  const json other = report({file, "--rig", "gradient", "--frames", "3", "--bands", "3"});
  EXPECT_EQ(other["bands"], 3);
  EXPECT_EQ(rigOf(other["objects"][0], "gradient")["frames"].size(), 1u);
  EXPECT_THAT(other["scenes"][0]["notes"].dump(), testing::HasSubstr("settings from the file: clip, rate, exposure"));
}

}  // namespace
}  // namespace rigel::test
