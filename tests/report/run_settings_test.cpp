// Settings of a captured run: what is written reads the same, whatever is wrong is named with its place.
#include "report/run/run_settings.h"

#include <gmock/gmock.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

TEST(RunSettings, WrittenAndReadAgain) {
  RunOptions options;
  options.rigs = *parseRigSpecs("constant;mixed:l3,g,c");
  options.clip = "walk \"fast\"";
  options.frames = *parseFrameRange("3:9:2");
  options.rate = 48;
  options.near = NearChoice{true, 0};
  options.target = LightingTarget{LightingTarget::Kind::totalError, 0.03f};
  options.budget = 1500.0f;
  options.wrap = 0.3f;
  options.bands = 4;
  options.exposure = 2.5f;
  options.loops = {0.5, 1.25};
  const auto read = parseRunSettings(runSettingsText(options));
  ASSERT_TRUE(read) << read.error().line();
  EXPECT_EQ(read->rigs, "constant;mixed:l3,g,c");
  EXPECT_EQ(read->clip, options.clip);
  EXPECT_EQ(read->frames, "3:9:2");
  EXPECT_EQ(read->rate, 48);
  EXPECT_EQ(read->near, "auto");
  EXPECT_FALSE(read->error);
  EXPECT_EQ(read->totalError, 0.03f);
  EXPECT_EQ(read->budget, 1500.0f);
  EXPECT_EQ(read->wrap, 0.3f);
  EXPECT_EQ(read->bands, 4);
  EXPECT_EQ(read->exposure, 2.5f);
  EXPECT_THAT(read->loops, testing::ElementsAre(0.5, 1.25));
  EXPECT_TRUE(read->notes.empty());
}

TEST(RunSettings, WhatIsLeftOutStaysEmpty) {
  const auto read = parseRunSettings("{}");
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->rigs || read->clip || read->frames || read->near || read->rate || read->bands);
}

TEST(RunSettings, UnknownNamesAreNoted) {
  const auto read = parseRunSettings(R"({"near":3,"colour":"red","ra\nte":1})");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->near, "3");
  EXPECT_THAT(read->notes,
              testing::UnorderedElementsAre("/extras/rigel/settings: \"colour\" is not known and left out",
                                            "/extras/rigel/settings: \"ra?te\" is not known and left out"));
}

TEST(RunSettings, WrongOnesNameTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"[1]", "/extras/rigel/settings: must be an object"},
      {"not JSON", "/extras/rigel/settings: must be an object"},
      {R"({"rigs":"spline:3"})", "/extras/rigel/settings/rigs: spline:3: unknown rig model"},
      {R"({"rigs":7})", "/extras/rigel/settings/rigs: must be a string"},
      {R"({"frames":"5:2"})", "/extras/rigel/settings/frames: 5:2: the range is empty"},
      {R"({"bands":9})", "/extras/rigel/settings/bands: must be 2 to 5"},
      {R"({"bands":-1})", "/extras/rigel/settings/bands: must be a whole number"},
      {R"({"rate":0})", "/extras/rigel/settings/rate: must be 1 to 1000, is 0"},
      {R"({"near":99})", "/extras/rigel/settings/near: expected auto, or a number of lights"},
      {R"({"exposure":1e300})", "/extras/rigel/settings/exposure: 1e+300 does not fit a float"},
      {R"({"exposure":0})", "/extras/rigel/settings/exposure: must be more than 0"},
      {R"({"wrap":2})", "/extras/rigel/settings/wrap: must be"},
      {R"({"error":0.1,"total_error":0.1})", "only one can be aimed at"},
      {R"({"loops":[1,0]})", "/extras/rigel/settings/loops/1: must be more than 0 s"},
      {R"({"loops":[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]})", "/extras/rigel/settings/loops: has more than 16"},
  };
  for (const auto& [text, expected] : cases) {
    const auto read = parseRunSettings(text);
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().line(), testing::HasSubstr(expected)) << text;
  }
}

}  // namespace
}  // namespace rigel::tests
