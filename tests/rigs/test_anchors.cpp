#include "anchors.h"

#include "rig_fixture.h"

#include <numeric>
#include <set>

namespace rigel::test {
namespace {

TEST(Anchors, AreDistinctPointsOfTheSurfaceWithSharesThatSumToOne) {
  const auto surface = ellipsoid({1, 2, 3}, {2, 0.5f, 0.25f}, 500);
  for (int count : {1, 2, 12, 24, 128}) {
    const Anchors anchors = chooseAnchors(surface, count);
    ASSERT_EQ(static_cast<int>(anchors.index.size()), count);
    EXPECT_EQ(std::set<int>(anchors.index.begin(), anchors.index.end()).size(), anchors.index.size());
    EXPECT_NEAR(std::accumulate(anchors.share.begin(), anchors.share.end(), 0.0f), 1, 1e-6f);
    for (float share : anchors.share) EXPECT_GT(share, 0);
  }
}

TEST(Anchors, CoverTheSurface) {
  // Sixteen clusters of a sphere: no point farther from its anchor than about the radius of a sixteenth of its area
  // (0.5), here with slack 1.6.
  const auto surface = ellipsoid({}, {1, 1, 1}, 1000);
  const Anchors anchors = chooseAnchors(surface, 16);
  float worst = 0;
  for (Vec3 p : surface) {
    float nearest = 10;
    for (int i : anchors.index) nearest = std::min(nearest, length(p - surface[i]));
    worst = std::max(worst, nearest);
  }
  EXPECT_LT(worst, 0.8f);
}

TEST(Anchors, TakeEveryPointOfASmallSurface) {
  const auto surface = ellipsoid({}, {1, 1, 1}, 5);
  EXPECT_EQ(chooseAnchors(surface, 12).index.size(), 5u);
}

TEST(Anchors, CoincidentPointsLeaveNoEmptyCluster) {
  const std::vector<Vec3> surface(40, Vec3{1, 1, 1});
  const Anchors anchors = chooseAnchors(surface, 8);
  ASSERT_EQ(anchors.index.size(), 1u);
  EXPECT_FLOAT_EQ(anchors.share[0], 1);
}

}  // namespace
}  // namespace rigel::test
