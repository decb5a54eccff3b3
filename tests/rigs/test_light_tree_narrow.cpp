// Lights of a region narrowed for objects in it: bounds of all parts together hold, against double sums over all
// lights.
#include <gtest/gtest.h>

#include "light_tree_truth.h"
#include "random_light_cloud.h"

namespace rigel::test {
namespace {

using Kinds = RandomLightCloud::Kinds;

/// Region by value and slope at its own centre, and so on inwards; the last selection's near lights at p.
DoubleSh nestedSh(const LightSet& lights, const LightTree& tree, std::span<const LightQuery> queries,
                  std::span<const LightSelection> selections, Vec3 p) {
  DoubleSh sum{};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    LightSelection part;
    part.distant = selections[i].distant;
    if (i + 1 == queries.size()) part.near = selections[i].near;
    const DoubleSh sh = selectedSh(lights, tree, queries[i], part, p);
    for (int k = 0; k < 9; ++k) {
      for (int c = 0; c < 3; ++c) sum[k][c] += sh[k][c];
    }
  }
  return sum;
}

LightQuery inside(RandomLightCloud& random, const LightQuery& outer) {
  LightQuery query = outer;
  query.radius = outer.radius * static_cast<float>(random.logUniform(0.01, 0.9));
  query.centre += random.direction() * ((outer.radius - query.radius) * static_cast<float>(random.uniform(0, 0.999)));
  query.target = static_cast<float>(random.logUniform(0.002, 0.3));
  return query;
}

void expectBoundsHold(Kinds kinds, bool hard) {
  RandomLightCloud random(hard ? 23 : 21);
  double worst = 0, worstTarget = 0;
  long distant = 0, near = 0;
  for (int i = 0; i < 60; ++i) {
    const auto size = static_cast<float>(random.logUniform(0.1, 1000));
    const LightSet lights = random.cloud(1 + random.below(300), size, kinds, hard);
    LightTree tree;
    tree.build(lights);
    LightQuery queries[3];
    LightSelection selections[3];
    queries[0].centre = random.direction() * static_cast<float>(size * random.logUniform(0.01, 10));
    queries[0].radius = static_cast<float>(size * random.logUniform(1e-2, 1));
    queries[0].target = static_cast<float>(random.logUniform(0.005, 0.5));
    queries[0].slopeShare = static_cast<float>(random.uniform(0, 1));
    queries[0].everywhere = true;
    queries[0].wrap = random.chance(0.5) ? 0.5f : 0;
    tree.select(queries[0], selections[0]);
    double budget = double{queries[0].target} * selections[0].reference;
    for (int k = 1; k < 3; ++k) {
      queries[k] = inside(random, queries[k - 1]);
      tree.narrow(selections[k - 1], queries[k], selections[k]);
      budget += double{queries[k].target} * selections[0].reference;
      ASSERT_EQ(selections[k].reference, selections[0].reference);
      ASSERT_LE(selections[k].near.size(), selections[k - 1].near.size());
      ASSERT_GE(selections[k].bound, selections[k - 1].bound * 0.9999f);
      ASSERT_LE(selections[k].bound, budget * 1.0001 + 1e-30);
      distant += static_cast<long>(selections[k].distant.size());
      near += static_cast<long>(selections[k].near.size());
      for (const Vec3 p : pointsOf(queries[k], random.random(), 4)) {
        const DoubleSh truth = trueSh(lights, queries[0], p);
        const Irradiance whole = irradianceOf(truth, queries[0].wrap);
        ASSERT_GE(whole.mean * (1 + kProjectionRounding), selections[0].mean) << "cloud " << i;
        const DoubleSh found =
            nestedSh(lights, tree, std::span(queries).first(k + 1), std::span(selections).first(k + 1), p);
        const Irradiance error = irradianceOf(difference(found, truth), queries[0].wrap);
        const double ratio = error.rms / (selections[k].bound + kProjectionRounding * whole.peak + 1e-30);
        ASSERT_LE(ratio, 1) << "cloud " << i;
        ASSERT_LE(error.peak, selections[k].worst + kProjectionRounding * whole.peak + 1e-30) << "cloud " << i;
        worst = std::max(worst, ratio);
        if (budget > 0) worstTarget = std::max(worstTarget, selections[k].bound / budget);
      }
    }
  }
  EXPECT_GT(distant, 500);
  EXPECT_GT(near, 500);
  std::printf("worst error/bound %.3f, bound/target %.3f\n", worst, worstTarget);
}

TEST(LightTreeNarrow, BoundsOfPointsAndSpheresHold) { expectBoundsHold(Kinds::plain, false); }
TEST(LightTreeNarrow, BoundsOfHardLightsHold) { expectBoundsHold(Kinds::all, true); }

TEST(LightTreeNarrow, EveryLightIsThereOnce) {
  LightSet lights;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-100, 100);
  for (int i = 0; i < 500; ++i) lights.add(PointLight{{unit(random), unit(random), unit(random)}, {1, 1, 1}});
  lights.add(DirectionalLight{{0, -1, 0}, {1, 1, 1}});
  lights.add(PointLight{{1e16f, 0, 0}, {1, 1, 1}});
  LightTree tree;
  tree.build(lights);
  LightSelection region, object;
  tree.select({.centre = {5, 5, 5}, .radius = 20, .target = 0.1f, .everywhere = true}, region);
  tree.narrow(region, {.centre = {7, 5, 5}, .radius = 1, .target = 0.05f}, object);
  double whole = 0;
  bool directional = false, far = false;
  for (const auto* list : {&region.distant, &object.near, &object.distant}) {
    for (const LightUse& use : *list) {
      if (use.light == 0) directional = list == &region.distant && use.share == 1;
      if (use.light == 501) far = list == &object.near && use.share == 1;
      if (use.light == 0 || use.light == 501) continue;
      visitUse(lights, tree, use, [&](const auto& light) {
        double power = colourOf(light).r;
        if constexpr (requires { light.radiance; }) power *= M_PI * light.radius * light.radius;
        whole += use.share * power;
      });
    }
  }
  EXPECT_TRUE(directional);
  EXPECT_TRUE(far);
  EXPECT_NEAR(whole, 500, 1e-3);
  EXPECT_LT(object.near.size(), region.near.size());
}

}  // namespace
}  // namespace rigel::test
