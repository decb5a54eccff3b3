// Weights and slots of near lights, frame by frame: formula, rate limit, lights that come and go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rigel/near_far.h>

#include <limits>
#include <random>

namespace rigel::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using Floats = std::vector<float>;
using Ids = std::vector<std::uint32_t>;

constexpr float kFrame = 1.0f / 60;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

NearFar withSlots(int slots, float rate = 20) { return NearFar({slots, 0, rate}); }

Floats weightsOf(const NearFar& nearFar) { return {nearFar.weights().begin(), nearFar.weights().end()}; }
std::vector<int> slotsOf(const NearFar& nearFar) { return {nearFar.slots().begin(), nearFar.slots().end()}; }

/// Slots hold different lights, and a light has one exactly where it has a weight.
void expectSound(const NearFar& nearFar, const std::string& where) {
  std::vector<int> slotsOfLight(nearFar.weights().size());
  for (const int light : nearFar.slots())
    if (light >= 0) ++slotsOfLight.at(light);
  for (std::size_t i = 0; i < slotsOfLight.size(); ++i) {
    EXPECT_EQ(slotsOfLight[i], nearFar.weights()[i] > 0 ? 1 : 0) << where << ", light " << i;
    EXPECT_GE(nearFar.weights()[i], 0) << where;
    EXPECT_LE(nearFar.weights()[i], 1) << where;
  }
}

TEST(NearFar, WeightIsTheSmoothstepOfTheErrorOverThatOfTheNextRank) {
  NearFar nearFar = withSlots(2);
  nearFar.update(Floats{4, 1, 1.5f, 0.5f}, {}, kFrame);
  // F = 1: 4 is past the blend, 1.5 in its middle.
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 0, 0.5f, 0));
  EXPECT_THAT(slotsOf(nearFar), ElementsAre(0, 2));
}

TEST(NearFar, ToleranceKeepsSmallErrorsInTheRig) {
  NearFar nearFar({3, 2, 20});
  nearFar.update(Floats{3, 2, 1.9f, 8}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0.5f, 0, 0, 1));
}

TEST(NearFar, FewerLightsThanSlotsAreAllNear) {
  NearFar nearFar = withSlots(4);
  nearFar.update(Floats{3, 0, 1e-20f}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 0, 1));
}

TEST(NearFar, TiesStayInTheRig) {
  NearFar nearFar = withSlots(2);
  nearFar.update(Floats{1, 1, 1, 1}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), Each(0));
  EXPECT_THAT(slotsOf(nearFar), ElementsAre(-1, -1));
}

TEST(NearFar, NoSlotsAndNoLights) {
  NearFar none = withSlots(0);
  none.update(Floats{1, 2}, {}, kFrame);
  EXPECT_THAT(weightsOf(none), ElementsAre(0, 0));
  EXPECT_TRUE(none.slots().empty());
  NearFar nearFar = withSlots(2);
  nearFar.update({}, {}, kFrame);
  EXPECT_TRUE(nearFar.weights().empty());
  EXPECT_THAT(slotsOf(nearFar), ElementsAre(-1, -1));
  NearFar negative = withSlots(-3);
  negative.update(Floats{1}, {}, kFrame);
  EXPECT_THAT(weightsOf(negative), ElementsAre(0));
  NearFar many = withSlots(1000);
  many.update(Floats(100, 1.0f), {}, kFrame);
  EXPECT_EQ(many.slots().size(), static_cast<std::size_t>(kMaxNearLights));
}

TEST(NearFar, NanIsNoErrorAndInfinityTheLargest) {
  NearFar nearFar = withSlots(2);
  nearFar.update(Floats{kNan, -1, kInf, 1, 2}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 0, 1, 0, 1));
  nearFar.reset();
  nearFar.update(Floats{kInf, kInf, kInf}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), Each(0));
  NearFar tolerant({2, kNan, kNan});
  tolerant.update(Floats{1, 3, 9}, {}, kFrame);
  EXPECT_THAT(weightsOf(tolerant), ElementsAre(0, 1, 1));
}

