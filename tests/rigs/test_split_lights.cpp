// Splitting a light set by weights: what goes into the rig and what is evaluated at every point are the light again.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/near_far.h>

namespace rigel::test {
namespace {

LightSet oneOfEach() {
  LightSet lights;
  lights.add(DirectionalLight{{0, -1, 0.2f}, {1, 2, 3}});
  lights.add(PointLight{{1, 2, 0}, {3, 2, 1}, 0.1f, 8});
  lights.add(SpotLight{{-1, 2, 0}, {0.3f, -1, 0}, {5, 5, 1}, 0.3f, 0.9f, 0.1f, 9});
  lights.add(SphereLight{{0, 2, 1}, 0.4f, {1, 1, 2}});
  return lights;
}

TEST(SplitLights, SharesSumToTheWholeLight) {
  const LightSet lights = oneOfEach();
  LightSet far;
  std::vector<NearLight> near;
  for (const std::vector<float>& weights : {std::vector<float>{0.25f, 0.5f, 0.75f, 0.1f},
                                            {1, 1, 1, 1},
                                            {0, 0, 0, 0},
                                            {0, 1, 0.5f, 1},
                                            {7, -1, 0.5f, std::nanf("")}}) {
    splitLights(lights, weights, far, near);
    for (const Vec3 n : {Vec3{0, 1, 0}, Vec3{0.6f, 0.8f, 0}, Vec3{0, -0.6f, 0.8f}}) {
      const RgbD whole = exactIrradiance(lights, {}, n);
      RgbD parts = exactIrradiance(far, {}, n);
      for (const NearLight& light : near) parts += nearIrradiance(light, {}, n) * 1.0;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(parts[c], whole[c], 2e-6 * (1 + whole[c]));
    }
  }
}

TEST(SplitLights, PartsKeepTheirGroups) {
  LightSet lights;
  lights.add(PointLight{{1, 2, 0}, {3, 2, 1}}, 5);
  lights.add(SphereLight{{0, 2, 1}, 0.4f, {1, 1, 2}}, 6);
  LightSet far;
  std::vector<NearLight> near;
  splitLights(lights, std::vector<float>{0, 0.5f}, far, near);
  ASSERT_EQ(far.size(), 2);
  EXPECT_EQ(far.groups(0), 5u);
  EXPECT_EQ(far.groups(1), 6u);
}

TEST(SplitLights, DisksAreSharedLast) {
  LightSet lights = oneOfEach();
  lights.add(DiskLight{{0, 1.5f, 0.2f}, {0.1f, -1, 0}, 0.5f, {4, 3, 2}});
  lights.add(DiskLight{{0, -1, 0.2f}, {0.1f, -1, 0}, 0.5f, {4, 3, 2}, true});
  LightSet far;
  std::vector<NearLight> near;
  splitLights(lights, std::vector<float>{0, 0, 0, 0, 0.25f, 1}, far, near);
  ASSERT_EQ(far.diskCount(), 1);
  EXPECT_EQ(far.disk(0).radiance, (Rgb{3, 2.25f, 1.5f}));
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0].kind, NearLight::Kind::disk);
  EXPECT_EQ(near[0].share, 0.25f);
  EXPECT_EQ(near[1].cosOuter, -1);
  for (const Vec3 n : {Vec3{0, 1, 0}, Vec3{0.6f, 0.8f, 0}, Vec3{0, -0.6f, 0.8f}}) {
    const RgbD whole = exactIrradiance(lights, {}, n);
    RgbD parts = exactIrradiance(far, {}, n);
    for (const NearLight& light : near) parts += nearIrradiance(light, {}, n) * 1.0;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(parts[c], whole[c], 1e-5 * (1 + whole[c]));
  }
}

TEST(SplitLights, EachLightIsWhereItsWeightSays) {
  const LightSet lights = oneOfEach();
  LightSet far;
  std::vector<NearLight> near;
  splitLights(lights, std::vector<float>{0, 1, 0.25f, 0}, far, near);
  EXPECT_EQ(far.directionalCount(), 1);
  EXPECT_EQ(far.pointCount(), 0);
  EXPECT_EQ(far.spotCount(), 1);
  EXPECT_EQ(far.spot(0).intensity, (Rgb{3.75f, 3.75f, 0.75f}));
  EXPECT_EQ(far.sphereCount(), 1);
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0].kind, NearLight::Kind::point);
  EXPECT_EQ(near[0].share, 1);
  EXPECT_EQ(near[1].kind, NearLight::Kind::spot);
  EXPECT_EQ(near[1].share, 0.25f);
}

TEST(SplitLights, CulledAndBlackLightsAreInNeither) {
  LightSet lights = oneOfEach();
  lights.add(SphereLight{{0, 3, 0}, 0.4f, {}});
  LightSet far;
  std::vector<NearLight> near;
  const std::vector<std::uint8_t> culled = {0, 1, 0, 1, 0};
  splitLights(lights, std::vector<float>{0.5f, 0.5f, 1, 0.5f, 0.5f}, far, near, culled);
  EXPECT_EQ(far.size(), 1);
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0].kind, NearLight::Kind::directional);
  EXPECT_EQ(near[1].kind, NearLight::Kind::spot);
}

}  // namespace
}  // namespace rigel::test
