// Whole runs without pictures: what is compared with what, and what the notes say.
#include "whole_run.h"

#include <gmock/gmock.h>

#include <cmath>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

const ObjectReport& firstObject(const Result<Report>& report) { return report->scenes.at(0).objects.at(0); }

TEST(SceneRun, OnlyNeighbouringFramesMakeAJump) {
  const auto all = run(quickRun("sample:street", "10:16"));
  ASSERT_TRUE(all) << all.error().line();
  for (const RigReport& rig : firstObject(all).rigs) {
    ASSERT_TRUE(rig.maxJump) << rig.spec;
    EXPECT_GT(*rig.maxJump, 0) << rig.spec;
  }
  const std::vector<TruthFrame>& truth = firstObject(all).truth;
  ASSERT_EQ(truth.size(), 7u);
  EXPECT_FALSE(truth[0].movement);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    ASSERT_TRUE(truth[i].movement) << i;
    EXPECT_GT(*truth[i].movement, 0) << i;
  }
  for (const char* frames : {"10:16:2", "12"}) {
    const auto some = run(quickRun("sample:street", frames));
    ASSERT_TRUE(some) << some.error().line();
    for (const RigReport& rig : firstObject(some).rigs) EXPECT_FALSE(rig.maxJump) << frames << rig.spec;
    for (const TruthFrame& frame : firstObject(some).truth) EXPECT_FALSE(frame.movement) << frames;
  }
}

TEST(SceneRun, TheSeamOfALoopIsNoJump) {
  // The street's car under the lights of `stage`, with the car's clip cut to a fifth of a second, so that it leaps back
  // again and again while the lights go on.
  auto street = loadScene("sample:street");
  ASSERT_TRUE(street);
  constexpr double kCut = 0.2;
  for (Channel& channel : street->animations.at(0).channels) {
    for (float& time : channel.times) time *= static_cast<float>(kCut / street->animations[0].duration);
  }
  street->animations[0].duration = kCut;
  const SavedScene saved(*street);
  RunOptions options = quickRun(saved.file, "0:13");
  options.lights = "sample:stage";
  const auto report = run(options);
  ASSERT_TRUE(report) << report.error().line();
  const std::vector<TruthFrame>& truth = firstObject(report).truth;
  ASSERT_EQ(truth.size(), 14u);
  std::vector<std::size_t> without;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!truth[i].movement) without.push_back(i);
  // Frames 6 and 12 are the clip's end, 7 and 13 one frame after its start.
  EXPECT_THAT(without, testing::ElementsAre(0, 7, 13));
}

TEST(SceneRun, NotesSayWhatTheOptionsLeaveOut) {
  RunOptions options = quickRun("sample:street", "0");
  options.lights = "sample:stage";
  const auto borrowed = run(options);
  ASSERT_TRUE(borrowed) << borrowed.error().line();
  EXPECT_THAT(borrowed->scenes.at(0).notes,
              testing::Contains(testing::MatchesRegex("its own [0-9]+ lights are left out: --lights sample:stage")));
  const auto own = run(quickRun("sample:street", "0"));
  ASSERT_TRUE(own);
  EXPECT_THAT(own->scenes.at(0).notes, testing::Not(testing::Contains(testing::HasSubstr("left out: --lights"))));

  auto street = loadScene("sample:street");
  ASSERT_TRUE(street);
  street->animations.push_back(street->animations.at(0));
  Animation& brief = street->animations.back();
  brief.name = "brief";
  for (Channel& channel : brief.channels)
    for (float& time : channel.times) time /= 100;
  const SavedScene saved(*street);
  options = quickRun(saved.file, "10:11");
  options.clip = "all";
  const auto report = run(options);
  ASSERT_TRUE(report) << report.error().line();
  ASSERT_EQ(report->scenes.size(), 1u);
  EXPECT_THAT(report->scenes[0].notes, testing::Contains(testing::StartsWith("clip 'brief' is left out: frame 10")));
}

TEST(SceneRun, RefusesWhatNoRunCanServe) {
  RunOptions options = quickRun("sample:street", "0");
  options.wrap = std::nanf("");
  const auto wrap = run(options);
  ASSERT_FALSE(wrap);
  EXPECT_EQ(wrap.error().line(), "--wrap nan: must lie in [-0.25, 1]");

  auto street = loadScene("sample:street");
  ASSERT_TRUE(street);
  street->lights.at(0) = {"sun", DirectionalLight{{0, 0, -1}, {1e35f, 0, 0}}};
  const SavedScene saved(*street);
  options = quickRun(saved.file, "0");
  options.exposure = 1e4f;
  const auto sun = run(options);
  ASSERT_FALSE(sun);
  EXPECT_EQ(sun.error().line(), saved.file + ": light 'sun': --exposure 10000 makes it brighter than a float holds");
}

}  // namespace
}  // namespace rigel::tests
