// rigel render: its figures, files and errors.
#include "cli/run_program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace rigel::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// A variable of the environment for as long as a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

/// The program unloads the driver before it ends, and what the driver keeps in globals then looks lost. tests/gpu look
/// for leaks while it is there.
std::string withoutLeakCheck() {
  const char* options = std::getenv("ASAN_OPTIONS");
  return std::string(options != nullptr ? options : "") + ":detect_leaks=0";
}

class RenderCommand : public ::testing::Test {
 protected:
  Outcome render(const std::string& scene, const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", scene, "--quiet", "--out", out};
    for (const auto& [option, value] : {std::pair{"--size", "160x90"}, {"--supersampling", "1"}})
      if (std::ranges::find(more, option) == more.end()) arguments.insert(arguments.end(), {option, value});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  }
  json figures(const std::string& scene, const std::string& out, std::vector<std::string> more) {
    more.push_back("--json");
    const Outcome outcome = render(scene, out, more);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }
  /// One line that says `cause`, and no file.
  void expectRefused(const std::string& scene, const std::string& out, const std::vector<std::string>& more,
                     int exitCode, const std::string& cause) {
    const Outcome outcome = render(scene, out, more);
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("rigel: "), HasSubstr(cause)));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(files(), IsEmpty());
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder_;
  TemporaryFolder cache_;
  Variable cacheHome_{"XDG_CACHE_HOME", cache_.path()};
  Variable asanOptions_{"ASAN_OPTIONS", withoutLeakCheck()};
};

TEST_F(RenderCommand, JsonHoldsTheFixedNames) {
  const json j = figures("sample:figure1", folder_ / "a.png", {"--rig", "poly:6", "--near", "2", "--against", "cpu"});
  for (const char* name : {"rms", "max", "p99", "frame_ms", "load_ms", "first_frame_ms"}) {
    ASSERT_TRUE(j.contains(name)) << name;
    EXPECT_GT(j[name].get<double>(), 0) << name;
  }
  EXPECT_LE(j["rms"], j["max"]);
  EXPECT_LE(j["p99"], j["max"]);
  EXPECT_LE(j["max"].get<double>(), 2e-3);
  EXPECT_THAT(j["effects"].get<std::vector<std::string>>(),
              ElementsAre("light.sphere", "light.near.sphere", "rig.poly"));
  EXPECT_THAT(j["stages"], Contains(json(j["stages"]["project"])));
  EXPECT_TRUE(j["stages"].contains("choose"));
  ASSERT_EQ(j["frames"].size(), 1u);
  EXPECT_EQ(j["frames"][0]["rigs"][0]["sh_vectors"], 6);
  EXPECT_EQ(j["frames"][0]["rigs"][0]["near_lights"], 2);
  EXPECT_THAT(j["notes"], IsEmpty());
}

TEST_F(RenderCommand, TruthIsFurtherAwayThanTheCpuPath) {
  const auto rms = [&](const char* reference) {
    return figures("sample:figure1", folder_ / "a.png", {"--rig", "poly:6", "--against", reference})["rms"]
        .get<double>();
  };
  const double cpu = rms("cpu"), truth = rms("truth");
  EXPECT_LT(cpu, 1e-4);
  EXPECT_GT(truth, 1e-2);
  EXPECT_LT(truth, 1);
}

TEST_F(RenderCommand, WritesNumberedFramesAndEitherFormat) {
  figures("sample:touch", folder_ / "walk.exr", {"--rig", "constant", "--frames", "8:12:2"});
  EXPECT_THAT(files(), ElementsAre("walk-0008.exr", "walk-0010.exr", "walk-0012.exr"));
  EXPECT_THAT(contentOf(folder_ / "walk-0008.exr"), StartsWith("\x76\x2f\x31\x01"));
  const json j = figures("sample:touch", folder_ / "still.png", {"--rig", "constant", "--frames", "9"});
  EXPECT_THAT(contentOf(folder_ / "still.png"), StartsWith("\x89PNG"));
  EXPECT_EQ(j["frames"][0]["file"], (folder_ / "still.png").string());
  EXPECT_FALSE(j.contains("rms")) << "nothing was compared";
}

