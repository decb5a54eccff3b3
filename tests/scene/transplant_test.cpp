// Lights carried from one scene to another.
#include "scene/transplant.h"

#include "scene_files.h"

#include <gtest/gtest.h>

namespace rigel::tools {
namespace {

// A square of side 2 `half` about `centre` (radius sqrt(2) half) and far-off scenery that must not count.
Scene square(float half, const glm::vec3& centre) {
  Scene scene = test::triangleScene(
      {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, -half, 0}, {half, half, 0}, {-half, half, 0}});
  scene.nodes[0].translation = centre;
  Node ground;
  ground.mesh = 0;
  ground.isStatic = true;
  ground.translation = {500, 0, 0};
  scene.nodes.push_back(ground);
  scene.roots = {0, 1};
  scene.name = "square";
  return scene;
}

void addLight(Scene& scene, LightShape shape, const glm::vec3& position) {
  Node node;
  node.light = static_cast<int>(scene.lights.size());
  node.translation = position;
  scene.lights.push_back({"light " + std::to_string(node.light), std::move(shape)});
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  scene.nodes.push_back(node);
}

Scene donorScene() {
  Scene scene = square(1, {10, 0, 0});
  addLight(scene, SphereLight{{}, 0.5f, {3, 3, 3}}, {10, 2, 0});
  addLight(scene, PointLight{{}, {1, 2, 4}, 0.25f, 8}, {9, 0, 0});
  addLight(scene, SpotLight{{}, {0, 0, -1}, {1, 1, 1}, 0.2f, 0.6f}, {10, 0, 5});
  addLight(scene, DirectionalLight{{0, 0, -1}, {6, 5, 4}}, {0, 0, 0});
  addLight(scene, DiskLight{{}, {0, 0, -1}, 0.2f, {2, 4, 8}, true}, {10, 0, 1});
  scene.animations.push_back(
      {"move", {{0, AnimationPath::translation, Interpolation::linear, 3, {0, 2}, {10, 0, 0, 14, 0, 0}}}, 2});
  return scene;
}

TEST(Transplant, ScalesAboutTheObjects) {
  const auto donor = LightDonor::create(donorScene());
  ASSERT_TRUE(donor) << donor.error().line();
  EXPECT_EQ(donor->duration(), 2);
  const auto transplant = LightTransplant::create(*donor, square(3, {0, 100, 0}), kRestPose);
  ASSERT_TRUE(transplant) << transplant.error().line();
  EXPECT_NEAR(transplant->ratio(), 3, 1e-6);
  PosedLights lights;
  transplant->lightsAt(0, lights);
  ASSERT_EQ(lights.names, (std::vector<std::string>{"light 3", "light 1", "light 2", "light 0", "light 4"}));
  const auto near = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-4f; };
  EXPECT_EQ(lights.set.directional(0).irradiance, (Rgb{6, 5, 4}));
  const PointLight point = lights.set.point(0);
  EXPECT_TRUE(near(point.position, {-3, 100, 0})) << point.position.x;
  EXPECT_NEAR(point.intensity.b, 36, 1e-4);
  EXPECT_NEAR(point.radius, 0.75, 1e-6);
  EXPECT_NEAR(point.range, 24, 1e-4);
  const SpotLight spot = lights.set.spot(0);
  EXPECT_TRUE(near(spot.position, {0, 100, 15}));
  EXPECT_EQ(spot.range, kNoRange);
  EXPECT_EQ(spot.outerAngle, 0.6f);
  EXPECT_NEAR(spot.intensity.r, 9, 1e-5);
  const SphereLight sphere = lights.set.sphere(0);
  EXPECT_TRUE(near(sphere.position, {0, 106, 0}));
  EXPECT_NEAR(sphere.radius, 1.5, 1e-6);
  EXPECT_EQ(sphere.radiance, (Rgb{3, 3, 3}));
  const DiskLight disk = lights.set.disk(0);
  EXPECT_TRUE(near(disk.position, {0, 100, 3}));
  EXPECT_EQ(disk.direction, (Vec3{0, 0, -1}));
  EXPECT_NEAR(disk.radius, 0.6, 1e-6);
  EXPECT_EQ(disk.radiance, (Rgb{2, 4, 8}));
  EXPECT_TRUE(disk.twoSided);
}

