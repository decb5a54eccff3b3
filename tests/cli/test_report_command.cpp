// The main job end to end: what the report says must make sense.
#include "cli/run_program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace rigel::test
