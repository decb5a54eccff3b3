// One frame's time over many objects: budgets hold, the largest visible error is shared, nothing pops.
#include "rig_fixture.h"

#include <rigel/light_budget.h>

#include <numeric>

namespace rigel::test {
namespace {

constexpr float kWanted = 0.03f;
constexpr int kPoints = 10000;

/// A crowd of ellipsoids under street lamps.
class Crowd {
 public:
  explicit Crowd(int count, LightingTarget::Kind kind = LightingTarget::Kind::totalError) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 20; ++i)
      lights.add(SphereLight{{15 * unit(random), 3 + unit(random), 15 * unit(random)}, 0.2f, {100, 90, 70}});
    shape = ellipsoid({0, 0, 0}, {0.4f, 1, 0.3f}, 512);
    LightingOptions options;
    options.target = {kind, kWanted};
    options.points = kPoints;
    for (int i = 0; i < count; ++i) {
      members.push_back(*ObjectLighting<3>::create(*parseRigSpec("auto"), {boxOf(shape), shape}, options));
      places.push_back({15 * unit(random), 1, 15 * unit(random)});
    }
    for (auto& member : members) pointers.push_back(&member);
    shares.resize(count);
    place();
  }

  void place(Vec3 offset = {}) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      std::vector<Vec3> anchors;
      for (int a : members[i].anchors()) anchors.push_back(shape[a]);
      RigFrame frame;
      frame.origin = places[i] + offset;
      members[i].setPose({boxOf(shape), anchors}, frame);
    }
  }

  BudgetOutcome light(float microseconds, float seconds = 0) {
    return lightWithinBudget<3>(pointers, visibility, lights, microseconds, seconds, shares);
  }
  float evaluated() const {  // microseconds of what is really evaluated, by the cost model
    float sum = 0;
    for (const auto& member : members) sum += member.modelledNanoseconds() * kPoints / 1000;
    return sum;
  }

  LightSet lights;
  std::vector<Vec3> shape, places;
  std::vector<ObjectLighting<3>> members;
  std::vector<ObjectLighting<3>*> pointers;
  std::vector<float> visibility;
  std::vector<BudgetShare> shares;
};

TEST(LightBudget, GivesEveryoneWhatTheyWantWhereThereIsTime) {
  Crowd crowd(8);
  const BudgetOutcome outcome = crowd.light(1e6f);
  EXPECT_TRUE(outcome.met);
  EXPECT_EQ(outcome.largestError, 0);
  for (const BudgetShare& share : crowd.shares) {
    EXPECT_EQ(share.granted, kWanted);
    EXPECT_FALSE(share.gaveUp());
  }
}

TEST(LightBudget, HoldsItsBudgetAndSharesTheLargestError) {
  Crowd crowd(12);
  const float all = crowd.light(1e6f).microseconds;
  float lastError = 0;
  for (const float part : {0.95f, 0.9f, 0.8f, 0.7f}) {
    const BudgetOutcome outcome = crowd.light(part * all);
    EXPECT_TRUE(outcome.met) << part;
    EXPECT_LE(outcome.microseconds, part * all);
    // What is evaluated counts whole vectors and lights, the model blends between choices: worst found 2 % above.
    EXPECT_LE(crowd.evaluated(), 1.05f * part * all) << part;
    EXPECT_GE(outcome.largestError, lastError) << "less time, no smaller error";
    lastError = outcome.largestError;
    int gaveUp = 0;
    for (const BudgetShare& share : crowd.shares) {
      gaveUp += share.gaveUp();
      EXPECT_NEAR(share.granted, std::max(kWanted, outcome.largestError), 1e-5f);
    }
    EXPECT_GT(gaveUp, 0);
  }
}

// Lights that are left behind leave gradually and are paid for until they have: others have to make room.
TEST(LightBudget, HoldsItsBudgetOnAverageWhereEveryoneWalks) {
  Crowd crowd(12);
  constexpr float kBudget = 2000, kSpeed = 4, kSeconds = 1.0f / 60;
  crowd.light(kBudget);
  double sum = 0;
  float late = 0;
  constexpr int kFrames = 120;
  for (int f = 1; f <= kFrames; ++f) {
    crowd.place({kSpeed * kSeconds * static_cast<float>(f), 0, 0});
    crowd.light(kBudget, kSeconds);
    sum += crowd.evaluated();
    for (const BudgetShare& share : crowd.shares) late += share.late / kFrames;
  }
  EXPECT_LE(sum / kFrames, kBudget);
  EXPECT_GT(late, 0.02f * kBudget) << "nothing was late";
}

