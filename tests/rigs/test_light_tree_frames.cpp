// The light tree from frame to frame: refits, masks, continuity, and how much it looks at.
#include <gtest/gtest.h>

#include "light_tree_truth.h"
#include "random_light_cloud.h"

#include <algorithm>
#include <cstring>

namespace rigel::test {
namespace {

using Kinds = RandomLightCloud::Kinds;

bool same(const LightSelection& a, const LightSelection& b) {
  const auto equal = [](const std::vector<LightUse>& x, const std::vector<LightUse>& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(LightUse)) == 0);
  };
  return equal(a.nearby, b.nearby) && equal(a.distant, b.distant) && a.bound == b.bound && a.mean == b.mean &&
         a.visited == b.visited;
}

/// Lamps on a jittered square grid over a plane, `spacing` apart: what cities have.
LightSet lampPlane(int count, float spacing, unsigned seed, float shift = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  LightSet lights;
  for (int i = 0; i < count; ++i) {
    const float x = (static_cast<float>(i % side) + 0.6f * unit(random) - 0.5f * static_cast<float>(side)) * spacing;
    const float z = (static_cast<float>(i / side) + 0.6f * unit(random) - 0.5f * static_cast<float>(side)) * spacing;
    const float y = 5 + 3 * unit(random);
    const float green = 0.8f + 0.1f * unit(random);
    const float turn = 6.2832f * unit(random);
    lights.add(PointLight{{x + shift * std::cos(turn), y, z + shift * std::sin(turn)}, Rgb{1, green, 0.7f} * 400.0f});
  }
  return lights;
}

TEST(LightTree, NoLightsAreNoTrouble) {
  LightTree tree;
  LightSelection selection;
  selection.nearby.resize(3);
  tree.select({}, selection);
  EXPECT_TRUE(selection.nearby.empty());
  LightSet lights;
  tree.update(lights);
  tree.select({{1, 2, 3}, 1}, selection);
  EXPECT_EQ(selection.visited, 0);
  lights.add(PointLight{{0, 2, 0}, {1, 1, 1}});
  tree.update(lights);
  tree.select({{1, 2, 3}, 1}, selection);
  ASSERT_EQ(selection.nearby.size() + selection.distant.size(), 1u);
}

// Infinite, NaN and absurd arguments: no endless loop, no share outside [0, 1], every light once.
TEST(LightTree, AbsurdQueriesGetTheLightsOneByOne) {
  const LightSet lights = lampPlane(100, 10, 3);
  LightTree tree;
  tree.build(lights);
  LightSelection selection;
  const float inf = kNoRange, nan = std::nanf("");
  for (const LightQuery& query :
       {LightQuery{{nan, 0, 0}, 1}, LightQuery{{inf, 0, 0}, 1}, LightQuery{{}, inf}, LightQuery{{}, nan},
        LightQuery{{}, 1, 0}, LightQuery{{}, 1, nan}, LightQuery{{}, 1, -1}, LightQuery{{}, 1, inf},
        LightQuery{{}, 1, 0.1f, nan}, LightQuery{{}, 1, 0.1f, inf}, LightQuery{{}, 1, 0.1f, -1}}) {
    tree.select(query, selection);
    double whole = 0;
    for (const auto* list : {&selection.nearby, &selection.distant}) {
      for (const LightUse& use : *list) {
        ASSERT_TRUE(use.share >= 0 && use.share <= 1);
        visitUse(lights, tree, use, [&](const auto& light) {
          double power = colourOf(light).r;
          if constexpr (requires { light.radiance; }) power *= M_PI * light.radius * light.radius;
          whole += use.share * power;
        });
      }
    }
    EXPECT_NEAR(whole, 100 * 400, 0.1);
  }
}

