#include "falloff.h"

#include "rig_fixture.h"

namespace rigel::test {
namespace {

/// Points on the faces of a cube. (On a sphere |u|^2 is constant, and light there does not say what q is inside.)
std::vector<Vec3> cube() {
  std::vector<Vec3> points = ellipsoid({}, {1, 1, 1}, 24);
  for (Vec3& p : points) p = p * (1 / std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
  return points;
}

struct Samples {
  std::vector<Vec3> u = cube();
  std::vector<float> weight = std::vector<float>(24, 1.0f / 24);
  std::vector<double> strength = std::vector<double>(24, 0.0);

  void addLight(Vec3 at, double intensity) {
    for (std::size_t s = 0; s < u.size(); ++s) {
      const auto d = static_cast<double>(length(u[s] - at));
      strength[s] += intensity / std::max(d * d, 1e-12);
    }
  }
  Falloff fitted() const {
    Falloff falloff;
    falloff.fit(u, weight, strength);
    return falloff;
  }
};

/// Least of q relative to its largest coefficient, over a grid of the box with its corners.
float leastIn(const Falloff& falloff) {
  float size = 0;
  for (float c : falloff.coefficients()) size = std::max(size, std::abs(c));
  float least = std::numeric_limits<float>::max();
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      for (int z = -8; z <= 8; ++z)
        least =
            std::min(least, falloff({static_cast<float>(x) / 8, static_cast<float>(y) / 8, static_cast<float>(z) / 8}));
  return least / size;
}

TEST(Falloff, OfOneLightIsItsSquaredDistance) {
  const Vec3 at{2, 0.5f, -0.5f};
  Samples samples;
  samples.addLight(at, 7);
  const Falloff falloff = samples.fitted();
  const float scale = falloff(samples.u[0]) / dot(samples.u[0] - at, samples.u[0] - at);
  for (Vec3 p : samples.u) EXPECT_NEAR(falloff(p) / (scale * dot(p - at, p - at)), 1, 0.05f);  // the pull; worst 0.02
}

TEST(Falloff, IsConstantForConstantLightAndForNone) {
  Samples samples;
  EXPECT_EQ(samples.fitted().coefficients(), Falloff().coefficients());
  samples.strength.assign(24, 5.0);
  const Falloff falloff = samples.fitted();
  for (Vec3 p : samples.u)
    EXPECT_NEAR(falloff(p) / falloff(samples.u[0]), 1, 5e-4f);  // kLeast and kLeastStrength; worst 8e-5
  samples.strength[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(samples.fitted().coefficients(), Falloff().coefficients());
  samples.strength[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(samples.fitted().coefficients(), Falloff().coefficients());
}

TEST(Falloff, IsPositiveInTheBoxWhateverTheLight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  float worst = 1;
  for (int trial = 0; trial < 400; ++trial) {
    Samples samples;
    switch (trial % 4) {
      case 0:  // nothing to do with a falloff
        for (double& g : samples.strength) g = std::pow(10, 12 * unit(random) - 6);
        break;
      case 1:  // one sample alone
        samples.strength[static_cast<std::size_t>(trial) % 24] = 1e30 * unit(random);
        break;
      case 2:  // both ends, concave in between
        samples.addLight({1.2f, 0, 0}, 1);
        samples.addLight({-1.2f, 0, 0}, unit(random));
        break;
      default:  // anywhere, one on the surface
        samples.addLight(samples.u[static_cast<std::size_t>(trial) % 24], 1e-3);
        samples.addLight({static_cast<float>(4 * unit(random)), 2, 0}, 1);
    }
    const float least = leastIn(samples.fitted());
    EXPECT_GT(least, 0) << "trial " << trial;
    worst = std::min(worst, least);
  }
  RecordProperty("least", std::to_string(worst));
}

TEST(Falloff, IsContinuousWhenALightPassesThrough) {
  // From far off through the body to far off, in steps of a thousandth of its half extent.
  float worst = 0;
  Falloff before;
  for (int step = 0; step <= 6000; ++step) {
    Samples samples;
    samples.addLight({0, 0, 3}, 1);
    const Vec3 at{static_cast<float>(step) / 1000 - 3, 0.05f, 0.02f};
    for (std::size_t s = 0; s < 24; ++s) {  // as a light of radius 0.2 is seen by patches
      const auto d = static_cast<double>(length(samples.u[s] - at));
      samples.strength[s] += 1 / std::max(d * d, 0.04);
    }
    const Falloff now = samples.fitted();
    if (step > 0)
      for (Vec3 p : samples.u) worst = std::max(worst, std::abs(std::log(now(p) / before(p))));
    before = now;
  }
  EXPECT_LT(worst, 0.05f);
}

}  // namespace
}  // namespace rigel::test
