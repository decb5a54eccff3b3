// Which frames a run looks at, and which of them follow on each other.
#include "report/run/timeline.h"

#include "scene/pose.h"

#include <gmock/gmock.h>

#include <limits>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

constexpr int kMostInt = std::numeric_limits<int>::max();

Scene sceneOf(std::initializer_list<double> durations) {
  Scene scene;
  scene.name = "made up";
  for (const double duration : durations) {
    const char name = static_cast<char>('a' + scene.animations.size());
    scene.animations.push_back({std::string(1, name), {}, duration});
  }
  return scene;
}

RunOptions optionsOf(const std::string& frames, std::string clip = "") {
  RunOptions options;
  const auto range = parseFrameRange(frames);
  EXPECT_TRUE(range) << frames;
  if (range) options.frames = *range;
  options.clip = std::move(clip);
  return options;
}

/// The only timeline; fails the test where there is none.
Timeline timelineOf(double duration, const std::string& frames, double lightDuration = 0) {
  const auto timelines = makeTimelines(sceneOf({duration}), optionsOf(frames), lightDuration);
  EXPECT_TRUE(timelines) << (timelines ? "" : timelines.error().line());
  return timelines && timelines->all.size() == 1 ? timelines->all[0] : Timeline{};
}

std::string errorOf(double duration, const std::string& frames) {
  const auto timelines = makeTimelines(sceneOf({duration}), optionsOf(frames), 0);
  EXPECT_FALSE(timelines);
  return timelines ? "" : timelines.error().line();
}

std::vector<std::size_t> followers(const Timeline& timeline) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < timeline.frames.size(); ++i)
    if (timeline.followsOn(i)) indices.push_back(i);
  return indices;
}

TEST(Timeline, TakesTheFramesOfTheRange) {
  EXPECT_THAT(timelineOf(0.2, "0:").frames, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(timelineOf(0.2, "1:4:2").frames, testing::ElementsAre(1, 3));
  EXPECT_THAT(timelineOf(0.2, "2:99:3").frames, testing::ElementsAre(2, 5));
  EXPECT_THAT(timelineOf(0, "0:").frames, testing::ElementsAre(0));
  EXPECT_THAT(timelineOf(25.0f / 30, "24:").frames, testing::ElementsAre(24, 25));  // 0.8333333 s rounds down
}

TEST(Timeline, FramesCountAtTheRate) {
  for (const double rate : {1.0, 24.0, 60.0, 480.0, 1000.0}) {
    RunOptions options = optionsOf("0:");
    options.rate = rate;
    const auto timelines = makeTimelines(sceneOf({2}), options, 0);
    ASSERT_TRUE(timelines) << rate;
    const Timeline& timeline = timelines->all.at(0);
    EXPECT_EQ(static_cast<double>(timeline.frames.size()), 2 * rate + 1);
    EXPECT_DOUBLE_EQ(timeline.time(timeline.frames.back()), 2);
    EXPECT_EQ(followers(timeline).size(), timeline.frames.size() - 1);
  }
}

TEST(Timeline, HugeStepsAndEndsDoNotOverflow) {
  EXPECT_THAT(timelineOf(1, "1:5:2147483647").frames, testing::ElementsAre(1));
  EXPECT_THAT(timelineOf(1, "0::2147483647").frames, testing::ElementsAre(0));
  EXPECT_THAT(timelineOf(1e12, "2147483646:2147483647").frames, testing::ElementsAre(kMostInt - 1, kMostInt));
  EXPECT_THAT(timelineOf(1e12, "5:2147483647:2147483640").frames, testing::ElementsAre(5, kMostInt - 2));
}

TEST(Timeline, RefusesMoreFramesThanAReportHolds) {
  const std::string days =
      "made up: clip 'a': lasts 2.592e+06 s, which at 30 frames a second is more than the 100000 "
      "frames of a report (choose some: --frames 0:1000)";
  EXPECT_EQ(errorOf(30 * 86400.0, "0:"), days);
  for (const double duration : {1e12, 3.4e38, static_cast<double>(std::numeric_limits<float>::max())})
    EXPECT_THAT(errorOf(duration, "0:"), testing::HasSubstr("more than the 100000 frames")) << duration;
  EXPECT_THAT(errorOf(1e12, "0::2147483647"), testing::HasSubstr("--frames"));  // no int holds the last
  EXPECT_EQ(timelineOf(30 * 86400.0, "0:99999").frames.size(), static_cast<std::size_t>(kMaxFrames));
  EXPECT_THAT(errorOf(30 * 86400.0, "0:100000"), testing::HasSubstr("more than the 100000 frames"));
  EXPECT_EQ(timelineOf(30 * 86400.0, "0::1000").frames.size(), 77761u);
  EXPECT_EQ(timelineOf(1e12, "0:1000").frames.size(), 1001u);
}

TEST(Timeline, ShortClipsAreLeftOutWithANote) {
  const Scene scene = sceneOf({0.1, 1, 0.2});
  const auto timelines = makeTimelines(scene, optionsOf("10:", "all"), 0);
  ASSERT_TRUE(timelines) << timelines.error().line();
  ASSERT_EQ(timelines->all.size(), 1u);
  EXPECT_EQ(timelines->all[0].clipName, "b");
  EXPECT_EQ(timelines->all[0].frames.size(), 21u);
  EXPECT_THAT(timelines->notes, testing::ElementsAre("clip 'a' is left out: frame 10 is past the end (the last is 3)",
                                                     "clip 'c' is left out: frame 10 is past the end (the last is 6)"));
  const auto none = makeTimelines(scene, optionsOf("31:", "all"), 0);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().line(), "made up: clip 'a': frame 31 is past the end (the last is 3)");
  EXPECT_EQ(errorOf(1, "2147483647"), "made up: clip 'a': frame 2147483647 is past the end (the last is 30)");
}

