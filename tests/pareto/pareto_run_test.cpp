// Small studies end to end: figures are those that a report gives.
#include "pareto/pareto_run.h"

#include "report/run/scene_run.h"

#include <gmock/gmock.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

ParetoOptions quickStudy(const std::string& scene, const std::string& frames, const std::string& rigs) {
  ParetoOptions options;
  options.run.scenes = {scene};
  options.run.frames = *parseFrameRange(frames);
  options.run.samples = 256;
  options.allFrames = true;
  options.rigs = *parseRigSpecs(rigs);
  options.bands = {3};
  return options;
}

Result<Pareto> study(const ParetoOptions& options) {
  return runPareto(options, [](double, const std::string&) {});
}

TEST(ParetoRun, ErrorsAreThoseOfTheReport) {
  ParetoOptions options = quickStudy("sample:touch", "10:40:15", "poly:6;mixed:l3,g,c;auto");
  const auto pareto = study(options);
  ASSERT_TRUE(pareto) << pareto.error().line();
  const ParetoObject& object = pareto->objects.at(0);
  int compared = 0;
  for (const char* near : {"0", "2", "auto"}) {
    RunOptions run = options.run;
    run.rigs = options.rigs;
    run.images = false;
    run.near = *parseNear(near);
    run.target = kDefaultTarget;
    if (!run.near->automatic) run.rigs.pop_back();
    if (!run.near->automatic) run.target.reset();
    const auto report = runReport(run, {}, [](double, const std::string&) {});
    ASSERT_TRUE(report) << report.error().line();
    for (const RigReport& rig : report->scenes.at(0).objects.at(0).rigs)
      for (const ParetoPoint& point : object.points) {
        const std::string target = run.target ? "--error 0.05" : "";
        if (point.spec != rig.spec || point.near != near || point.target != target || point.half) continue;
        if (point.form != NearForm::exact) continue;
        // The report fits with estimates on; sums are taken in another order.
        EXPECT_NEAR(point.spatial.rms, rig.spatial.rms, 1e-5 * rig.spatial.rms + 1e-7) << point.arguments;
        EXPECT_NEAR(point.total.rms, rig.total.rms, 1e-5 * rig.total.rms + 1e-7) << point.arguments;
        EXPECT_NEAR(point.total.max, rig.total.max, 1e-4 * rig.total.max) << point.arguments;
        EXPECT_EQ(point.nearLights, rig.nearLights) << point.arguments;
        EXPECT_EQ(point.shVectors, rig.shVectors) << point.arguments;
        EXPECT_EQ(point.bytes, rig.bytes) << point.arguments;
        ++compared;
      }
  }
  EXPECT_EQ(compared, 7);
}

TEST(ParetoRun, HalfFloatsAndFormsChangeWhatTheyShould) {
  const auto pareto = study(quickStudy("sample:touch", "10:40:15", "poly:6"));
  ASSERT_TRUE(pareto) << pareto.error().line();
  const ParetoObject& object = pareto->objects.at(0);
  const auto find = [&](const char* near, NearForm form, bool half) -> const ParetoPoint& {
    for (const ParetoPoint& point : object.points)
      if (point.near == near && point.form == form && point.half == half) return point;
    throw std::runtime_error("no such point");
  };
  const ParetoPoint& whole = find("2", NearForm::exact, false);
  const ParetoPoint& half = find("2", NearForm::exact, true);
  EXPECT_EQ(2 * half.bytes, whole.bytes);
  EXPECT_NE(half.total.rms, whole.total.rms);
  EXPECT_NEAR(half.total.rms, whole.total.rms, 1e-3 * whole.total.rms);
  EXPECT_FALSE(half.shadeNanoseconds);
  EXPECT_TRUE(whole.shadeNanoseconds);
  const ParetoPoint& cheap = find("2", NearForm::cheap, false);
  EXPECT_EQ(cheap.spatial.rms, whole.spatial.rms);  // the rig is the same
  EXPECT_NE(cheap.total.rms, whole.total.rms);
  EXPECT_NEAR(cheap.total.rms, whole.total.rms, 0.3 * whole.total.rms);
  const ParetoPoint& corrector = find("2", NearForm::corrector, false);
  const ParetoPoint& far = find("0", NearForm::exact, false);
  EXPECT_EQ(corrector.spatial.rms, far.spatial.rms);  // all light is in the rig
  EXPECT_NE(corrector.total.rms, far.total.rms);
}

TEST(ParetoRun, EveryPointIsTimed) {
  const auto pareto = study(quickStudy("sample:figure1", "0", "constant;poly:6"));
  ASSERT_TRUE(pareto) << pareto.error().line();
  ASSERT_FALSE(pareto->objects.at(0).points.empty());
  for (const ParetoPoint& point : pareto->objects[0].points) {
    ASSERT_TRUE(point.fitMicroseconds) << point.arguments;
    EXPECT_GT(*point.fitMicroseconds, 0) << point.arguments;
    if (!point.half) {
      ASSERT_TRUE(point.shadeNanoseconds) << point.arguments;
      EXPECT_GT(*point.shadeNanoseconds, 0) << point.arguments;
    }
    EXPECT_FALSE(point.gpuNanoseconds);
    EXPECT_EQ(point.frameUncertainty, 0) << "one frame says nothing of others";
  }
}

TEST(ParetoRun, SpreadsItsFramesOverTheClip) {
  ParetoOptions options = quickStudy("sample:street", "0:", "constant");
  options.allFrames = false;
  options.run.samples = 32;
  const auto pareto = study(options);
  ASSERT_TRUE(pareto) << pareto.error().line();
  ASSERT_EQ(pareto->frames.size(), kParetoFrames);
  EXPECT_EQ(pareto->frames.front(), 0);
  for (std::size_t i = 1; i < pareto->frames.size(); ++i) EXPECT_GT(pareto->frames[i], pareto->frames[i - 1]);
  for (const int frame : pareto->timed) EXPECT_THAT(pareto->frames, testing::Contains(frame));
  for (const ParetoPoint& point : pareto->objects.at(0).points) EXPECT_GT(point.frameUncertainty, 0);
}

TEST(ParetoRun, SaysWhatCannotBeUsed) {
  const auto missing = study(quickStudy("no-such-file.gltf", "0", "constant"));
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().line(), testing::HasSubstr("no-such-file.gltf"));
}

}  // namespace
}  // namespace rigel::tests
