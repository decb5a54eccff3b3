// What a run is asked to do: the parser of --frames, and values that no run can serve.
#include "report/run/run_options.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

RunOptions good() {
  RunOptions options;
  options.scenes = {"sample:street"};
  options.rigs = *parseRigSpecs("constant;poly:6");
  return options;
}

TEST(RunOptions, FrameRanges) {
  const auto range = parseFrameRange("3:9:2");
  ASSERT_TRUE(range);
  EXPECT_EQ(range->first, 3);
  EXPECT_EQ(range->last, 9);
  EXPECT_EQ(range->step, 2);
  for (const char* bad : {"", "a", "1:2:3:4", "-1", "5:4", "0::0", "0:1:-2", "1:99999999999", "0x3", "1 :2"})
    EXPECT_FALSE(parseFrameRange(bad)) << bad;
}

TEST(RunOptions, NearIsANumberOrAuto) {
  EXPECT_TRUE(parseNear("auto")->automatic);
  EXPECT_EQ(parseNear("0")->slots, 0);
  EXPECT_EQ(parseNear("64")->slots, kMaxNearLights);
  EXPECT_FALSE(parseNear("4")->automatic);
  for (const char* bad : {"", "-1", "65", "2.5", "Auto", "auto ", "1e1"}) {
    const auto near = parseNear(bad);
    ASSERT_FALSE(near) << bad;
    EXPECT_EQ(near.error().line(),
              std::string("--near ") + bad + ": expected auto, or a number of lights from 0 to 64");
  }
}

TEST(RunOptions, AutoRigsChooseAndOthersWhenTold) {
  using Kind = LightingTarget::Kind;
  RunOptions options = good();
  const RigSpec fixed = *parseRigSpec("poly:6"), adaptive = *parseRigSpec("auto");
  EXPECT_EQ(lightingOptions(fixed, options).target.kind, Kind::none);
  EXPECT_EQ(lightingOptions(fixed, options).nearSlots, 0);
  EXPECT_EQ(lightingOptions(adaptive, options).target.kind, Kind::spatialError);
  EXPECT_EQ(lightingOptions(adaptive, options).target.value, 0.05f);
  EXPECT_EQ(lightingOptions(adaptive, options).nearSlots, kMaxNearLights);

  options.near = NearChoice{false, 2};
  EXPECT_EQ(lightingOptions(fixed, options).target.kind, Kind::none);
  EXPECT_EQ(lightingOptions(fixed, options).nearSlots, 2);
  EXPECT_EQ(lightingOptions(adaptive, options).target.kind, Kind::spatialError);
  EXPECT_EQ(lightingOptions(adaptive, options).nearSlots, 2);

  options.near = NearChoice{false, 0};
  EXPECT_EQ(lightingOptions(adaptive, options).target.kind, Kind::spatialError);
  EXPECT_EQ(lightingOptions(adaptive, options).slots(), 0) << "none is none, not as many as it likes";

  options.near = NearChoice{true, 0};
  options.target = LightingTarget{Kind::totalError, 0.03f};
  for (const RigSpec& rig : {fixed, adaptive}) {
    EXPECT_EQ(lightingOptions(rig, options).target.kind, Kind::totalError);
    EXPECT_EQ(lightingOptions(rig, options).target.value, 0.03f);
    EXPECT_EQ(lightingOptions(rig, options).nearSlots, kMaxNearLights);
  }
}

TEST(RunOptions, ABudgetLimitsWhatIsSpentOnATarget) {
  using Kind = LightingTarget::Kind;
  RunOptions options = good();
  const RigSpec adaptive = *parseRigSpec("auto");
  options.rigs.push_back(adaptive);
  options.budget = 1500;
  EXPECT_FALSE(checkOptions(options));
  EXPECT_EQ(lightingOptions(adaptive, options).target.kind, Kind::totalError) << "what is seen";
  EXPECT_EQ(lightingOptions(adaptive, options).target.value, 0.02f);
  EXPECT_EQ(choiceOptions(adaptive, options), "--near auto --budget-us 1500");
  EXPECT_EQ(choiceOptions(options.rigs[0], options), "");
  options.target = LightingTarget{Kind::spatialError, 0.1f};
  EXPECT_FALSE(checkOptions(options));
  EXPECT_EQ(lightingOptions(adaptive, options).target.kind, Kind::spatialError);
  EXPECT_EQ(lightingOptions(adaptive, options).target.value, 0.1f);
  EXPECT_EQ(choiceOptions(adaptive, options), "--near auto --error 0.1 --budget-us 1500");
}

TEST(RunOptions, GoodOnesPass) {
  RunOptions options = good();
  EXPECT_FALSE(checkOptions(options));
  options.exposure = kMaxExposure;
  options.wrap = -0.25f;
  EXPECT_FALSE(checkOptions(options));
}

TEST(RunOptions, ValuesNoRunCanServeAreNamed) {
  const auto messageOf = [](auto damage) {
    RunOptions options = good();
    damage(options);
    const auto error = checkOptions(options);
    EXPECT_TRUE(error);
    return error ? error->line() : "";
  };
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.wrap = nan; }), "--wrap nan: must lie in [-0.25, 1]");
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.wrap = 1.5f; }), "--wrap 1.5: must lie in [-0.25, 1]");
  const std::string range = ": must be more than 0 and at most 1e+06";
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.exposure = nan; }), "--exposure nan" + range);
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.exposure = infinity; }), "--exposure inf" + range);
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.exposure = 1e38f; }), "--exposure 1e+38" + range);
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.exposure = 0; }), "--exposure 0" + range);
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.exposure = -1; }), "--exposure -1" + range);
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.bands = 6; }), "--bands 6: must be 2 to 5");
  for (const double rate : {0.5, 1001.0, -30.0, 0.0, static_cast<double>(nan)})
    EXPECT_THAT(messageOf([&](RunOptions& o) { o.rate = rate; }),
                testing::EndsWith(": must be 1 to 1000 frames a second"));
  using Kind = LightingTarget::Kind;
  const auto aimingAt = [&](Kind kind, float value, const char* rigs) {
    return messageOf([&](RunOptions& o) {
      o.target = LightingTarget{kind, value};
      o.rigs = *parseRigSpecs(rigs);
    });
  };
  EXPECT_EQ(aimingAt(Kind::spatialError, 0.05f, "constant;poly:6"),
            "--error 0.05: no rig here chooses anything: that takes an `auto` rig or --near auto");
  EXPECT_EQ(aimingAt(Kind::totalError, 5, "auto"),
            "--total-error 5: must be more than 0 and at most 1 (0.05 is 5 % of the mean light)");
  EXPECT_THAT(aimingAt(Kind::spatialError, nan, "auto"), testing::StartsWith("--error nan: must be more than 0"));
  const auto within = [&](float budget, const char* rigs) {
    return messageOf([&](RunOptions& o) {
      o.budget = budget;
      o.rigs = *parseRigSpecs(rigs);
    });
  };
  EXPECT_EQ(within(0, "auto"), "--budget-us 0: must be more than 0 and at most 1000000 microseconds");
  EXPECT_THAT(within(nan, "auto"), testing::StartsWith("--budget-us nan: must be more than 0"));
  EXPECT_EQ(within(100, "poly:6"),
            "--budget-us 100: no rig here chooses anything: that takes an `auto` rig or --near auto");
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.rigs.clear(); }), "--rig: names no rig");
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.frames.step = 0; }), "--frames: the range is empty");
}

}  // namespace
}  // namespace rigel::tests