TEST(NearFar, WeightsMoveNoFasterThanTheRate) {
  // Two lights trade places: the new one waits for the slot until the old one has faded out.
  NearFar nearFar = withSlots(1, 10);
  nearFar.update(Floats{4, 1}, {}, 0.01f);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 0));
  Floats last = weightsOf(nearFar);
  bool waited = false;
  for (int frame = 0; frame < 25; ++frame) {
    nearFar.update(Floats{1, 4}, {}, 0.01f);
    expectSound(nearFar, "frame " + std::to_string(frame));
    for (int i = 0; i < 2; ++i) EXPECT_LE(std::abs(nearFar.weights()[i] - last[i]), 0.1f * 1.0001f);
    waited = waited || (last[0] > 0 && nearFar.weights()[1] == 0);
    last = weightsOf(nearFar);
  }
  EXPECT_TRUE(waited);
  EXPECT_THAT(last, ElementsAre(0, 1));
}

TEST(NearFar, WithoutALimitWeightsFollowAtOnce) {
  NearFar nearFar = withSlots(1, 0);
  nearFar.update(Floats{4, 1}, {}, kFrame);
  nearFar.update(Floats{1, 4}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 1));
}

TEST(NearFar, OrdinaryMotionIsNotSlowed) {
  // A lamp passed at 3 m and 2 m/s among fixed ones, errors as 1/d^3: the limit never bites at 20 a second.
  NearFar limited = withSlots(2), free = withSlots(2, 0);
  for (int frame = 0; frame < 600; ++frame) {
    const float x = -10 + 2 * kFrame * static_cast<float>(frame);
    const Floats errors = {std::pow(9 + x * x, -1.5f), 0.012f, 0.01f, 0.02f};
    limited.update(errors, {}, kFrame);
    free.update(errors, {}, kFrame);
    ASSERT_EQ(weightsOf(limited), weightsOf(free)) << frame;
  }
}

TEST(NearFar, NewLightsTakeAFreeSlotAtOnce) {
  NearFar nearFar = withSlots(2);
  nearFar.update(Floats{4}, Ids{7}, kFrame);
  nearFar.update(Floats{4, 5}, Ids{7, 9}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 1));
}

TEST(NearFar, NewLightsWaitForAnOccupiedSlotAndThenFadeIn) {
  NearFar nearFar = withSlots(1, 20);
  nearFar.update(Floats{4, 1}, Ids{7, 8}, kFrame);
  nearFar.update(Floats{4, 1, 50}, Ids{7, 8, 9}, kFrame);
  EXPECT_NEAR(nearFar.weights()[0], 2.0f / 3, 1e-6);
  EXPECT_EQ(nearFar.weights()[2], 0);
  nearFar.update(Floats{4, 1, 50}, Ids{7, 8, 9}, kFrame);
  EXPECT_EQ(nearFar.weights()[2], 0);
  for (const float weight : {1.0f / 3, 2.0f / 3, 1.0f}) {
    nearFar.update(Floats{4, 1, 50}, Ids{7, 8, 9}, kFrame);
    EXPECT_EQ(nearFar.weights()[0], 0);
    EXPECT_NEAR(nearFar.weights()[2], weight, 1e-6);
  }
}

TEST(NearFar, LightsSwitchedOnAndOffLeaveNothingToFade) {
  NearFar nearFar = withSlots(1);
  nearFar.update(Floats{0, 2}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 1));
  // Off: black lights give up weight and slot; on: nothing of it was in the rig.
  nearFar.update(Floats{9, 0}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 0));
  // What was far until now, because the other outshone it, fades.
  nearFar.update(Floats{9, 2}, {}, kFrame);
  nearFar.update(Floats{0, 2}, {}, kFrame);
  EXPECT_NEAR(nearFar.weights()[1], 1.0f / 3, 1e-6);
}

