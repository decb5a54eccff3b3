#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/project.h>

#include "lights/describe.h"

#include <utility>
#include <vector>

namespace rigel {
namespace {

const DirectionalLight kDirectional{{1, -2, 0.5f}, {1, 2, 3}};
const PointLight kPoint{{1, 2, 3}, {4, 5, 6}, 0.1f, 10};
const SpotLight kSpot{{-1, 2, 1}, {1, -2, -1}, {7, 8, 9}, 0.1f, 0.8f, 0.02f, 7};
const SphereLight kSphere{{0, 1, -2}, 0.5f, {10, 11, 12}};

LightSet allKinds() {
  LightSet lights;
  lights.add(kDirectional);
  lights.add(kPoint);
  lights.add(kSpot);
  lights.add(kSphere);
  return lights;
}

TEST(LightSet, GivesBackWhatWasAdded) {
  LightSet lights = allKinds();
  lights.add(SphereLight{{9, 8, 7}, 6, {5, 4, 3}});
  EXPECT_EQ(lights.size(), 5);
  EXPECT_EQ(lights.directionalCount(), 1);
  EXPECT_EQ(lights.pointCount(), 1);
  EXPECT_EQ(lights.spotCount(), 1);
  EXPECT_EQ(lights.sphereCount(), 2);
  // Every field with all its digits.
  EXPECT_EQ(test::describe(lights.directional(0)), test::describe(kDirectional));
  EXPECT_EQ(test::describe(lights.point(0)), test::describe(kPoint));
  EXPECT_EQ(test::describe(lights.spot(0)), test::describe(kSpot));
  EXPECT_EQ(test::describe(lights.sphere(0)), test::describe(kSphere));
  EXPECT_EQ(lights.sphere(1).radius, 6);
}

TEST(LightSet, ClearEmptiesEveryKind) {
  LightSet lights = allKinds();
  lights.clear();
  EXPECT_EQ(lights.size(), 0);
  EXPECT_EQ(project<3>(lights, {})[0], Rgb{});
  lights.add(kSpot);
  EXPECT_EQ(lights.size(), 1);
  EXPECT_EQ(test::describe(lights.spot(0)), test::describe(kSpot));
}

TEST(LightSet, KeepsTheGroupsOfEveryLight) {
  LightSet lights;
  lights.add(kSphere, 4);
  lights.add(kPoint, 1);
  lights.add(kSpot);
  lights.add(kDirectional, 0x80000000u);
  lights.add(DiskLight{}, 8);
  lights.add(kSphere, 2);
  lights.add(kPoint, 0);
  // Directional, point, point, spot, sphere, sphere, disk.
  const std::uint32_t expected[] = {0x80000000u, 1, 0, kAllLightGroups, 4, 2, 8};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(lights.groups(i), expected[i]) << i;
  EXPECT_EQ(lights.groups(7), 0u);
  lights.clear();
  EXPECT_EQ(lights.groups(0), 0u);
  lights.add(kSpot, 16);
  EXPECT_EQ(lights.groups(0), 16u);
}

TEST(LightSet, VisitsAllInTheOrderOfVisit) {
  LightSet lights = allKinds();
  lights.add(DiskLight{{1, 2, 3}, {0, 1, 0}, 1, {13, 14, 15}});
  lights.add(kPoint);
  lights.add(kDirectional);
  std::vector<Rgb> all;
  lights.visitAll([&](const auto& light) { all.push_back(colourOf(light)); });
  ASSERT_EQ(all.size(), static_cast<std::size_t>(lights.size()));
  for (int i = 0; i < lights.size(); ++i)
    EXPECT_EQ(lights.visit(i, [](const auto& light) { return colourOf(light); }), all[static_cast<std::size_t>(i)])
        << i;
}

TEST(LightSet, ReserveKeepsTheLights) {
  LightSet lights = allKinds();
  lights.reserve(1000);
  EXPECT_EQ(lights.size(), 4);
  EXPECT_EQ(test::describe(lights.point(0)), test::describe(kPoint));
}

TEST(LightSet, ProjectionIsTheSumOverTheLights) {
  const LightSet lights = allKinds();
  const Vec3 p{0.3f, 0.1f, -0.2f};
  RadianceSH<5> expected = project<5>(kDirectional, p);
  expected += project<5>(kPoint, p);
  expected += project<5>(kSpot, p);
  expected += project<5>(kSphere, p);
  const RadianceSH<5> actual = project<5>(lights, p);
  const ProjectionWithGradient<5> both = projectWithGradient<5>(lights, p);
  for (int i = 0; i < 25; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const float tolerance = 1e-6f * std::abs(expected[0][channel]);
      EXPECT_NEAR(actual[i][channel], expected[i][channel], tolerance) << "coefficient " << i;
      EXPECT_NEAR(both.value[i][channel], expected[i][channel], tolerance) << "coefficient " << i;
    }
  }
}

TEST(LightSet, GradientIsTheSumOverTheLights) {
  const LightSet lights = allKinds();
  const Vec3 p{0.3f, 0.1f, -0.2f};
  const RadianceShGradient<5> parts[] = {projectWithGradient<5>(kPoint, p).gradient,
                                         projectWithGradient<5>(kSpot, p).gradient,
                                         projectWithGradient<5>(kSphere, p).gradient};
  const RadianceShGradient<5> sum = projectWithGradient<5>(lights, p).gradient;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 25; ++i) {
      float expected = 0;
      for (const RadianceShGradient<5>& part : parts) expected += part.d[axis][i].g;
      EXPECT_NEAR(sum.d[axis][i].g, expected, 1e-5f) << "axis " << axis << ", coefficient " << i;
    }
  }
}

TEST(LightSet, LightIsLinearInItsColour) {
  const LightSet lights = allKinds();
  const Vec3 p{0.3f, 0.1f, -0.2f};
  const Vec3 n{0, 0.8f, -0.6f};
  for (int i = 0; i < lights.size(); ++i) {
    lights.visit(i, [&](auto light) {
      const RgbD before = exactIrradiance(light, p, n, 1);
      colourOf(light) = colourOf(light) * 0.5f;
      const RgbD after = exactIrradiance(light, p, n, 1);
      for (int channel = 0; channel < 3; ++channel) EXPECT_DOUBLE_EQ(after[channel], 0.5 * before[channel]) << i;
      EXPECT_GT(after.r, 0) << i;
      EXPECT_EQ(colourOf(std::as_const(light)), colourOf(light)) << i;
    });
  }
}

TEST(LightSet, IrradianceIsTheSumOverTheLights) {
  const LightSet lights = allKinds();
  const Vec3 p{0.3f, 0.1f, -0.2f};
  const Vec3 n{0, 0.8f, -0.6f};
  for (const float wrap : {0.0f, 0.5f}) {
    RgbD expected = exactIrradiance(kDirectional, p, n, wrap);
    expected += exactIrradiance(kPoint, p, n, wrap);
    expected += exactIrradiance(kSpot, p, n, wrap);
    expected += exactIrradiance(kSphere, p, n, wrap);
    const RgbD actual = exactIrradiance(lights, p, n, wrap);
    for (int channel = 0; channel < 3; ++channel) EXPECT_DOUBLE_EQ(actual[channel], expected[channel]);
    EXPECT_GT(actual.r, 0);
  }
}

}  // namespace
}  // namespace rigel