TEST(Timeline, OnlyNeighboursFollowOn) {
  EXPECT_THAT(followers(timelineOf(0.1, "0:")), testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(followers(timelineOf(1, "0::2")), testing::IsEmpty());
  EXPECT_THAT(followers(timelineOf(1, "7")), testing::IsEmpty());
}

TEST(Timeline, NothingFollowsOnAcrossTheStartOfALoop) {
  // The object's clip lasts 3 frames under 9 frames of lights: frames 3, 6 and 9 are its end, 4 and 7 one frame after
  // its start.
  const Timeline shortClip = timelineOf(0.1, "0:", 0.3);
  ASSERT_EQ(shortClip.frames.size(), 10u);
  EXPECT_THAT(followers(shortClip), testing::ElementsAre(1, 2, 3, 5, 6, 8, 9));
  EXPECT_NEAR(shortClip.clipTime(3), 0.1, 1e-12);
  EXPECT_NEAR(shortClip.clipTime(4), 1 / 30.0, 1e-12);
  EXPECT_NEAR(shortClip.clipTime(6), 0.1, 1e-12);
  // The other way round.
  EXPECT_THAT(followers(timelineOf(0.3, "0:", 0.1)), testing::ElementsAre(1, 2, 3, 5, 6, 8, 9));
}

TEST(Timeline, EveryJumpBackOfAClockIsNoticed) {
  std::size_t seams = 0;
  for (const double loop : {0.1, 0.25, 1 / 3.0, 0.7, 25.0 / 30, 1.0}) {
    const Timeline timeline = timelineOf(40, "0:", loop);
    for (std::size_t i = 1; i < timeline.frames.size(); ++i) {
      const double step = timeline.lightTime(timeline.frames[i]) - timeline.lightTime(timeline.frames[i - 1]);
      ASSERT_EQ(timeline.followsOn(i), step > 0) << loop << " s, frame " << i;
      if (timeline.followsOn(i)) {
        ASSERT_NEAR(step, 1 / 30.0, 1e-4) << loop << " s, frame " << i;
      } else {
        ++seams;
      }
    }
  }
  EXPECT_GT(seams, 600u);
}

}  // namespace
}  // namespace rigel::tests
