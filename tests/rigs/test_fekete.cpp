#include "fekete.h"

#include "monomials.h"
#include "rig_fixture.h"

#include <Eigen/QR>

#include <numeric>
#include <set>

namespace rigel::test {
namespace {

const std::vector<Vec3> kBody = ellipsoid({1, 2, 3}, {2, 0.5f, 0.7f}, 500);

/// A row of monomials of (p - mean)/(3 sigma_max) for every point.
Eigen::MatrixXd vandermonde(const std::vector<Vec3>& surface, int functions) {
  const SurfaceSpread spread = spreadOf(surface);
  const std::vector<Exponents> order = monomialOrder(spread, functions);
  Eigen::MatrixXd rows(surface.size(), functions);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    for (int k = 0; k < functions; ++k) {
      double product = 1;
      for (int a = 0; a < 3; ++a) {
        const double u = (static_cast<double>(surface[i][a]) - spread.mean[a]) / (3 * spread.largest());
        for (int e = 0; e < order[k][a]; ++e) product *= u;
      }
      rows(static_cast<Eigen::Index>(i), k) = product;
    }
  }
  return rows;
}

TEST(Fekete, EachPointIsTheFarthestFromTheSpanOfThoseBefore) {
  constexpr int kCount = 24;
  const std::vector<int> points = feketePoints(kBody, kCount);
  ASSERT_EQ(static_cast<int>(points.size()), kCount);
  const Eigen::MatrixXd rows = vandermonde(kBody, 2 * kCount);
  for (int n = 0; n < kCount; ++n) {
    // Distances from an orthonormal basis of the rows before, found anew.
    Eigen::MatrixXd before(2 * kCount, n);
    for (int s = 0; s < n; ++s) before.col(s) = rows.row(points[s]).transpose();
    Eigen::MatrixXd rest = rows.transpose();
    if (n > 0) {
      const Eigen::MatrixXd q =
          Eigen::HouseholderQR<Eigen::MatrixXd>(before).householderQ() * Eigen::MatrixXd::Identity(2 * kCount, n);
      rest -= q * (q.transpose() * rest).eval();
    }
    const Eigen::VectorXd distances = rest.colwise().norm();
    // Rounding of two ways to the same distance; worst measured 1e-12 of it.
    EXPECT_GE(distances(points[n]), distances.maxCoeff() * (1 - 1e-9)) << n;
  }
}

TEST(Fekete, AnchorsAreDistinctAndShareTheSurface) {
  for (const int count : {1, 2, 12, 24, 112}) {
    const Anchors anchors = feketeAnchors(kBody, count);
    ASSERT_EQ(static_cast<int>(anchors.index.size()), count);
    EXPECT_EQ(std::set<int>(anchors.index.begin(), anchors.index.end()).size(), anchors.index.size());
    EXPECT_NEAR(std::accumulate(anchors.share.begin(), anchors.share.end(), 0.0f), 1, 1e-6f);
    // Patches are those of the nearest anchor.
    std::vector<int> population(anchors.index.size());
    for (Vec3 p : kBody) {
      const auto nearest = std::ranges::min_element(anchors.index, {}, [&](int i) { return length(p - kBody[i]); });
      ++population[static_cast<std::size_t>(nearest - anchors.index.begin())];
    }
    for (std::size_t a = 0; a < population.size(); ++a) {
      EXPECT_NEAR(anchors.share[a] * 500, population[a], 1.01);  // one point may be as near to two
      EXPECT_GT(anchors.radius[a], 0);
    }
  }
}

TEST(Fekete, TakesTheGivenPointsFirst) {
  const std::vector<int> ends = endsOf(kBody, 6);
  const Anchors anchors = feketeAnchors(kBody, 16, SurfaceEnds::anchored);
  ASSERT_EQ(ends.size(), 6u);
  EXPECT_TRUE(std::equal(ends.begin(), ends.end(), anchors.index.begin()));
  EXPECT_EQ(anchors.index.size(), 16u);
}

TEST(Fekete, StopsWhereTheSurfaceTellsNoMorePointsApart) {
  EXPECT_EQ(feketePoints(std::vector<Vec3>(40, Vec3{1, 1, 1}), 8).size(), 1u);
  // Along a line there is one monomial a degree, and the highest degree is 16.
  std::vector<Vec3> line;
  for (int i = 0; i < 200; ++i) line.push_back({0.01f * static_cast<float>(i), 0, 0});
  EXPECT_EQ(feketePoints(line, 12).size(), 12u);
  const std::size_t most = feketePoints(line, 40).size();
  EXPECT_LE(most, 17u);
  EXPECT_GE(most, 12u);
}

}  // namespace
}  // namespace rigel::test