TEST(NearFar, LightsThatAreGoneFreeTheirSlots) {
  NearFar nearFar = withSlots(1);
  nearFar.update(Floats{9, 2}, Ids{5, 6}, kFrame);
  nearFar.update(Floats{2, 8}, Ids{6, 4}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 1));
}

TEST(NearFar, OrderOfLightsDoesNotMatter) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0.1f, 1);
  NearFar sorted = withSlots(3), shuffled = withSlots(3);
  Ids order(12);
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  Floats errors(order.size());
  for (int frame = 0; frame < 300; ++frame) {
    if (frame % 20 == 0)
      for (float& e : errors) e = unit(random);
    std::shuffle(order.begin(), order.end(), random);
    Floats moved(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) moved[i] = errors[order[i]];
    sorted.update(errors, {}, kFrame);
    shuffled.update(moved, order, kFrame);
    for (std::size_t i = 0; i < order.size(); ++i)
      ASSERT_EQ(shuffled.weights()[i], sorted.weights()[order[i]]) << "frame " << frame;
    for (std::size_t slot = 0; slot < 3; ++slot) {
      const int light = shuffled.slots()[slot];
      ASSERT_EQ(sorted.slots()[slot], light < 0 ? -1 : static_cast<int>(order[light])) << "frame " << frame;
    }
  }
}

TEST(NearFar, EqualIdsAreMatchedInOrder) {
  NearFar nearFar = withSlots(2);
  nearFar.update(Floats{9, 1, 8, 1}, Ids{3, 3, 3, 3}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 0, 1, 0));
  const std::vector<int> before = slotsOf(nearFar);
  nearFar.update(Floats{9, 1, 8, 1}, Ids{3, 3, 3, 3}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(1, 0, 1, 0));
  EXPECT_EQ(slotsOf(nearFar), before);
}

TEST(NearFar, ALightKeepsItsSlotWhileItHasAWeight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  NearFar nearFar = withSlots(4);
  Floats phase(16), speed(16);
  for (float& p : phase) p = 3 * unit(random);
  for (float& s : speed) s = 2 * unit(random);
  std::vector<int> before(4, -1);
  for (int frame = 0; frame < 2000; ++frame) {
    Floats errors;
    for (int i = 0; i < 16; ++i)
      errors.push_back(std::exp(2 * std::sin(phase[i] + speed[i] * kFrame * static_cast<float>(frame))));
    const Floats last = weightsOf(nearFar);
    nearFar.update(errors, {}, kFrame);
    expectSound(nearFar, "frame " + std::to_string(frame));
    for (int slot = 0; slot < 4; ++slot) {
      const int light = before[slot];
      if (light >= 0 && nearFar.weights()[light] > 0) {
        ASSERT_EQ(nearFar.slots()[slot], light) << "frame " << frame;
      }
    }
    for (std::size_t i = 0; i < last.size(); ++i) {
      ASSERT_LE(std::abs(nearFar.weights()[i] - last[i]), 20 * kFrame * 1.0001f) << "frame " << frame;
    }
    before = slotsOf(nearFar);
  }
}

TEST(NearFar, CutsTakeWeightsAtOnce) {
  for (const float seconds : {0.0f, -1.0f, kNan, kInf, kFrame}) {
    NearFar nearFar = withSlots(1);
    nearFar.update(Floats{9, 1}, {}, kFrame);
    if (seconds == kFrame) nearFar.reset();
    nearFar.update(Floats{1, 9}, {}, seconds);
    EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 1)) << seconds;
    expectSound(nearFar, "after a cut");
  }
}

TEST(NearFar, ATeleportWithoutResetFades) {
  NearFar nearFar = withSlots(2);
  nearFar.update(Floats{9, 8, 1, 1}, {}, kFrame);
  for (int frame = 0; frame < 7; ++frame) {
    nearFar.update(Floats{1, 1, 9, 8}, {}, kFrame);
    expectSound(nearFar, "frame " + std::to_string(frame));
  }
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 0, 1, 1));
}

