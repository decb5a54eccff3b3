// Selections of the light tree against double sums over all lights: their bounds hold, and targets are met.
#include <gtest/gtest.h>

#include "light_tree_truth.h"
#include "random_light_cloud.h"

#include <cstdlib>

namespace rigel::test {
namespace {

using Kinds = RandomLightCloud::Kinds;

int rounds(int quick, int full) { return std::getenv("RIGEL_FULL") != nullptr ? full : quick; }

LightQuery randomQuery(RandomLightCloud& cloud, float size) {
  LightQuery query;
  query.centre = cloud.direction() * static_cast<float>(size * cloud.logUniform(0.01, 30));
  query.radius = static_cast<float>(size * cloud.logUniform(1e-4, 0.3));
  if (cloud.chance(0.1)) query.radius = 0;
  if (cloud.chance(0.05)) query.centre = {};
  query.target = static_cast<float>(cloud.logUniform(0.002, 1));
  query.slopeShare = cloud.chance(0.7) ? static_cast<float>(cloud.uniform(0, 1)) : 0;
  query.everywhere = cloud.chance(0.3);
  const float wraps[] = {0, 0, 0.5f, 1, -0.25f};
  query.wrap = wraps[cloud.below(5)];
  return query;
}

struct Tally {
  double rms = 0, peak = 0, target = 0, mean = 0;
  long uses = 0, lights = 0, clusters = 0, distant = 0, cases = 0;
};

void expectBoundsHold(Kinds kinds, bool hard, int clouds, Tally& tally) {
  RandomLightCloud random(hard ? 11 : 5);
  for (int i = 0; i < clouds; ++i) {
    const auto size = static_cast<float>(random.logUniform(0.1, 1000));
    const LightSet lights = random.cloud(1 + random.below(300), size, kinds, hard);
    LightTree tree;
    tree.build(lights);
    LightSelection selection;
    for (int j = 0; j < 4; ++j) {
      const LightQuery query = randomQuery(random, size);
      tree.select(query, selection);
      const SelectionError error = errorOf(lights, tree, query, selection, random.random());
      ASSERT_LE(error.rms, 1) << "cloud " << i << " query " << j;
      ASSERT_LE(error.peak, 1) << "cloud " << i << " query " << j;
      ASSERT_LE(selection.bound, query.target * selection.reference * 1.0001f) << "cloud " << i << " query " << j;
      ASSERT_LE(selection.mean, error.mean * (1 + kProjectionRounding)) << "cloud " << i << " query " << j;
      tally.rms = std::max(tally.rms, error.rms);
      tally.peak = std::max(tally.peak, error.peak);
      if (selection.reference > 0)
        tally.target = std::max(tally.target, double{selection.bound / (query.target * selection.reference)});
      if (error.mean > 0) tally.mean += selection.mean / error.mean;
      ++tally.cases;
      tally.lights += lights.size();
      tally.uses += static_cast<long>(selection.near.size() + selection.distant.size());
      tally.distant += static_cast<long>(selection.distant.size());
      for (const auto* list : {&selection.near, &selection.distant})
        for (const LightUse& use : *list) tally.clusters += use.light >= static_cast<std::uint32_t>(lights.size());
    }
  }
  // Or nothing has been tested.
  EXPECT_GT(tally.clusters, tally.cases);
  EXPECT_GT(tally.distant, tally.cases);
  EXPECT_LT(tally.uses, tally.lights);
  std::printf(
      "worst error/bound %.3f (peak %.3f), bound/target up to %.3f, mean %.3f of the true one; %ld lights, %ld "
      "uses, %ld of them clusters\n",
      tally.rms, tally.peak, tally.target, tally.mean / static_cast<double>(tally.cases), tally.lights, tally.uses,
      tally.clusters);
}

TEST(LightTree, BoundsOfPointsAndSpheresHold) {
  Tally tally;
  expectBoundsHold(Kinds::plain, false, rounds(30, 1000), tally);
}

TEST(LightTree, BoundsOfAllKindsHold) {
  Tally tally;
  expectBoundsHold(Kinds::all, false, rounds(30, 1000), tally);
}

TEST(LightTree, BoundsOfHardLightsHold) {
  Tally tally;
  expectBoundsHold(Kinds::all, true, rounds(30, 1000), tally);
}

}  // namespace
}  // namespace rigel::test
