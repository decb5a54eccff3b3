// What a run is asked to do: the parser of --frames, and values that no run can serve.
#include "report/run_options.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.rigs.clear(); }), "--rig: names no rig");
  EXPECT_EQ(messageOf([&](RunOptions& o) { o.frames.step = 0; }), "--frames: the range is empty");
}

}  // namespace
}  // namespace rigel::tests
