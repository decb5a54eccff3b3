#include "gauss_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace rigel::test {
namespace {

std::vector<double> evenly(int count) {
  std::vector<double> points;
  for (int i = 0; i < count; ++i) points.push_back((2.0 * i + 1) / count - 1);
  return points;
}

double moment(std::span<const double> points, std::span<const double> weights, int power) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * std::pow(points[i], power);
  return sum;
}

TEST(GaussAxis, IsGaussLegendreForAnEvenSurface) {
  const GaussAxis two(evenly(1000), 2);
  EXPECT_NEAR(two.node[0], -1 / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(two.node[1], 1 / std::sqrt(3.0), 1e-5);
  const GaussAxis three(evenly(1000), 3);
  EXPECT_NEAR(three.node[2], std::sqrt(0.6), 1e-5);
  EXPECT_NEAR(three.weight[0], 5.0 / 18, 1e-5);
  EXPECT_NEAR(three.weight[1], 8.0 / 18, 1e-5);
}

TEST(GaussAxis, IntegratesTheMomentsOfItsMeasure) {
  // N nodes integrate degree 2N - 1 exactly; the measure is the surface's with a hundredth spread evenly.
  std::mt19937 random(3);
  std::normal_distribution<double> bump(0.3, 0.2);
  std::vector<double> points;
  for (int i = 0; i < 500; ++i) points.push_back(std::clamp(bump(random), -1.0, 1.0));
  const std::vector<double> share(points.size(), 0.99 / static_cast<double>(points.size()));
  const auto even = evenly(256);
  const std::vector<double> evenShare(even.size(), 0.01 / static_cast<double>(even.size()));
  for (int count = 1; count <= 16; ++count) {
    const GaussAxis axis(points, count);
    for (int power = 0; power < 2 * count; ++power) {
      const double expected = moment(points, share, power) + moment(even, evenShare, power);
      // Nodes are rounded to float: 6e-8 times the power, of values up to 1.
      EXPECT_NEAR(moment(axis.node, axis.weight, power), expected, 1e-6) << count << " nodes, power " << power;
    }
  }
}

TEST(GaussAxis, LagrangePolynomialsReproduceThePowersTheySpan) {
  for (int count : {1, 2, 3, 5, 8}) {
    const GaussAxis axis(evenly(300), count);
    std::vector<float> weights(count);
    for (float u = -1; u <= 1; u += 0.0625f) {
      axis.lagrange(u, weights);
      for (int power = 0; power < count; ++power) {
        double sum = 0;
        for (int i = 0; i < count; ++i) sum += static_cast<double>(weights[i]) * std::pow(axis.node[i], power);
        EXPECT_NEAR(sum, std::pow(static_cast<double>(u), power), 1e-5) << count << " nodes at " << u;
      }
    }
  }
}

TEST(GaussAxis, HasDistinctNodesWhateverTheSurface) {
  const std::vector<std::pair<std::string, std::vector<double>>> surfaces = {
      {"one point", {0.25}},
      {"both ends", {-1, 1}},
      {"flat", std::vector<double>(100, 0.0)},
      {"two tight clusters", {-0.5, -0.5 + 1e-12, -0.5 + 2e-12, 0.5, 0.5 + 1e-12}},
      {"beyond the box by rounding", {-1.0000001, 0, 1.0000001}}};
  for (const auto& [what, surface] : surfaces) {
    for (int count : {1, 2, 3, 8, 64}) {
      const GaussAxis axis(surface, count);
      ASSERT_EQ(static_cast<int>(axis.node.size()), count) << what;
      EXPECT_NEAR(std::accumulate(axis.weight.begin(), axis.weight.end(), 0.0), 1, 1e-9) << what;
      for (int i = 0; i < count; ++i) {
        EXPECT_GE(axis.node[i], -1 - 1e-6) << what;
        EXPECT_LE(axis.node[i], 1 + 1e-6) << what;
        if (i == 0) continue;
        EXPECT_GT(axis.node[i] - axis.node[i - 1], 5e-5) << what << ", " << count << " nodes";
      }
      std::vector<float> weights(count);
      axis.lagrange(0.1f, weights);
      float sum = 0;
      for (float w : weights) sum += w;
      EXPECT_TRUE(std::isfinite(sum)) << what << ", " << count << " nodes";
    }
  }
}

}  // namespace
}  // namespace rigel::test