TEST(LightTree, LightsOutsideTheGroupsAreNeverVisited) {
  RandomLightCloud random(7);
  LightSet lights, wanted;
  const LightSet all = random.cloud(4000, 100, Kinds::all, false);
  for (int i = 0; i < all.size(); ++i) {
    const std::uint32_t groups = 1u << (i % 3);
    all.visit(i, [&](const auto& light) {
      lights.add(light, groups);
      if (groups == 2) wanted.add(light);
    });
  }
  LightTree tree, alone;
  tree.build(lights);
  alone.build(wanted);
  for (int i = 0; i < 50; ++i) {
    LightQuery query{random.direction() * 150.0f, 1, 0.05f};
    query.groups = 2;
    LightSelection selection, expected;
    tree.select(query, selection);
    alone.select(query, expected);
    EXPECT_EQ(selection.visited, expected.visited);
    EXPECT_EQ(selection.nearby.size(), expected.nearby.size());
    for (const auto* list : {&selection.nearby, &selection.distant}) {
      for (const LightUse& use : *list) {
        if (use.light >= static_cast<std::uint32_t>(lights.size())) continue;
        EXPECT_EQ(lights.groups(static_cast<int>(use.light)), 2u);
      }
    }
    const SelectionError error = errorOf(lights, tree, query, selection, random.random(), 1);
    EXPECT_LE(error.rms, 1);
    query.groups = 6;
    tree.select(query, selection);
    EXPECT_LE(errorOf(lights, tree, query, selection, random.random(), 1).rms, 1);
    query.groups = 8;
    tree.select(query, selection);
    EXPECT_EQ(selection.visited, 0);
  }
}

TEST(LightTree, RefitOfSomeIsRefitOfAll) {
  RandomLightCloud random(9);
  LightSet lights = random.cloud(1500, 100, Kinds::all, true);
  LightTree some, all;
  some.build(lights);
  all.build(lights);
  for (int frame = 0; frame < 7; ++frame) {
    std::vector<std::uint32_t> moved;
    LightSet next;
    for (int i = 0; i < lights.size(); ++i) {
      lights.visit(i, [&](auto light) {
        if (i % 7 == frame) {
          moved.push_back(static_cast<std::uint32_t>(i));
          if constexpr (requires { light.position; }) light.position += random.direction() * 3.0f;
          if constexpr (requires { light.direction; }) light.direction += random.direction() * 0.2f;
          colourOf(light) = colourOf(light) * 1.5f;
        }
        next.add(light, lights.groups(i));
      });
    }
    lights = next;
    // Twice the same, and in any order.
    moved.push_back(moved.front());
    std::shuffle(moved.begin(), moved.end(), random.random());
    ASSERT_TRUE(some.refit(lights, moved));
    ASSERT_TRUE(all.refit(lights));
    ASSERT_EQ(some.clusters().size(), all.clusters().size());
    for (std::size_t i = 0; i < all.clusters().size(); ++i) {
      ASSERT_EQ(some.clusters()[i].position, all.clusters()[i].position);
      ASSERT_EQ(some.clusters()[i].radiance, all.clusters()[i].radiance);
    }
    for (int i = 0; i < 10; ++i) {
      const LightQuery query{random.direction() * 150.0f, 2, 0.05f};
      LightSelection a, b;
      some.select(query, a);
      all.select(query, b);
      ASSERT_TRUE(same(a, b));
      ASSERT_LE(errorOf(lights, some, query, a, random.random(), 1).rms, 1);
    }
  }
}

TEST(LightTree, RefitRefusesWhatBelongsElsewhere) {
  const LightSet lights = lampPlane(50, 10, 3);
  LightTree tree;
  tree.build(lights);
  LightSelection before, after;
  const LightQuery query{{1, 1, 2}, 1};
  tree.select(query, before);
  const auto changed = [&](auto change) {
    LightSet other;
    for (int i = 0; i < lights.pointCount(); ++i) {
      PointLight light = lights.point(i);
      std::uint32_t groups = kAllLightGroups;
      light.position.x += 1;
      if (i == 49) change(light, groups);
      other.add(light, groups);
    }
    return other;
  };
  std::vector<std::uint32_t> moved(50);
  for (std::uint32_t i = 0; i < 50; ++i) moved[i] = i;
  std::vector<LightSet> others{changed([](PointLight& l, std::uint32_t&) { l.range = 5; }),
                               changed([](PointLight& l, std::uint32_t&) { l.position.x = 1e30f; }),
                               changed([](PointLight&, std::uint32_t& groups) { groups = 1; }), lampPlane(49, 10, 3)};
  for (const LightSet& other : others) {
    EXPECT_FALSE(tree.refit(other));
    EXPECT_FALSE(tree.refit(other, moved));
    tree.select(query, after);
    EXPECT_TRUE(same(before, after));
  }
  const std::uint32_t beyond[] = {50};
  EXPECT_FALSE(tree.refit(lights, beyond));
  tree.update(others[0]);
  EXPECT_TRUE(tree.refit(others[0]));
}

