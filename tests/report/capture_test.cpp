// A captured run gives the errors of the run: to the last bit under the scene's own lights, and under borrowed ones but
// for what rounding key times and directions to float costs.
#include "report/run/capture.h"

#include "report/run/run_settings.h"
#include "whole_run.h"

#include <array>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

/// Of any figure below. Measured: 2.4e-6 (directions of spot lights come back out of a quaternion, key times are
/// floats).
constexpr double kWorst = 2e-5;

RunOptions replayOf(const std::string& file) {
  RunOptions options;
  const auto scene = loadGltf(file);
  EXPECT_TRUE(scene) << scene.error().line();
  const auto settings = parseRunSettings(scene->settings);
  EXPECT_TRUE(settings) << settings.error().line();
  options.scenes = {file};
  options.rigs = *parseRigSpecs(settings->rigs.value());
  options.clip = settings->clip.value_or("");
  options.frames = *parseFrameRange(settings->frames.value());
  options.rate = settings->rate.value();
  options.exposure = settings->exposure.value();
  options.loops = settings->loops;
  options.images = false;
  options.samples = 64;
  return options;
}

/// The largest relative difference of a figure between two runs. Objects, rigs and frames must be the same.
double worstDifference(const Report& a, const Report& b) {
  double worst = 0;
  const auto compare = [&](double x, double y) { worst = std::max(worst, std::abs(x - y) / std::max(x, 1e-3)); };
  EXPECT_EQ(a.scenes.size(), 1u);
  EXPECT_EQ(b.scenes.size(), 1u);
  const auto &from = a.scenes[0].objects, &to = b.scenes[0].objects;
  EXPECT_EQ(from.size(), to.size());
  for (std::size_t o = 0; o < std::min(from.size(), to.size()); ++o) {
    EXPECT_EQ(from[o].name, to[o].name);
    EXPECT_EQ(from[o].rigs.size(), to[o].rigs.size());
    for (std::size_t r = 0; r < std::min(from[o].rigs.size(), to[o].rigs.size()); ++r) {
      const auto &x = from[o].rigs[r], &y = to[o].rigs[r];
      EXPECT_EQ(x.frames.size(), y.frames.size());
      compare(x.spatial.rms, y.spatial.rms);
      compare(x.total.rms, y.total.rms);
      compare(x.total.max, y.total.max);
      EXPECT_EQ(x.maxJump.has_value(), y.maxJump.has_value());
      compare(x.maxJump.value_or(0), y.maxJump.value_or(0));
    }
  }
  EXPECT_EQ(a.scenes[0].lights.size(), b.scenes[0].lights.size());
  for (std::size_t i = 0; i < std::min(a.scenes[0].lights.size(), b.scenes[0].lights.size()); ++i)
    EXPECT_EQ(a.scenes[0].lights[i].name, b.scenes[0].lights[i].name);
  return worst;
}

double differenceOfCapture(const RunOptions& options) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "capture.glb";
  const auto written = writeCapture(options, file);
  EXPECT_TRUE(written) << written.error().line();
  const auto first = run(options), second = run(replayOf(file));
  EXPECT_TRUE(first && second) << (first ? second.error().line() : first.error().line());
  return first && second ? worstDifference(*first, *second) : 1;
}

TEST(Capture, OwnLightsToTheLastBit) {
  RunOptions options = quickRun("sample:street", "4:10:2");
  options.exposure = 3;
  EXPECT_EQ(differenceOfCapture(options), 0);
}

// The frames go past the end of the shorter of the two, where it starts over: of the lights, then of the clip.
TEST(Capture, BorrowedLightsThatMoveForLongerOrShorter) {
  const std::array<const char*, 3> cases[] = {{"sample:touch", "sample:street", "118:123"},
                                              {"sample:stage", "sample:touch", "87:93"}};
  for (const auto& [scene, lights, frames] : cases) {
    SCOPED_TRACE(scene);
    RunOptions options = quickRun(scene, frames);
    options.lights = lights;
    options.exposure = 0.5f;
    const double worst = differenceOfCapture(options);
    EXPECT_LT(worst, kWorst);
    std::printf("[ measured ] %s by %s: figures differ by at most %.2g\n", scene, lights, worst);
  }
}

TEST(Capture, OneSceneAndOneClip) {
  RunOptions options = quickRun("sample:touch", "0");
  options.scenes.push_back("sample:street");
  const auto written = writeCapture(options, "/nowhere/a.glb");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().line(), "--capture /nowhere/a.glb: a capture holds one scene");
  options.scenes.pop_back();
  const auto lost = writeCapture(options, "/nowhere/a.glb");
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().line().rfind("/nowhere/a.glb: cannot be written", 0), 0u) << lost.error().line();
}

}  // namespace
}  // namespace rigel::tests
