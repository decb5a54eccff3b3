// What is distant for a large ball, and smaller balls that go on from there, against double sums over all lights.
#include <gtest/gtest.h>

#include "light_tree_truth.h"
#include "random_light_cloud.h"

#include <cstdlib>

namespace rigel::test {
namespace {

using Kinds = RandomLightCloud::Kinds;

int rounds(int quick, int full) { return std::getenv("RIGEL_FULL") != nullptr ? full : quick; }

/// A large ball, what is taken for it, and the selection of a ball in it that goes on.
struct TwoBalls {
  LightQuery large, small;
  std::vector<LightUse> whole, parts;
  LightCut rest;
  LightSelection selection;

  void ask(const LightTree& tree) {
    tree.takeDistant(large, small.radius, whole, parts, rest);
    tree.select(small, &rest, selection);
  }
  /// At a point of the small ball: its selection, the parts by slopes at its centre, the rest at the large one's.
  DoubleSh shAt(const LightSet& lights, const LightTree& tree, Vec3 p) const {
    DoubleSh sum = selectedSh(lights, tree, small, selection, p);
    LightSelection taken;
    const auto add = [&](const std::vector<LightUse>& uses, const LightQuery& ball) {
      taken.distant = uses;
      const DoubleSh sh = selectedSh(lights, tree, ball, taken, p);
      for (int i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c) sum[i][c] += sh[i][c];
    };
    add(whole, large);
    add(parts, small);
    return sum;
  }
};

TwoBalls randomBalls(RandomLightCloud& cloud, float size) {
  TwoBalls balls;
  LightQuery& large = balls.large;
  large.centre = cloud.direction() * static_cast<float>(size * cloud.logUniform(0.01, 30));
  large.radius = static_cast<float>(size * cloud.logUniform(1e-3, 0.3));
  large.target = static_cast<float>(cloud.logUniform(0.005, 1));
  const float wraps[] = {0, 0, 0.5f, 1, -0.25f};
  large.wrap = wraps[cloud.below(5)];
  LightQuery& small = balls.small = large;
  small.radius = large.radius * static_cast<float>(cloud.chance(0.1) ? 1 : cloud.logUniform(0.05, 1));
  small.centre += cloud.direction() * static_cast<float>((large.radius - small.radius) * cloud.uniform(0, 1));
  small.everywhere = true;
  return balls;
}

struct Tally {
  double error = 0, target = 0, own = 0;
  std::size_t whole = 0, parts = 0, open = 0;
};

void expectBoundsHold(const LightSet& lights, const LightTree& tree, TwoBalls& balls, std::mt19937& random,
                      Tally& tally) {
  balls.ask(tree);
  const LightSelection& selection = balls.selection;
  ASSERT_LE(balls.rest.bound, double{balls.large.target} * balls.rest.mean * (1 + 1e-6));
  ASSERT_LE(selection.bound, balls.small.target * selection.reference * 1.0001f);
  for (const Vec3 p : pointsOf(balls.small, random, 4)) {
    const DoubleSh truth = trueSh(lights, balls.small, p);
    const Irradiance all = irradianceOf(truth, balls.small.wrap);
    const Irradiance off = irradianceOf(difference(balls.shAt(lights, tree, p), truth), balls.small.wrap);
    const double rounding = 2 * kProjectionRounding * all.peak + 1e-30;
    ASSERT_LE(off.rms, selection.bound + rounding);
    ASSERT_LE(off.peak, selection.worst + rounding);
    ASSERT_LE(selection.mean, all.mean * (1 + kProjectionRounding) + 1e-30);
    tally.error = std::max(tally.error, off.rms / (selection.bound + rounding));
  }
  if (selection.reference > 0)
    tally.target = std::max(tally.target, double{selection.bound / (balls.small.target * selection.reference)});
  if (balls.rest.mean > 0) tally.own = std::max(tally.own, balls.rest.bound / (balls.large.target * balls.rest.mean));
  tally.whole += balls.whole.size();
  tally.parts += balls.parts.size();
  tally.open += balls.rest.open.size();
}

/// Clouds whose lights move from frame to frame, with the tree refitted.
void expectBoundsHold(Kinds kinds, bool hard, int clouds) {
  RandomLightCloud random(hard ? 21 : 8);
  Tally tally;
  for (int i = 0; i < clouds; ++i) {
    const auto size = static_cast<float>(random.logUniform(0.1, 1000));
    LightSet lights = random.cloud(1 + random.below(400), size, kinds, hard);
    LightTree tree;
    for (int frame = 0; frame < 3; ++frame) {
      tree.update(lights);
      TwoBalls balls = randomBalls(random, size);
      expectBoundsHold(lights, tree, balls, random.random(), tally);
      if (testing::Test::HasFatalFailure()) FAIL() << "cloud " << i << " frame " << frame;
      LightSet moved;
      for (int l = 0; l < lights.size(); ++l)
        lights.visit(l, [&](auto light) {
          if constexpr (requires { light.position; }) light.position += random.direction() * (0.02f * size);
          moved.add(light, lights.groups(l));
        });
      lights = moved;
    }
  }
  // Or nothing has been tested.
  const auto cases = static_cast<std::size_t>(3 * clouds);
  EXPECT_GT(tally.whole, cases);
  EXPECT_GT(tally.parts, cases / 4);
  EXPECT_GT(tally.open, cases / 4);
  std::printf("worst error/bound %.3f, bound/target up to %.3f, of what is taken %.3f; %zu, %zu for parts, %zu left\n",
              tally.error, tally.target, tally.own, tally.whole, tally.parts, tally.open);
}

TEST(LightTreeDistant, BoundsOfPointsAndSpheresHold) { expectBoundsHold(Kinds::plain, false, rounds(40, 1000)); }
TEST(LightTreeDistant, BoundsOfAllKindsHold) { expectBoundsHold(Kinds::all, false, rounds(40, 1000)); }
TEST(LightTreeDistant, BoundsOfHardLightsHold) { expectBoundsHold(Kinds::all, true, rounds(40, 1000)); }

LightSet lampPlane(int side, float spacing, unsigned seed) {
  RandomLightCloud random(seed);
  LightSet lights;
  for (int i = 0; i < side * side; ++i) {
    const auto along = [&](int n) {
      return (static_cast<float>(n) + 0.6f * static_cast<float>(random.uniform(0, 1)) -
              0.5f * static_cast<float>(side)) *
             spacing;
    };
    const float x = along(i % side), z = along(i / side);
    lights.add(PointLight{{x, static_cast<float>(random.uniform(5, 8)), z}, Rgb{1, 0.85f, 0.7f} * 400.0f},
               1u << random.below(2));
  }
  return lights;
}

// No light is lost, none counts twice, whatever is asked.
TEST(LightTreeDistant, EveryLightCountsOnce) {
  const LightSet lights = lampPlane(40, 20, 3);
  LightTree tree;
  tree.build(lights);
  const float inf = kNoRange, nan = std::nanf("");
  TwoBalls balls;
  for (const std::uint32_t groups : {1u, 3u})
    for (const Vec3 centre : {Vec3{}, Vec3{150, 0, 30}, Vec3{1e7f, 0, 0}, Vec3{nan, 0, 0}, Vec3{0, inf, 0}})
      for (const float radius : {30.0f, 0.0f, 1e9f, inf, nan, -1.0f})
        for (const float target : {0.2f, 0.01f, 0.0f, 3.0f, inf, nan}) {
          balls.large = {centre, radius, target};
          balls.large.groups = groups;
          balls.small = balls.large;
          balls.small.radius = 8;
          balls.small.everywhere = true;
          balls.ask(tree);
          double power = 0, all = 0;
          for (const auto* list : {&balls.whole, &balls.parts, &balls.selection.nearby, &balls.selection.distant})
            for (const LightUse& use : *list) {
              ASSERT_TRUE(use.share >= 0 && use.share <= 1);
              visitUse(lights, tree, use, [&](const auto& light) {
                double own = colourOf(light).r;
                if constexpr (requires { light.radiance; }) own *= M_PI * light.radius * light.radius;
                power += use.share * own;
              });
            }
          for (int i = 0; i < lights.size(); ++i) all += (lights.groups(i) & groups) != 0 ? 400 : 0;
          ASSERT_NEAR(power, all, 1e-4 * all) << groups << " " << centre.x << " " << radius << " " << target;
        }
}

// Lights that are close are handed on as few nodes, however many they are.
TEST(LightTreeDistant, DoesNotLookAtLightsInTheBall) {
  const LightSet lights = lampPlane(200, 1, 3);
  LightTree tree;
  tree.build(lights);
  TwoBalls balls;
  balls.large = {{}, 32, 0.2f};
  balls.small = {{}, 8.4f, 0.2f};
  balls.ask(tree);
  EXPECT_LT(balls.whole.size() + balls.parts.size() + balls.rest.open.size(), 1000u);
  EXPECT_GT(balls.selection.nearby.size() + balls.selection.distant.size(), 10u);
}

// What each small ball has to do does not grow with the city.
TEST(LightTreeDistant, LeavesLittleOfACity) {
  std::size_t looked[2] = {}, alone[2] = {};
  for (int k = 0; k < 2; ++k) {
    const LightSet lights = lampPlane(k == 0 ? 48 : 192, 30, 4);
    LightTree tree;
    tree.build(lights);
    for (int i = 0; i < 20; ++i) {
      TwoBalls balls;
      balls.large = {{40 + 7.0f * static_cast<float>(i), 1, 30 - 5.0f * static_cast<float>(i)}, 32, 0.2f};
      balls.small = {balls.large.centre + Vec3{5, 0, 10}, 8.4f, 0.2f};
      balls.small.everywhere = true;
      balls.ask(tree);
      EXPECT_LT(balls.rest.open.size(), 100u);
      looked[k] += static_cast<std::size_t>(balls.selection.visited) + balls.parts.size();
      tree.select(balls.small, balls.selection);
      alone[k] += static_cast<std::size_t>(balls.selection.visited);
    }
  }
  std::printf("looked at %zu and %zu, alone %zu and %zu\n", looked[0], looked[1], alone[0], alone[1]);
  // Measured: 1.13, and 1.79 where each looks at the tree by itself.
  EXPECT_LT(static_cast<double>(looked[1]), 1.2 * static_cast<double>(looked[0]));
  EXPECT_LT(looked[1], alone[1] / 2);
}

/// Largest change of (selected - true) irradiance between frames, per mean irradiance, of a small ball that drives
/// through a plane of lamps some of which move, in a large one that does too.
double largestJump(int rate, float target) {
  const LightSet start = lampPlane(18, 12, 17);
  LightTree tree;
  TwoBalls balls;
  DoubleSh last{};
  double jump = 0, mean = 0;
  std::size_t whole = 0, parts = 0;
  for (int frame = 0; frame <= rate; ++frame) {
    const float t = static_cast<float>(frame) / static_cast<float>(rate);
    LightSet lights;
    for (int i = 0; i < start.size(); ++i) {
      PointLight light = start.point(i);
      if (i % 3 == 0)
        light.position += Vec3{std::cos(static_cast<float>(i)), 0, std::sin(static_cast<float>(i))} * (4 * t);
      lights.add(light);
    }
    if (frame == 0)
      tree.build(lights);
    else
      EXPECT_TRUE(tree.refit(lights));
    balls.large = {{8 * t - 4, 1, 3 * t}, 6, target};
    balls.small = {balls.large.centre + Vec3{2, 0, 1 - t}, 1, target};
    balls.small.everywhere = true;
    balls.ask(tree);
    whole += balls.whole.size();
    parts += balls.parts.size();
    const Vec3 p = balls.small.centre + Vec3{0.3f, 0.2f, 0.1f};
    const DoubleSh error = difference(balls.shAt(lights, tree, p), trueSh(lights, balls.small, p));
    if (frame > 0) jump = std::max(jump, irradianceOf(difference(error, last), 0).rms);
    last = error;
    mean = balls.selection.mean;
  }
  EXPECT_GT(whole, static_cast<std::size_t>(rate));
  EXPECT_GT(parts, static_cast<std::size_t>(rate));
  return jump / mean;
}

TEST(LightTreeDistant, NothingPops) {
  for (const float target : {0.1f, 0.4f}) {
    const double slow = largestJump(60, target), fast = largestJump(480, target);
    std::printf("target %.2f: jump %.6f at 60 Hz, %.6f at 480: %.3f\n", target, slow, fast, fast / slow);
    EXPECT_GT(slow, 1e-5);
    EXPECT_LT(fast, 0.25 * slow);
  }
}

}  // namespace
}  // namespace rigel::test
