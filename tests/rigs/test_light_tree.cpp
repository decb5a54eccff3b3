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
      tally.uses += static_cast<long>(selection.nearby.size() + selection.distant.size());
      tally.distant += static_cast<long>(selection.distant.size());
      for (const auto* list : {&selection.nearby, &selection.distant})
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

/// RMS over the normals of bands of irradiance.
double rms(double e0, double e1, double e2) { return std::sqrt(e0 * e0 + e1 * e1 / 3 + e2 * e2 / 5); }

/// Irradiance at the origin from a point of power 1 at p, towards the normal n.
double pointIrradiance(const std::array<float, 3>& f, const std::array<double, 3>& p, const std::array<double, 3>& n) {
  const double d2 = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  const double x = (p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / std::sqrt(d2);
  return (0.25 * f[0] + 0.75 * f[1] * x + 1.25 * f[2] * (1.5 * x * x - 0.5)) / d2;
}

// What the bound is made of: kSphereMoment of light_tree_source.cpp, and 6 N/d^4.
TEST(LightTree, SpheresDifferFromPointsAsTheirMomentSays) {
  double worst = 0;
  for (const float wrap : {-0.25f, 0.0f, 0.5f, 1.0f}) {
    const std::array<float, 3> f = wrapCoefficients<3>(wrap);
    const double point = rms(0.25 * f[0], 0.75 * f[1], 1.25 * f[2]);
    for (int i = 1; i <= 50; ++i) {
      const double sine = 0.01 * i, c = std::sqrt(1 - sine * sine);
      const double error = rms(0.5 * f[0] * (1 / (1 + c) - 0.5), 0, 1.25 * f[2] * (c - 1));
      worst = std::max(worst, error / (sine * sine * point));
    }
  }
  EXPECT_LT(worst, 0.3);
  EXPECT_GT(worst, 0.2);
}

TEST(LightTree, LightBendsBySixRadiallyAtMost) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const float wrap : {-0.25f, 0.0f, 0.5f, 1.0f}) {
    const std::array<float, 3> f = wrapCoefficients<3>(wrap);
    const double point = rms(0.25 * f[0], 0.75 * f[1], 1.25 * f[2]), peak = 0.25 * f[0] + 0.75 * f[1] + 1.25 * f[2];
    double bent = 0, bentPeak = 0;
    for (int k = 0; k <= 90; ++k) {
      const double angle = k * M_PI / 180, h = 1e-3;
      const auto at = [&](double s) { return std::array<double, 3>{s * std::sin(angle), 0, 1 + s * std::cos(angle)}; };
      double square = 0;
      constexpr int kNormals = 400;
      for (int i = 0; i < kNormals; ++i) {
        const double z = 1 - (2 * i + 1.0) / kNormals, phi = i * 2.399963229728653, s = std::sqrt(1 - z * z);
        const std::array<double, 3> n{s * std::cos(phi), s * std::sin(phi), z};
        const double second =
            (pointIrradiance(f, at(h), n) - 2 * pointIrradiance(f, at(0), n) + pointIrradiance(f, at(-h), n)) / (h * h);
        square += second * second / kNormals;
        bentPeak = std::max(bentPeak, std::abs(second));
      }
      bent = std::max(bent, std::sqrt(square));
    }
    // Finite differences and the normals' grid.
    EXPECT_NEAR(bent / point, 6, 0.01) << wrap;
    EXPECT_LT(bentPeak / peak, 6.001) << wrap;
  }
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
