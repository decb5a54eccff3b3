// What is said of each light, and how much of its course is kept.
#include "report/measure/light_log.h"

#include <gmock/gmock.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using Kind = LightingTarget::Kind;

LightVerdict far(float bound, float share = 0.1f) { return {LightRole::inRig, 0, bound, share}; }
LightVerdict blended(float weight) { return {LightRole::blended, weight, 3, 0.1f}; }
LightVerdict near() { return {LightRole::exact, 1, 6, 0.1f}; }
LightVerdict culled() { return {LightRole::culled, 0, 0, 0}; }

/// One light through the frames 10, 11, ...; bounds are over a mean of 2 W/m2.
LightReport useOf(const std::vector<LightVerdict>& verdicts, const LightingOptions& asked = {},
                  std::optional<float> budget = {}) {
  LightLog log;
  std::vector<int> frames;
  for (const LightVerdict& verdict : verdicts) {
    log.add({&verdict, 1});
    frames.push_back(10 + static_cast<int>(frames.size()));
  }
  const std::vector<LightRow> lights{{"lamp", "sphere", ""}};
  return log.uses({lights, frames, 2, asked, budget}).at(0);
}

LightingOptions aimingAt(Kind kind, float value) {
  LightingOptions asked;
  asked.target = {kind, value};
  asked.nearSlots = kMaxNearLights;
  return asked;
}

TEST(LightLog, CountsFramesAndPoolsBoundAndShare) {
  const LightReport use = useOf({culled(), far(1, 0.2f), blended(0.25f), near(), near()});
  EXPECT_EQ(use.name, "lamp");
  EXPECT_EQ(use.type, "sphere");
  EXPECT_EQ(use.framesOf(LightRole::culled), 1);
  EXPECT_EQ(use.framesOf(LightRole::inRig), 1);
  EXPECT_EQ(use.framesOf(LightRole::blended), 1);
  EXPECT_EQ(use.framesOf(LightRole::exact), 2);
  EXPECT_DOUBLE_EQ(use.bound, 3);
  EXPECT_NEAR(use.share, (0 + 0.2 + 3 * 0.1) / 5, 1e-7);
  EXPECT_THAT(use.weights, testing::ElementsAre(0, 0, 0.25f, 1, 1));
  EXPECT_THAT(use.bounds, testing::ElementsAre(0, 0.5f, 1.5f, 3, 3));
}

TEST(LightLog, SaysWhy) {
  LightingOptions two;
  two.nearSlots = 2;
  const LightingOptions target = aimingAt(Kind::spatialError, 0.05f);
  EXPECT_EQ(useOf({near(), near()}, two).why,
            "near in all frames: in the rig it could be wrong by 300 % of the mean light (2 near lights at most)");
  EXPECT_EQ(useOf({far(1), blended(0.5f), near(), near(), blended(0.1f)}, target).why,
            "near in frames 12-13: in the rig it could be wrong by 300 % of the mean light (target 5.00 %); partly in "
            "frames 11, 14");
  EXPECT_EQ(useOf({far(1), blended(0.5f), culled()}, target, 200).why,
            "partly near in frame 11: in the rig it could be wrong by 150 % of the mean light (200 us a frame for "
            "all objects); gives nothing in frame 12");
  EXPECT_EQ(useOf({near(), far(1), near(), far(1), near(), near(), far(100)}, target).why,
            "near in frames 10, 12 and 1 more stretch: in the rig it could be wrong by 50 times the mean light (target "
            "5.00 %)");
  EXPECT_EQ(useOf({culled(), culled()}).why,
            "culled: it gives this object nothing in any frame (out of range, outside its cone, or black)");
  EXPECT_EQ(useOf({far(0)}, target).why, "far: the rig holds it without error");
  EXPECT_EQ(useOf({far(0.02f)}, target).why, "far: in the rig it is wrong by at most 1.00 % of the mean light");
  EXPECT_EQ(useOf({far(0.2f)}, target).why,
            "far: in the rig it is wrong by at most 10.0 % of the mean light; by the rig's estimate the target is met "
            "without it");
  EXPECT_EQ(useOf({far(0.2f)}, target, 200).why,
            "far: in the rig it is wrong by at most 10.0 % of the mean light; others take the budget");
  EXPECT_EQ(useOf({far(0.2f)}, two).why,
            "far: in the rig it is wrong by at most 10.0 % of the mean light; others come before it");
  EXPECT_EQ(useOf({far(0.2f)}).why,
            "far: in the rig it is wrong by at most 10.0 % of the mean light; no light is evaluated apart");
}

TEST(LightLog, KeepsTheCourseOfTheLightsThatMatter) {
  constexpr std::size_t kLights = 500;
  std::vector<LightRow> lights;
  std::vector<LightVerdict> frame;
  for (std::size_t i = 0; i < kLights; ++i) {
    lights.push_back({"light " + std::to_string(i), "point", ""});
    frame.push_back(far(1 + static_cast<float>(i)));
  }
  const auto kept = [&](const std::vector<LightVerdict>& verdicts) {
    LightLog log;
    log.add(verdicts);
    const int number = 0;
    std::vector<std::string> names;
    for (const LightReport& use : log.uses({lights, {&number, 1}, 2, {}, {}}))
      if (!use.bounds.empty()) names.push_back(use.name);
    return names;
  };
  EXPECT_THAT(kept(frame), testing::IsEmpty()) << "nothing is ever near";
  frame[7] = near();
  const std::vector<std::string> names = kept(frame);
  EXPECT_EQ(names.size(), 1 + LightLog::kKept);
  EXPECT_EQ(names.front(), "light 7");
  EXPECT_EQ(names.back(), "light 499");
}

TEST(LightLog, WithoutLightBoundsAreZero) {
  LightLog log;
  const LightVerdict verdict = far(3);
  log.add({&verdict, 1});
  const std::vector<LightRow> lights{{"lamp", "sphere", ""}};
  const int number = 0;
  EXPECT_EQ(log.uses({lights, {&number, 1}, 0, {}, {}}).at(0).bound, 0);
}

}  // namespace
}  // namespace rigel::tests