// Lamps that wander by a tenth of their spacing a frame: refitted trees stay within kWorthBuilding of fresh ones, and
// so does what they select.
TEST(LightTree, UpdateKeepsTheTreeAsGoodAsNew) {
  LightTree tree, fresh;
  LightSelection selection;
  double kept = 0, built = 0;
  int builds = 0;
  for (int frame = 0; frame < 40; ++frame) {
    const LightSet lights = lampPlane(2000, 20, 3, 2.0f * static_cast<float>(frame));
    const float before = tree.growth();
    tree.update(lights);
    builds += tree.growth() == 1 && before != 1;
    EXPECT_LT(tree.growth(), LightTree::kWorthBuilding);
    fresh.build(lights);
    for (int i = 0; i < 5; ++i) {
      const LightQuery query{{30.0f * static_cast<float>(i), 1, 0}, 1, 0.05f};
      tree.select(query, selection);
      kept += static_cast<double>(selection.nearby.size() + selection.distant.size());
      fresh.select(query, selection);
      built += static_cast<double>(selection.nearby.size() + selection.distant.size());
    }
  }
  EXPECT_GT(builds, 1);
  EXPECT_LT(builds, 30);
  constexpr double kWorse = 1.15;  // clusters a quarter larger; measured: 1.115
  EXPECT_LT(kept, kWorse * built);
  std::printf("%d builds in 40 frames, %.3f times the lights and clusters of fresh trees\n", builds, kept / built);
}

TEST(LightTree, TheSameQueryGivesTheSameBits) {
  RandomLightCloud random(13);
  const LightSet lights = random.cloud(3000, 100, Kinds::all, true);
  LightTree a, b;
  a.build(lights);
  b.build(lampPlane(100, 10, 1));
  b.build(lights);
  LightSelection x, y;
  for (int i = 0; i < 100; ++i) {
    const LightQuery query{random.direction() * 200.0f, 1, 0.03f};
    a.select(query, x);
    b.select(query, y);
    ASSERT_TRUE(same(x, y));
  }
}

// In a plane of lamps without range the light itself grows with the logarithm of their number, each power of e of
// distance giving as much; what is looked at must grow no faster.
TEST(LightTree, LooksAtLogarithmicallyManyLights) {
  double uses[3] = {}, visited[3] = {};
  const int counts[3] = {2000, 8000, 32000};
  for (int k = 0; k < 3; ++k) {
    const LightSet lights = lampPlane(counts[k], 30, 5);
    LightTree tree;
    tree.build(lights);
    LightSelection selection;
    for (int i = 0; i < 20; ++i) {
      tree.select({{7.0f * static_cast<float>(i), 1, 3.0f * static_cast<float>(i)}, 1, 0.2f}, selection);
      uses[k] += static_cast<double>(selection.nearby.size() + selection.distant.size()) / 20;
      visited[k] += selection.visited / 20.0;
    }
  }
  // Equal steps, and not equal factors.
  EXPECT_LT(uses[2] - uses[1], 1.3 * (uses[1] - uses[0]));
  EXPECT_LT(visited[2] - visited[1], 1.3 * (visited[1] - visited[0]));
  EXPECT_LT(uses[2], 0.03 * counts[2]);
  std::printf("uses %.0f %.0f %.0f, visited %.0f %.0f %.0f\n", uses[0], uses[1], uses[2], visited[0], visited[1],
              visited[2]);
}

