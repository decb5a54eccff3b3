#include <gtest/gtest.h>
#include <rigel/dominant_light.h>
#include <rigel/project.h>
#include <rigel/shader_constants.h>

#include <limits>

#include "lights/describe.h"
#include "lights/random.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Random;

constexpr double kDirectionTolerance = 3e-7;  // worst measured 1.4e-7
constexpr double kColourTolerance = 6e-7;     // relative; worst measured 3.4e-7

double distance(Vec3 a, Vec3 b) { return length(a - b); }

Vec3 scaledDirection(const DominantLight& light, int channel) { return light.direction * light.irradiance[channel]; }

template <int B>
void expectDirectionalLightsGivenBack() {
  Random random(301);
  Worst direction("direction of a directional light, " + std::to_string(B) + " bands");
  Worst colour("irradiance of a directional light, " + std::to_string(B) + " bands, relative");
  for (int k = 0; k < 20'000; ++k) {
    DirectionalLight light{random.direction(), random.colour() * static_cast<float>(random.logUniform(1e-20, 1e20))};
    if (random.index(3) == 0) light.irradiance[random.index(3)] = 0;
    const DominantLight dominant = dominantLight(project<B>(light, {}));
    const auto text = [&] { return describe(light); };
    direction.add(distance(dominant.direction, light.direction * -1.0f), text);
    for (int channel = 0; channel < 3; ++channel) {
      const double expected = light.irradiance[channel];
      const double error = std::abs(static_cast<double>(dominant.irradiance[channel]) - expected);
      colour.add(expected == 0 ? error : error / expected, text);
    }
  }
  direction.expectWithin(kDirectionTolerance);
  colour.expectWithin(kColourTolerance);
}

TEST(DominantLight, GivesASingleDirectionalLightBack) {
  expectDirectionalLightsGivenBack<2>();
  expectDirectionalLightsGivenBack<3>();
  expectDirectionalLightsGivenBack<5>();
}

TEST(DominantLight, OfASphereIsItsIrradianceAtNormalIncidence) {
  const SphereLight sphere{{3, 4, 0}, 2, {1, 2, 4}};
  const DominantLight dominant = dominantLight(project<3>(sphere, {}));
  EXPECT_LT(distance(dominant.direction, {0.6f, 0.8f, 0}), 1e-6);
  const double expected = kPi * 4 / 25;  // pi L (r/d)^2
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(dominant.irradiance[channel] / sphere.radiance[channel], expected, 1e-6 * expected);
  }
}

TEST(DominantLight, OfManyLightsIsTheirVectorIrradiance) {
  Random random(302);
  for (int k = 0; k < 100; ++k) {
    RadianceSH<3> sh;
    Vec3 sum;
    for (int i = 0; i < 5; ++i) {
      const DirectionalLight light{random.direction(), Rgb{1, 1, 1} * random.uniformf(0.1, 2)};
      sh += project<3>(light, {});
      sum += light.direction * -light.irradiance.r;
    }
    const DominantLight dominant = dominantLight(sh);
    EXPECT_LT(distance(scaledDirection(dominant, 1), sum), 1e-5);
  }
}

TEST(DominantLight, NothingComesFromUniformLightNoLightOrNan) {
  RadianceSH<3> sh;
  EXPECT_EQ(dominantLight(sh).irradiance, Rgb{});
  EXPECT_EQ(dominantLight(sh).direction, (Vec3{0, 1, 0}));
  sh[0] = {5, 5, 5};
  EXPECT_EQ(dominantLight(sh).irradiance, Rgb{});
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    RadianceSH<3> broken;
    broken[1] = {1, 1, 1};
    broken[3].b = bad;
    EXPECT_EQ(dominantLight(broken).irradiance, Rgb{});
    EXPECT_EQ(dominantLight(broken).direction, (Vec3{0, 1, 0}));
  }
}

TEST(DominantLight, NeverNegativeAndAlwaysFinite) {
  Random random(303);
  for (int k = 0; k < 10'000; ++k) {
    RadianceSH<2> sh;
    const float scale = static_cast<float>(random.logUniform(1e-37, 1e37));
    for (int i = 0; i < 4; ++i)
      sh[i] = {random.uniformf(-1, 1) * scale, random.uniformf(-1, 1) * scale, random.uniformf(-1, 1) * scale};
    const DominantLight light = dominantLight(sh);
    EXPECT_NEAR(length(light.direction), 1, 1e-6);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_TRUE(light.irradiance[channel] >= 0 && std::isfinite(light.irradiance[channel]));
    }
  }
}

/// The largest change of direction times irradiance in one of `steps` steps along the path: lights of different colours
/// from opposite sides, one fading as the other grows, so that the luminance's vector passes through 0 (at offset 0) or
/// close to it while no channel's does.
double largestStep(int steps, float offset) {
  const Vec3 left{-1, 0, 0}, right{1, 0, 0};
  double worst = 0;
  Vec3 last[3];
  for (int i = 0; i <= steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(steps);
    // Equal luminance.
    const Rgb red = Rgb{1 / static_cast<float>(kRigelLuminanceR), 0, 0} * share;
    const Rgb green = Rgb{0, 1 / static_cast<float>(kRigelLuminanceG), 0} * (1 - share);
    RadianceSH<3> sh = project<3>(DirectionalLight{left, red}, {});
    sh += project<3>(DirectionalLight{right, green}, {});
    sh += project<3>(DirectionalLight{{0, -1, 0}, Rgb{1, 1, 1} * offset}, {});
    const DominantLight light = dominantLight(sh);
    for (int channel = 0; channel < 3; ++channel) {
      const Vec3 now = scaledDirection(light, channel);
      if (i > 0) worst = std::max(worst, distance(now, last[channel]));
      last[channel] = now;
    }
  }
  return worst;
}

TEST(DominantLight, IsContinuousWhereColoursCancel) {
  // A jump would not shrink with the steps.
  for (const float offset : {0.0f, 1e-4f, 0.1f}) {
    const double coarse = largestStep(100, offset);
    const double fine = largestStep(1600, offset);
    EXPECT_GT(coarse, 0);
    EXPECT_LT(fine, coarse / 8) << "offset " << offset;
  }
}

}  // namespace
}  // namespace rigel