TEST(NearFar, FollowsWeightsFoundElsewhere) {
  NearFar nearFar = withSlots(2);
  nearFar.follow(Floats{0.25f, kNan, 2, 0}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0.25f, 0, 1, 0));
  // More than there are slots: holders first, the rest stays in the rig.
  nearFar.follow(Floats{0.25f, 0.9f, 1, 0.1f}, {}, kFrame);
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0.25f, 0, 1, 0));
  // Every light may have been in the rig, so that none is exempt from the limit.
  nearFar.follow(Floats{0, 0.9f, 1, 0}, {}, kFrame);
  nearFar.follow(Floats{0, 0.9f, 1, 0}, {}, kFrame);
  EXPECT_GT(nearFar.weights()[1], 0);
  EXPECT_LT(nearFar.weights()[1], 0.7f);
  expectSound(nearFar, "follow");
}

TEST(NearFar, ApproachesWhatIsWantedByAShareOfTheWayThatShrinksWithTheFrame) {
  NearFarOptions options;
  options.approachRate = 60;
  for (const float hertz : {30.0f, 120.0f, 480.0f}) {
    NearFar nearFar(options);
    nearFar.follow(Floats{0.5f}, {}, 1 / hertz);
    const float share = std::min(60 / hertz, 1.0f);
    nearFar.follow(Floats{0.6f}, {}, 1 / hertz);
    EXPECT_NEAR(nearFar.weights()[0], 0.5f + 0.1f * share, 1e-6f) << hertz;
    // A long way is limited as ever.
    nearFar.reset();
    nearFar.follow(Floats{0}, {}, 1 / hertz);
    nearFar.follow(Floats{1}, {}, 1 / hertz);
    EXPECT_NEAR(nearFar.weights()[0], std::min(20 / hertz, share), 1e-6f) << hertz;
    // It arrives, and leaves its slot.
    for (int i = 0; i < 240; ++i) nearFar.follow(Floats{0}, {}, 1 / hertz);
    EXPECT_EQ(nearFar.weights()[0], 0) << hertz;
  }
}

TEST(NearFar, FollowsAtOnceWhereErrorsSayThatNothingFades) {
  NearFar nearFar = withSlots(1);
  nearFar.follow(Floats{0, 0, 0}, {}, kFrame, Floats{0, 0, 1});
  nearFar.follow(Floats{1, 1, 0}, {}, kFrame, Floats{3, 5, 1});
  EXPECT_THAT(weightsOf(nearFar), ElementsAre(0, 1, 0));
}

TEST(NearFar, FewerSlotsTakeEffectAtOnce) {
  NearFar nearFar = withSlots(3);
  nearFar.update(Floats{9, 8, 7, 1}, {}, kFrame);
  nearFar.options().slots = 1;
  nearFar.update(Floats{9, 8, 7, 1}, {}, kFrame);
  expectSound(nearFar, "one slot");
  EXPECT_EQ(nearFar.slots().size(), 1u);
}

TEST(NearFar, RandomHardInputsStaySound) {
  std::mt19937 random(6);
  const auto chance = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  const Floats values = {0, 0, 1, 1, 2, 3, 1e-38f, 3e38f, kInf, kNan, -1, 1e-45f};
  NearFar nearFar;
  for (int frame = 0; frame < 3000; ++frame) {
    nearFar.options() = {chance(70) - 2, values[chance(12)], values[chance(12)]};
    Floats errors(frame % 50 == 0 ? 500 : chance(20));
    for (float& e : errors) e = values[chance(12)];
    Ids ids;
    if (chance(2) == 0)
      for (std::size_t i = 0; i < errors.size(); ++i) ids.push_back(static_cast<std::uint32_t>(chance(10)));
    const float seconds = chance(5) == 0 ? values[chance(12)] : kFrame;
    if (chance(2) == 0)
      nearFar.update(errors, ids, seconds);
    else
      nearFar.follow(errors, ids, seconds);
    ASSERT_EQ(nearFar.weights().size(), errors.size());
    expectSound(nearFar, "frame " + std::to_string(frame));
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace rigel::test