TEST(LightBudget, TakesFromWhatIsSeenLeast) {
  Crowd crowd(8);
  crowd.visibility.assign(8, 1);
  for (int i = 4; i < 8; ++i) crowd.visibility[i] = 0.1f;
  const float all = crowd.light(1e6f).microseconds;
  const BudgetOutcome outcome = crowd.light(0.85f * all);
  ASSERT_TRUE(outcome.met);
  for (int i = 0; i < 8; ++i)
    EXPECT_NEAR(crowd.shares[i].granted, std::max(kWanted, outcome.largestError / crowd.visibility[i]), 1e-4f);
  EXPECT_GT(crowd.shares[7].granted, crowd.shares[0].granted);
}

TEST(LightBudget, SaysWhenEvenTheLeastIsTooMuch) {
  Crowd crowd(5);
  const BudgetOutcome outcome = crowd.light(1);
  EXPECT_FALSE(outcome.met);
  EXPECT_GT(outcome.microseconds, 1);
  for (const BudgetShare& share : crowd.shares) EXPECT_EQ(share.granted, kGiveUpError);
  for (const auto& member : crowd.members) EXPECT_TRUE(std::isfinite(*member.spatialEstimate()));
}

/// With costs of c / target the common visible error is known: sum(c points visibility) / budget, over those for whom
/// it is more than what they want.
TEST(LightBudget, AgreesWithTheClosedFormOfInverseCosts) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0.1f, 1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<float> costs;
    std::vector<BudgetShare> shares(1 + trial % 9);
    double sum = 0, least = 0;
    for (BudgetShare& share : shares) {
      costs.push_back(unit(random));
      share.wanted = kLeastError;
      share.visibility = unit(random);
      share.points = 1000 * unit(random);
      sum += static_cast<double>(costs.back() * share.points / 1000 * share.visibility);
      least = std::max(least, static_cast<double>(share.visibility * share.wanted));
    }
    // At most 0.15 / 0.1: nobody reaches kGiveUpError.
    const double error = std::max(0.15 * static_cast<double>(unit(random) * unit(random)), 2 * least);
    const auto cost = [](void* all, std::size_t i, float target) {
      return (*static_cast<std::vector<float>*>(all))[i] / target;
    };
    const BudgetOutcome outcome = spreadBudget(shares, {cost, &costs}, static_cast<float>(sum / error));
    EXPECT_TRUE(outcome.met);
    // Twenty halvings of three decades, and the last bits of the sums: worst found 7.4e-6.
    EXPECT_NEAR(static_cast<double>(outcome.largestError), error, 1.5e-5 * error);
    for (const BudgetShare& share : shares)
      EXPECT_NEAR(share.granted * share.visibility, outcome.largestError, 1e-6f * outcome.largestError);
  }
}

TEST(LightBudget, NobodyAndNoLight) {
  Crowd nobody(0);
  EXPECT_TRUE(nobody.light(10).met);
  Crowd crowd(3);
  crowd.lights.clear();
  EXPECT_TRUE(crowd.light(10).met);
  for (const auto& member : crowd.members) {
    const auto parts = member.shade({0, 0, 0}, {0, 1, 0}, MaterialWrap<3>());
    EXPECT_EQ(parts.rig.r + parts.nearLights.r, 0);
  }
}

/// The largest change of irradiance between frames, minus what the truth of distant lights would change, falls with the
/// length of the frames: time is taken from one object and given to another without a jump.
TEST(LightBudget, NothingPopsAsTimeMovesBetweenObjects) {
  const auto leap = [](int framesPerSecond) {
    Crowd crowd(6);
    const float budget = 0.8f * crowd.light(1e6f).microseconds;
    std::vector<float> last;
    float largest = 0;
    for (int f = 0; f <= framesPerSecond; ++f) {
      crowd.place({2.0f * static_cast<float>(f) / static_cast<float>(framesPerSecond), 0, 0});
      crowd.light(budget, f == 0 ? 0 : 1 / static_cast<float>(framesPerSecond));
      std::vector<float> now;
      const MaterialWrap<3> lambert;
      for (std::size_t i = 0; i < crowd.members.size(); ++i)
        for (int p = 0; p < 512; p += 16) {
          const Vec3 local = crowd.shape[p];
          const Vec3 offset{2.0f * static_cast<float>(f) / static_cast<float>(framesPerSecond), 0, 0};
          const Vec3 normal = local * (1 / length(local));
          const auto parts = crowd.members[i].shade(crowd.places[i] + offset + local, normal, lambert);
          now.push_back(parts.rig.r + parts.nearLights.r);
        }
      for (std::size_t i = 0; i < last.size(); ++i) largest = std::max(largest, std::abs(now[i] - last[i]));
      last = now;
    }
    return largest;
  };
  const float slow = leap(60), fast = leap(480);
  EXPECT_LE(fast, 0.25f * slow) << "60 Hz " << slow << ", 480 Hz " << fast;
}

}  // namespace
}  // namespace rigel::test