TEST_F(RenderCommand, SaysWhatItDrewWith) {
  const Outcome outcome = render("sample:figure1", folder_ / "a.png", {"--rig", "gradient", "--per-vertex"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("effects: light.sphere, rig.tensor\n"));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(RenderCommand, BadUseIsOneLine) {
  const std::string out = folder_ / "a.png";
  expectRefused("sample:figure1", out, {"--size", "0x90"}, 2, "--size 0x90: expected WIDTHxHEIGHT");
  expectRefused("sample:figure1", out, {"--size", "99999x90"}, 2, "WIDTHxHEIGHT, each from 1 to 8192");
  expectRefused("sample:figure1", folder_ / "a.jpg", {}, 2, ".exr or .png");
  expectRefused("sample:figure1", out, {"--rig", "poly:0"}, 2, "poly:0");
  for (const std::string rig : {"rbf:6", "latticegrad:2x1x1", "hermite:2x1x1"})
    expectRefused("sample:figure1", out, {"--rig", rig}, 2,
                  "rig '" + rig + "': this model is for comparison on the CPU alone");
  expectRefused("sample:figure1", out, {"--storage", "float64"}, 2, "--storage");
  expectRefused("sample:figure1", out, {"--supersampling", "5"}, 2, "--supersampling");
  expectRefused("sample:figure1", out, {"--clip", "all"}, 2, "one clip at a time");
}

TEST_F(RenderCommand, BadInputIsOneLine) {
  const std::string out = folder_ / "a.png";
  expectRefused("nowhere.glb", out, {}, 1, "nowhere.glb");
  expectRefused("sample:figure1", out, {"--object", "dragon"}, 1,
                "sample:figure1: no object 'dragon' that moves; there are car");
  expectRefused("sample:figure1", folder_ / "nowhere" / "a.png", {}, 1, "nowhere");
}

TEST_F(RenderCommand, WithoutADeviceItSaysWhatToInstall) {
  const Variable drivers("VK_DRIVER_FILES", "/dev/null"), old("VK_ICD_FILENAMES", "/dev/null");
  expectRefused("sample:figure1", folder_ / "a.png", {}, 1, "mesa-vulkan-drivers");
}

TEST_F(RenderCommand, ADeviceThatIsNotThereIsNamed) {
  const Variable device("RIGEL_VULKAN_DEVICE", "abacus");
  expectRefused("sample:figure1", folder_ / "a.png", {}, 1, "abacus");
}

TEST_F(RenderCommand, KeepsCompiledPipelinesForTheUser) {
  const std::filesystem::path kept = cache_ / "rigel" / "pipelines";
  const std::vector<std::string> cheap{"--rig", "constant"};
  figures("sample:figure1", folder_ / "a.png", {"--rig", "constant", "--no-shader-cache"});
  EXPECT_FALSE(std::filesystem::exists(kept));
  EXPECT_FALSE(std::filesystem::exists(cache_ / "rigel" / "shaders"));
  figures("sample:figure1", folder_ / "a.png", cheap);
  ASSERT_TRUE(std::filesystem::exists(kept));
  EXPECT_TRUE(std::filesystem::exists(cache_ / "rigel" / "shaders"));
  EXPECT_THAT(figures("sample:figure1", folder_ / "a.png", cheap)["notes"], IsEmpty());

  writeFile(kept, std::string(100, 'x'));
  const json damaged = figures("sample:figure1", folder_ / "a.png", cheap);
  ASSERT_EQ(damaged["notes"].size(), 1u);
  EXPECT_THAT(damaged["notes"][0].get<std::string>(), HasSubstr("is ignored"));
  EXPECT_THAT(figures("sample:figure1", folder_ / "a.png", cheap)["notes"], IsEmpty()) << "it was replaced";
}

TEST_F(RenderCommand, DoesWithoutAFolderForThem) {
  writeFile(cache_ / "rigel", "a file where the folder should be");
  figures("sample:figure1", folder_ / "a.png", {"--rig", "constant"});
  EXPECT_THAT(files(), ElementsAre("a.png"));
}

}  // namespace
}  // namespace rigel::test