// What the sums of bounds are worth: true errors of a crowd's packs in a plane of lamps.
TEST(LightTree, ErrorsAreFarBelowTheirBounds) {
  const LightSet lights = lampPlane(1600, 30, 5);
  LightTree tree;
  tree.build(lights);
  std::mt19937 random(1);
  for (const float target : {0.05f, 0.2f}) {
    double bound = 0, worst = 0, uses = 0;
    for (int i = 0; i < 8; ++i) {
      const LightQuery query{.centre = {31.0f * static_cast<float>(i), 1, 17.0f * static_cast<float>(i)},
                             .radius = 6,
                             .target = target,
                             .everywhere = true};
      LightSelection selection;
      tree.select(query, selection);
      ASSERT_LE(selection.bound, target * selection.reference);
      const SelectionError error = errorOf(lights, tree, query, selection, random, 4);
      ASSERT_LE(error.rms, 1);
      bound = std::max(bound, double{selection.bound} / selection.mean);
      worst = std::max(worst, error.rms * selection.bound / selection.mean);
      uses += static_cast<double>(selection.nearby.size() + selection.distant.size()) / 8;
    }
    std::printf("target %.2f: %.0f lights and clusters, bounds up to %.3f, errors up to %.4f\n", target, uses, bound,
                worst);
    constexpr double kLoose = 0.25;  // errors of many clusters cancel; measured: 0.17
    EXPECT_LT(worst, kLoose * bound);
  }
}

// Lamps with a range cost the same however many there are.
TEST(LightTree, LampsOutOfRangeCostNothing) {
  double visited[2] = {};
  for (int k = 0; k < 2; ++k) {
    const LightSet plane = lampPlane(k == 0 ? 1000 : 32000, 30, 5);
    LightSet lights;
    for (int i = 0; i < plane.size(); ++i) {
      PointLight light = plane.point(i);
      light.range = 60;
      lights.add(light);
      lights.add(SpotLight{light.position, {0, -1, 0}, light.intensity, 0.5f, 1.1f});
    }
    LightTree tree;
    tree.build(lights);
    LightSelection selection;
    for (int i = 0; i < 20; ++i) {
      tree.select({{7.0f * static_cast<float>(i), 1, 3.0f * static_cast<float>(i)}, 1, 0.05f}, selection);
      visited[k] += selection.visited / 20.0;
    }
  }
  // One more look a level of the tree.
  EXPECT_LT(visited[1], 1.6 * visited[0]);
}

/// Largest change of (selected - true) irradiance between frames, per mean irradiance, of an object that drives through
/// a plane of lamps some of which move.
double largestJump(int rate, float target, double* size = nullptr) {
  const LightSet start = lampPlane(300, 12, 17);
  LightTree tree;
  LightSelection selection;
  DoubleSh last{};
  double jump = 0, mean = 0;
  const int frames = rate;
  for (int frame = 0; frame <= frames; ++frame) {
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
    const LightQuery query{{8 * t - 4, 1, 3 * t}, 0.5f, target};
    tree.select(query, selection);
    const Vec3 p = query.centre + Vec3{0.3f, 0.2f, 0.1f};
    const DoubleSh truth = trueSh(lights, query, p);
    const DoubleSh error = difference(selectedSh(lights, tree, query, selection, p), truth);
    if (frame > 0) jump = std::max(jump, irradianceOf(difference(error, last), 0).rms);
    if (size != nullptr) *size = std::max(*size, irradianceOf(error, 0).rms / selection.mean);
    last = error;
    mean = selection.mean;
  }
  return jump / mean;
}

TEST(LightTree, NothingPops) {
  for (const float target : {0.1f, 0.4f}) {
    double size = 0;
    const double slow = largestJump(60, target, &size), fast = largestJump(480, target);
    std::printf("target %.2f: error up to %.5f, jump %.6f at 60 Hz, %.6f at 480: %.3f\n", target, size, slow, fast,
                fast / slow);
    EXPECT_GT(slow, 1e-5);
    EXPECT_LT(fast, 0.25 * slow);
  }
}

}  // namespace
}  // namespace rigel::test