TEST(Transplant, LightsMoveAsSeenFromTheDonorsObject) {
  const auto donor = LightDonor::create(donorScene());
  ASSERT_TRUE(donor);
  const auto transplant = LightTransplant::create(*donor, square(3, {0, 100, 0}), kRestPose);
  ASSERT_TRUE(transplant);
  PosedLights lights;
  for (const auto& [time, x] : {std::pair(0.0, 0.f), {1.0, -6.f}, {2.0, -12.f}, {5.0, -12.f}}) {
    transplant->lightsAt(time, lights);
    EXPECT_NEAR(lights.set.sphere(0).position.x, x, 1e-4) << time;
  }
}

TEST(Transplant, MeasuresTheTargetAsTheClipGivenBegins) {
  const auto donor = LightDonor::create(donorScene());
  ASSERT_TRUE(donor);
  Scene target = square(3, {0, 100, 0});
  const auto at = [](float x, float scale) {
    Animation clip{"clip", {}, 1};
    clip.channels.push_back({0, AnimationPath::translation, Interpolation::linear, 3, {0, 1}, {x, 0, 0, 0, 0, 0}});
    clip.channels.push_back({0, AnimationPath::scale, Interpolation::step, 3, {0}, {scale, scale, scale}});
    return clip;
  };
  target.animations = {at(0, 1), at(50, 2)};
  PosedLights lights;
  struct Case {
    int clip;
    float x, y, ratio;
  };
  for (const Case& c : {Case{kRestPose, 0, 100, 3}, {0, 0, 0, 3}, {1, 50, 0, 6}}) {
    const auto transplant = LightTransplant::create(*donor, target, c.clip);
    ASSERT_TRUE(transplant);
    EXPECT_NEAR(transplant->ratio(), c.ratio, 1e-5) << c.clip;
    transplant->lightsAt(0, lights);
    EXPECT_NEAR(lights.set.sphere(0).position.x, c.x, 1e-4) << c.clip;
    EXPECT_NEAR(lights.set.sphere(0).position.y, c.y + 2 * c.ratio, 1e-4) << c.clip;
  }
}

TEST(Transplant, RefusesWhatCannotLendOrTake) {
  const auto dark = LightDonor::create(square(1, {}));
  ASSERT_FALSE(dark);
  EXPECT_EQ(dark.error().line(), "square: has no lights to lend");
  Scene collapsed = donorScene();
  collapsed.nodes[0].scale = glm::vec3(0);
  const auto point = LightDonor::create(collapsed);
  ASSERT_FALSE(point);
  EXPECT_EQ(point.error().line(), "square: its objects have no extent to scale lights by");
  const auto donor = LightDonor::create(donorScene());
  ASSERT_TRUE(donor);
  const auto onPoint = LightTransplant::create(*donor, square(0, {}), kRestPose);
  ASSERT_FALSE(onPoint);
  EXPECT_EQ(onPoint.error().line(), "square: its objects have no extent to scale lights by");
}

TEST(Transplant, AFileOfLightsAloneLendsThemAsTheyStand) {
  Scene scene;
  scene.name = "lights";
  addLight(scene, PointLight{{}, {1, 2, 4}, 0.25f, 8}, {9, 1, -3});
  const auto donor = LightDonor::create(scene);
  ASSERT_TRUE(donor);
  EXPECT_FALSE(donor->hasObjects());
  const auto transplant = LightTransplant::create(*donor, square(3, {100, 0, 0}), kRestPose);
  ASSERT_TRUE(transplant);
  PosedLights lights;
  transplant->lightsAt(0, lights);
  ASSERT_EQ(lights.set.pointCount(), 1);
  const PointLight light = lights.set.point(0);
  EXPECT_EQ(light.position, (Vec3{9, 1, -3}));
  EXPECT_EQ(light.intensity, (Rgb{1, 2, 4}));
  EXPECT_EQ(light.radius, 0.25f);
  EXPECT_EQ(light.range, 8);
}

TEST(Transplant, DisksAloneCanBeLent) {
  Scene scene = square(1, {});
  addLight(scene, DiskLight{{}, {0, 0, -1}, 0.2f, {2, 4, 8}}, {0, 0, 1});
  EXPECT_TRUE(LightDonor::create(scene));
}

TEST(Transplant, AllSceneryCountsAsTheObject) {
  Scene scenery = donorScene();
  scenery.nodes[0].isStatic = true;
  std::swap(scenery.nodes[1].mesh, scenery.nodes[2].mesh);  // leaves one mesh node at the origin of node 2
  scenery.nodes[1].mesh = -1;
  EXPECT_TRUE(LightDonor::create(scenery));
}

}  // namespace
}  // namespace rigel::tools
