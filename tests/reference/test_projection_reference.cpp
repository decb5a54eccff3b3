#include <gtest/gtest.h>

#include "reference/cap_quadrature.h"
#include "reference/projection_reference.h"
#include "reference/sh_reference.h"
#include "reference/worst.h"

namespace rigel::reference {
namespace {

constexpr int kBands = 5;
constexpr double kQuadratureTolerance = 5e-14;  // of band 0; double rounding of 2560 nodes

/// SH of radiance 1 from the directions within `alpha` of `axis`, by quadrature.
std::vector<double> projectByQuadrature(const Direction& axis, double alpha) {
  std::vector<double> q(kBands * kBands);
  for (const CapNode& node : capNodes(axis, alpha)) {
    const Vec50 w{Real50(node.direction.x), Real50(node.direction.y), Real50(node.direction.z)};
    int i = 0;
    for (int l = 0; l < kBands; ++l) {
      for (int m = -l; m <= l; ++m) q[i++] += node.solidAngle * static_cast<double>(shReference(l, m, w));
    }
  }
  return q;
}

// The closed formula against the integral it solves: small, large, grazing and enclosing spheres.
TEST(ProjectionReference, SphereMatchesQuadratureOfItsCap) {
  const Vec3 centre{2, 3, 6};  // distance 7
  Worst worst("closed formula against quadrature, relative to band 0");
  for (const float radius : {0.001f, 0.5f, 3.0f, 6.5f, 7.0f, 7.5f, 20.0f, 1000.0f}) {
    const double s = radius <= 7 ? radius / 7.0 : 7.0 / radius;
    const double alpha = radius <= 7 ? std::asin(s) : M_PI - std::asin(s);
    const std::vector<double> expected = projectByQuadrature({2.0 / 7, 3.0 / 7, 6.0 / 7}, alpha);
    const Coefficients50 q = projectReference(SphereLight{centre, radius, {1, 1, 1}}, exactly({0, 0, 0}), kBands);
    ASSERT_EQ(q.size(), expected.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
      const auto actual = static_cast<double>(q[i]);
      worst.add(std::abs(actual - expected[i]) / expected[0], [&] {
        return "radius " + std::to_string(radius) + ", coefficient " + std::to_string(i) + ": " +
               std::to_string(actual) + ", expected " + std::to_string(expected[i]);
      });
    }
  }
  worst.expectWithin(kQuadratureTolerance);
}

TEST(ProjectionReference, PointGivesItsIntensityOverDistanceSquared) {
  // Band 1 is the vector irradiance: sqrt(4pi/3) |q1| = I/d^2 for every radius below d.
  for (const float radius : {0.0f, 0.01f, 1.0f, 6.9f}) {
    const Coefficients50 q = projectReference(PointLight{{2, 3, 6}, {1, 1, 1}, radius}, exactly({0, 0, 0}), 2);
    const Real50 irradiance = sqrt(4 * pi50() / 3 * (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]));
    EXPECT_LT(abs(irradiance * 49 - 1), Real50("1e-34")) << "radius " << radius;
  }
}

TEST(ProjectionReference, SpotIsThePointTimesSmoothstep) {
  SpotLight spot{{0, 2, 0}, {0, -1, 0}, {1, 1, 1}, 0.25f, 0.75f};
  const PointLight point{spot.position, spot.intensity, spot.radius};
  const auto share = [&](Vec3 p) {
    return static_cast<double>(projectReference(spot, exactly(p), 2)[0] / projectReference(point, exactly(p), 2)[0]);
  };
  EXPECT_DOUBLE_EQ(share({0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(share({0.4f, 0, 0}), 1);  // 0.197 rad
  EXPECT_DOUBLE_EQ(share({2, 0, 0}), 0);     // 0.785 rad
  const double cosine = 2 / std::hypot(1.0, 2.0);
  const double t = (cosine - std::cos(0.75)) / (std::cos(0.25) - std::cos(0.75));
  EXPECT_NEAR(share({1, 0, 0}), t * t * (3 - 2 * t), 1e-15);
}

TEST(ProjectionReference, WindowFallsToZeroAtTheRange) {
  const auto share = [](float range) {
    const Vec50 p = exactly({0, 0, 0});
    return static_cast<double>(projectReference(PointLight{{3, 0, 4}, {1, 1, 1}, 0.01f, range}, p, 2)[0] /
                               projectReference(PointLight{{3, 0, 4}, {1, 1, 1}, 0.01f}, p, 2)[0]);
  };
  EXPECT_NEAR(share(10), (1 - 1.0 / 16) * (1 - 1.0 / 16), 1e-15);
  EXPECT_EQ(share(5), 0);
  EXPECT_EQ(share(4), 0);
}

// Against a derivative known in closed form: band 0 of a sphere, 2 pi (1 - sqrt(1-r^2/d^2)) sqrt(1/4pi).
TEST(ProjectionReference, DifferencesGiveTheDerivative) {
  const SphereLight light{{0, 0, 5}, 3, {1, 1, 1}};
  const Coefficients50 slope = differentiateReference(light, exactly({0, 0, 0}), 2, 2, Real50(5));
  // d/dp_z = -d/dd of it: 2 pi sqrt(1/4pi) r^2/(d^3 c), c = 4/5
  const Real50 expected = 2 * pi50() * sqrt(1 / (4 * pi50())) * 9 / (125 * Real50("0.8"));
  EXPECT_LT(abs(slope[0] / expected - 1), Real50("1e-26"));
}

}  // namespace
}  // namespace rigel::reference
