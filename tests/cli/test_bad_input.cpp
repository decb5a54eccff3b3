// Bad input gets one clear line and exit code 1 (2 for bad use), and nothing is written.
#include "cli/run_program.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace rigel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// One triangle with a light, as glTF; each part can be replaced.
struct TinyScene {
  std::string nodes = R"([{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[0,2,0]}])";
  std::string roots = "[0,1]";
  std::string meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";
  std::string light = R"({"type":"point","intensity":5})";
  // Positions (0,0,0) (1,0,0) (0,0,1) as floats, then the indices 0 1 2 as 16-bit integers.
  std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAABAAIA";

  std::string json() const {
    return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,"scenes":[{"nodes":)" +
           roots + R"(}],"nodes":)" + nodes + R"(,"meshes":)" + meshes +
           R"(,"extensions":{"KHR_lights_punctual":{"lights":[)" + light +
           R"(]}},"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]},)"
           R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":36},)"
           R"({"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)" +
           data + R"("}]})";
  }
};

class BadInput : public ::testing::Test {
 protected:
  /// Runs a report on `scene`; expects exit code, one line of error with `cause`, and an untouched folder.
  void expectRefused(const std::string& scene, int exitCode, const std::string& cause,
                     const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"report", scene, "--out", folder_ / "out", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = runProgram(arguments);
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(cause));
    EXPECT_THAT(outcome.err, StartsWith("rigel: "));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }

  std::string fileOf(const TinyScene& scene) {
    writeFile(folder_.path() / "tiny.gltf", scene.json());
    return folder_ / "tiny.gltf";
  }

  TemporaryFolder folder_;
};

TEST_F(BadInput, TheTinySceneItselfIsFine) {
  const Outcome outcome =
      runProgram({"report", fileOf({}), "--out", folder_ / "out", "--quiet", "--rig", "constant;poly:4"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/report.html"));
}

TEST_F(BadInput, Files) {
  expectRefused(folder_ / "none.gltf", 1, "none.gltf");
  expectRefused(folder_.path().string(), 1, folder_.path().filename().string());
  expectRefused("sample:nope", 1, "street");  // lists what there is
  writeFile(folder_.path() / "text.gltf", "these are not the bytes you are looking for");
  expectRefused(folder_ / "text.gltf", 1, "text.gltf");
  writeFile(folder_.path() / "empty.glb", "");
  expectRefused(folder_ / "empty.glb", 1, "empty.glb");
  writeFile(folder_.path() / "short.glb", std::string("glTF\2\0\0\0\377\377\0\0", 12));
  expectRefused(folder_ / "short.glb", 1, "short.glb");
}

TEST_F(BadInput, Scenes) {
  TinyScene outOfRange;
  outOfRange.meshes = R"([{"primitives":[{"attributes":{"POSITION":7},"indices":1}]}])";
  expectRefused(fileOf(outOfRange), 1, "accessor 7");

  TinyScene loop;
  loop.nodes = R"([{"mesh":0,"children":[1]},{"children":[0]}])";
  expectRefused(fileOf(loop), 1, "tiny.gltf");

  TinyScene notANumber;  // the second position's x is a NaN
  notANumber.data = "AAAAAAAAAAAAAAAAAADAfwAAAAAAAAAAAAAAAAAAAAAAAIA/AAABAAIA";
  expectRefused(fileOf(notANumber), 1, "POSITION");

  TinyScene flat;  // all positions alike
  flat.data = "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAIA";
  expectRefused(fileOf(flat), 1, "area");

  TinyScene badIndex;  // vertex 9 of three
  badIndex.data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAABAAkA";
  expectRefused(fileOf(badIndex), 1, "tiny.gltf");

  TinyScene noMesh;
  noMesh.nodes = R"([{},{"extensions":{"KHR_lights_punctual":{"light":0}}}])";
  expectRefused(fileOf(noMesh), 1, "mesh");

  TinyScene negative;
  negative.light = R"({"type":"point","intensity":5,"extras":{"radius":-1}})";
  expectRefused(fileOf(negative), 1, "radius");

  TinyScene dark;
  dark.nodes = R"([{"mesh":0},{}])";
  expectRefused(fileOf(dark), 1, "no lights");
}

TEST_F(BadInput, Options) {
  expectRefused("sample:touch", 2, "unknown rig model", {"--rig", "spline:3"});
  expectRefused("sample:touch", 2, "given twice", {"--rig", "poly:6;poly:6"});
  expectRefused("sample:touch", 2, "the range is empty", {"--frames", "5:2"});
  expectRefused("sample:touch", 2, "--frames x", {"--frames", "x"});
  expectRefused("sample:touch", 2, "--exposure", {"--exposure", "nan"});
  expectRefused("sample:touch", 2, "--exposure", {"--exposure", "1e38"});
  expectRefused("sample:touch", 2, "--wrap", {"--wrap", "nan"});
  expectRefused("sample:touch", 2, "--near x: expected auto", {"--near", "x"});
  expectRefused("sample:touch", 2, "--near", {"--near", "65"});
  expectRefused("sample:touch", 2, "--rate", {"--rate", "0"});
  expectRefused("sample:touch", 2, "--error 0.05: no rig here chooses", {"--rig", "poly:6", "--error", "0.05"});
  expectRefused("sample:touch", 2, "no rig here chooses", {"--rig", "poly:6", "--budget-us", "100", "--near", "4"});
  expectRefused("sample:touch", 2, "--error 5: must be", {"--rig", "auto", "--error", "5"});
  expectRefused("sample:touch", 2, "--error 0.05 --total-error 0.1: only one of the two",
                {"--rig", "auto", "--error", "0.05", "--total-error", "0.1"});
  expectRefused("sample:touch", 2, "rig 'rbf:6': this model is for comparison on the CPU alone",
                {"--rig", "gradient;rbf:6", "--device", "gpu"});
  expectRefused("sample:touch", 1, "past the end", {"--frames", "100000:"});
  expectRefused("sample:touch", 1, "no clip 'nope'", {"--clip", "nope"});
  expectRefused("sample:touch", 1, "none.glb", {"--lights", folder_ / "none.glb"});
}

TEST_F(BadInput, AnOldReportSurvives) {
  const std::string out = folder_ / "report";
  ASSERT_EQ(runProgram({"report", "sample:figure1", "--out", out, "--quiet", "--rig", "constant"}).exitCode, 0);
  const auto before = std::filesystem::last_write_time(out + "/report.html");
  EXPECT_EQ(runProgram({"report", "sample:figure1", "sample:nope", "--out", out, "--quiet"}).exitCode, 1);
  EXPECT_EQ(std::filesystem::last_write_time(out + "/report.html"), before);
  EXPECT_TRUE(std::filesystem::exists(out + "/images"));
}

TEST_F(BadInput, OutThatIsAFile) {
  writeFile(folder_.path() / "file", "kept");
  const Outcome outcome =
      runProgram({"report", "sample:figure1", "--out", folder_ / "file", "--quiet", "--rig", "constant"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "file"));
}

}  // namespace
}  // namespace rigel::test
