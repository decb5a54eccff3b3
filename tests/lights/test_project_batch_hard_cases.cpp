// Finite input of any kind gives finite output in vectors, too, and what is nowhere gives no light.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rigel/project_batch.h>

#include <bit>
#include <cmath>
#include <limits>

#include "lights/batch_points.h"
#include "lights/describe.h"
#include "lights/every_target.h"
#include "lights/random.h"

namespace rigel {
namespace {

using test::BatchPoints;
using test::describe;
using test::onEveryTarget;
using test::Random;

constexpr float kLargest = std::numeric_limits<float>::max();
constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();

float hardValue(Random& random) {
  switch (random.index(7)) {
    case 0:
      return 0;
    case 1:
      return random.index(2) == 0 ? kLargest : -kLargest;
    case 2:
      return std::numeric_limits<float>::denorm_min() * static_cast<float>(random.index(100));
    case 3:
      return static_cast<float>(random.logUniform(1e-37, 1e37)) * (random.index(2) == 0 ? 1.0f : -1.0f);
    default:
      return random.uniformf(-10, 10);
  }
}

Vec3 hardVector(Random& random) { return {hardValue(random), hardValue(random), hardValue(random)}; }

void addHardLight(Random& random, Vec3 receiver, LightSet& lights) {
  const auto scale = static_cast<float>(random.logUniform(1e-30, 1e30));
  Vec3 centre = hardVector(random);
  if (random.index(3) == 0) centre = receiver;
  if (random.index(3) == 0) centre = random.direction() * scale;
  const float radius =
      random.index(2) == 0 ? hardValue(random) : length(centre + receiver * -1) * random.uniformf(0, 2);
  const Rgb colour{hardValue(random), hardValue(random), 1};
  const float range = random.index(2) == 0 ? kNoRange : hardValue(random);
  const Vec3 axis = random.index(2) == 0 ? hardVector(random) : random.direction();
  switch (random.index(5)) {
    case 0:
      return lights.add(DirectionalLight{axis, colour});
    case 1:
      return lights.add(PointLight{centre, colour, radius, range});
    case 2:
      return lights.add(SpotLight{centre, axis, colour, random.uniformf(0, 3), random.uniformf(0, 3), radius, range});
    case 3:
      return lights.add(SphereLight{centre, radius, colour});
    default:
      return lights.add(DiskLight{centre, axis, radius, colour, random.index(2) == 0});
  }
}

TEST(ProjectBatchHardCases, StayFinite) {
  onEveryTarget([] {
    Random random(81);
    int failures = 0;
    for (int k = 0; k < (test::fullRun() ? 200'000 : 4'000) && failures < 3; ++k) {
      BatchPoints points;
      std::vector<float> footprints;
      for (int i = 0; i < 20; ++i) {
        points.add(hardVector(random));
        footprints.push_back(std::abs(hardValue(random)));
      }
      LightSet lights;
      for (int i = 0; i < 4; ++i) addHardLight(random, points[static_cast<std::size_t>(random.index(20))], lights);
      const auto sums = test::sumsOf<5>(lights, points, k % 2 == 0 ? footprints : std::vector<float>());
      const bool finite = std::ranges::all_of(sums, [](float x) { return std::isfinite(x); });
      EXPECT_TRUE(finite) << lights.visit(0, [](const auto& light) { return describe(light); });
      failures += finite ? 0 : 1;
    }
  });
}

// A hundred thousand lights at the limit.
TEST(ProjectBatchHardCases, SumsAtTheLimitStayFinite) {
  PreparedLights prepared;
  LightSet set;
  set.add(SphereLight{{1, 0, 0}, 1, {kLargest, kLargest, kLargest}});
  set.add(PointLight{{1, 0, 0}, {kLargest, kLargest, kLargest}});
  prepared.set(set);
  BatchPoints points;
  for (const float x : {0.0f, 1.0f, 0.5f, 1.0001f, -3.0f}) points.add({x, 0, 0});
  std::vector<LightUse> uses;
  for (std::uint32_t i = 0; i < 100'000; ++i) uses.push_back({i % 2, 1});
  onEveryTarget([&] {
    std::vector<float> sums(27 * points.size());
    projectBatch<3>(prepared, uses, points.rows(), {}, sums);
    for (const float sum : sums) EXPECT_TRUE(std::isfinite(sum));
  });
}

// Lights so bright that they are beyond float where they are still seen as small (`extreme`): from where they are held
// to where float does, as the scalar functions have them.
TEST(ProjectBatchHardCases, ExtremelyBrightLightsAgreeWithScalars) {
  onEveryTarget([] {
    Random random(83);
    constexpr double kTolerance = 1e-6;
    double worst = 0;
    int extreme = 0;
    for (int k = 0; k < (test::fullRun() ? 20'000 : 1'000); ++k) {
      const auto brightness = static_cast<float>(random.logUniform(1e10, 1e30));
      const Rgb colour{brightness, brightness, brightness};  // vectors hold colours as one, scalars each channel
      // Where a light of this brightness reaches what it is held to.
      const double held = std::sqrt(2 * static_cast<double>(brightness) / static_cast<double>(kMaxProjectionScale));
      const auto radius = static_cast<float>(held * random.logUniform(1e-6, 1));
      LightSet lights;
      if (k % 3 == 0) lights.add(PointLight{{}, colour, radius});
      if (k % 3 == 1) lights.add(SpotLight{{}, {0, -1, 0}, colour, 1.7f, 2, radius});
      if (k % 3 == 2) lights.add(SphereLight{{}, radius, colour});
      PreparedLights prepared;
      prepared.set(lights);
      extreme += prepared[0].extreme ? 1 : 0;
      BatchPoints points;
      for (int i = 0; i < 20; ++i) {
        Vec3 below = random.direction();  // all of it in the full light of the spots
        below.y = -std::abs(below.y);
        points.add(below * static_cast<float>(held * random.logUniform(1e-3, 1e3)));
      }
      const std::vector<float> sums = test::sumsOf<3>(lights, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const RadianceSH<3> expected = project<3>(lights, points[i]);
        const RadianceSH<3> computed = test::shAt<3>(sums, points.size(), i);
        double square = 0, norm = 0;
        for (int n = 0; n < 27; ++n) {
          square += std::pow(double{computed.data()[n]} - double{expected.data()[n]}, 2);
          norm += std::pow(double{expected.data()[n]}, 2);
        }
        const double difference = std::sqrt(square / norm);
        worst = std::max(worst, difference);
        ASSERT_LT(difference, kTolerance)
            << lights.visit(0, [](const auto& light) { return describe(light); }) << " at " << describe(points[i]);
      }
    }
    EXPECT_GT(extreme, 300) << "no light was extreme";
    testing::Test::RecordProperty("worst_1e_9", static_cast<int>(1e9 * worst));
  });
}

TEST(ProjectBatchHardCases, NoLightFromWhatIsNowhere) {
  onEveryTarget([] {
    BatchPoints nowhere;
    for (const float x : {kInf, -kInf, kNan})
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 p{0.1f, 0.2f, 0.3f};
        p[axis] = x;
        nowhere.add(p);
      }
    LightSet lights;
    lights.add(PointLight{{1, 2, 3}, {1, 1, 1}, 0.1f, 10});
    lights.add(SpotLight{{1, 2, 3}, {-1, -2, -3}, {1, 1, 1}});
    lights.add(SphereLight{{1, 2, 3}, 1, {1, 1, 1}});
    lights.add(DiskLight{{1, 2, 3}, {0, -1, 0}, 1, {1, 1, 1}, true});
    EXPECT_THAT(test::sumsOf<5>(lights, nowhere), testing::Each(0.0f));

    BatchPoints points;
    for (int i = 0; i < 20; ++i) points.add({0.1f * static_cast<float>(i), 0, 0});
    LightSet dark;
    const Rgb white{1, 1, 1};
    dark.add(DirectionalLight{{}, white});
    dark.add(DirectionalLight{{0, kNan, 0}, white});
    dark.add(PointLight{{kNan, 0, 0}, white});
    dark.add(PointLight{{0, 1, 0}, {kNan, 1, 1}});
    dark.add(PointLight{{0, 1, 0}, white, 0.1f, 0});
    dark.add(PointLight{{0, 1, 0}, white, 0.1f, kNan});
    dark.add(PointLight{{0, kInf, 0}, white});
    dark.add(SpotLight{{0, 1, 0}, {}, white});
    dark.add(SpotLight{{0, 1, 0}, {0, -1, 0}, white, kNan});
    dark.add(SpotLight{{0, 1, 0}, {0, -1, 0}, white, 0, kInf});
    dark.add(SpotLight{{0, 1, 0}, {0, 1, 0}, white, 0.1f, 0.2f});
    dark.add(SphereLight{{0, 1, 0}, 0, white});
    dark.add(SphereLight{{0, 1, 0}, kNan, white});
    dark.add(SphereLight{{0, kInf, 0}, 1, white});
    dark.add(DiskLight{{0, 1, 0}, {}, 1, white});
    EXPECT_THAT(test::sumsOf<3>(dark, points), testing::Each(0.0f));

    LightSet bright;
    bright.add(SphereLight{{0, 1, 0}, 0.5f, white});
    PreparedLights prepared;
    prepared.set(bright);
    for (const float share : {0.0f, -1.0f, kNan}) {
      std::vector<float> sums(27 * points.size());
      const LightUse use[] = {{0, share}};
      projectBatch<3>(prepared, use, points.rows(), {}, sums);
      EXPECT_THAT(sums, testing::Each(0.0f)) << share;
    }
  });
}

}  // namespace
}  // namespace rigel
