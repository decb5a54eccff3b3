// The section on disk lights: what is measured where, what each disk used, and nothing without disks.
#include "report/measure/disk_methods.h"

#include "report/formats/report_text.h"
#include "report/words/disk_words.h"
#include "report_fixture.h"
#include "whole_run.h"

#include <rigel/exact.h>

#include <gmock/gmock.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using testing::HasSubstr;

/// Pairs of a sample's first object over four moments of its clip.
DiskPairs pairsOf(const std::string& source) {
  const auto scene = loadScene(source);
  EXPECT_TRUE(scene);
  const auto objects = findObjects(*scene);
  const auto moving = std::ranges::find(objects, false, &SceneObject::isStatic);
  ScenePose pose;
  PosedObject posed;
  poseScene(*scene, kRestPose, 0, pose);
  poseObject(*scene, *moving, pose, posed);
  const auto surface = chooseSurface(*moving, posed, 256, {});
  EXPECT_TRUE(surface);
  DiskPairs pairs(4);
  for (const double time : {0.5, 1.5, 2.5, 3.5}) {
    poseScene(*scene, 0, time, pose);
    poseObject(*scene, *moving, pose, posed);
    PosedLights lights;
    poseLights(*scene, pose, lights);
    pairs.add(*moving, posed, *surface, lights.set);
  }
  return pairs;
}

TEST(DiskMethods, AreMeasuredWhereDisksLightTheSurface) {
  const DiskPairs pairs = pairsOf("sample:corridor");
  EXPECT_GT(pairs.pairs().size(), 1000u);
  EXPECT_LE(pairs.pairs().size(), DiskPairs::kMost);
  for (const DiskPairs::Pair& pair : pairs.pairs()) {
    const Vec3 away = pair.position - pair.light.position;
    EXPECT_TRUE(pair.light.twoSided || dot(away, pair.light.direction) > 0) << "behind the disk";
  }
  const auto rows = measureDiskMethods(pairs.pairs(), 3);
  std::vector<std::string> names;
  for (const DiskMethodRow& row : rows) names.push_back(row.method);
  ASSERT_THAT(
      names, testing::ElementsAre("table", "quadrature-4", "quadrature-6", "quadrature-8", "exact", "near", "wallace"));
  const DiskMethodRow &table = rows[0], &four = rows[1], &six = rows[2], &exact = rows[4], &near = rows[5],
                      &wallace = rows[6];
  for (const DiskMethodRow& row : rows) {
    EXPECT_GT(row.nanoseconds, 0) << row.method;
    EXPECT_GE(row.irradiance.max, row.irradiance.rms) << row.method;
  }
  // The guarantees of disk.h, disk_table.h and near_light.h, which hold here with room to spare.
  EXPECT_LT(exact.sh->max, 3e-7) << "rounded to float";
  EXPECT_LT(six.sh->max, 4e-4);
  EXPECT_LT(table.sh->max, 6e-4);
  EXPECT_LE(six.sh->max, 1.1 * four.sh->max) << "down to what float leaves of both";
  EXPECT_LT(near.irradiance.max, 2e-5);
  EXPECT_FALSE(near.sh || wallace.sh) << "they give irradiance alone";
  // Of bands, what they cannot hold remains however they are found.
  EXPECT_NEAR(six.irradiance.max, exact.irradiance.max, 1e-3);
  EXPECT_GT(exact.irradiance.max, 0.02);
  EXPECT_GT(wallace.irradiance.max, 0.1) << "contact and grazing angles are its weak side";
}

TEST(DiskMethods, MoreBandsHoldMore) {
  const DiskPairs pairs = pairsOf("sample:gallery");
  const auto two = measureDiskMethods(pairs.pairs(), 2), five = measureDiskMethods(pairs.pairs(), 5);
  EXPECT_LT(five[4].irradiance.rms, 0.5 * two[4].irradiance.rms);
}

TEST(DiskMethods, NothingIsMeasuredWithoutDisks) {
  EXPECT_TRUE(pairsOf("sample:street").pairs().empty());
  EXPECT_TRUE(measureDiskMethods({}, 3).empty());
  const auto report = run(quickRun("sample:street", "0"));
  ASSERT_TRUE(report) << report.error().line();
  EXPECT_FALSE(report->scenes.at(0).disks);
  EXPECT_EQ(reportText(*report).find("disk"), std::string::npos);
}

TEST(DiskMethods, AreASectionOfAReportWithDisks) {
  const auto report = run(quickRun("sample:corridor", "40"));
  ASSERT_TRUE(report) << report.error().line();
  const SceneReport& scene = report->scenes.at(0);
  ASSERT_TRUE(scene.disks);
  EXPECT_EQ(scene.disks->methods.size(), 7u);
  EXPECT_EQ(scene.disks->uses.size(), 2u * 12u) << "two rigs, twelve disks";
  EXPECT_THAT(scene.disks->choice, HasSubstr("6 nodes"));
  EXPECT_THAT(scene.effects, testing::Contains("light.disk"));
}

LightReport lightUse(const std::string& name, const std::string& type, std::vector<LightRole> roles) {
  LightReport use;
  use.name = name;
  use.type = type;
  use.why = "why of " + name;
  use.roles = std::move(roles);
  return use;
}

TEST(DiskMethods, EachDiskSaysWhatItUsedAndWhy) {
  using enum LightRole;
  RigReport rig;
  rig.spec = "poly:6";
  rig.lights = {lightUse("bulb", "sphere", {exact, exact}), lightUse("a", "disk", {exact, exact}),
                lightUse("b", "disk", {inRig, blended}), lightUse("c", "disk", {inRig, culled}),
                lightUse("d", "disk", {culled, culled})};
  ObjectReport object;
  object.name = "bust";
  object.rigs = {rig};
  const std::vector<DiskUse> uses = diskUses(object, false);
  ASSERT_EQ(uses.size(), 4u);
  const std::string methods[] = {"near", "near, quadrature-6", "quadrature-6", "none"};
  for (std::size_t i = 0; i < uses.size(); ++i) {
    EXPECT_EQ(uses[i].method, methods[i]) << uses[i].light;
    EXPECT_EQ(uses[i].object, "bust");
    EXPECT_EQ(uses[i].rig, "poly:6");
    EXPECT_THAT(uses[i].why, testing::StartsWith("why of " + uses[i].light));
  }
  EXPECT_THAT(uses[0].why, HasSubstr("closed form"));
  EXPECT_THAT(uses[0].why, testing::Not(HasSubstr("bands")));
  EXPECT_THAT(uses[1].why, testing::AllOf(HasSubstr("closed form"), HasSubstr("6 nodes")));
  EXPECT_THAT(uses[2].why, testing::AllOf(HasSubstr("6 nodes"), testing::Not(HasSubstr("closed form"))));
  EXPECT_EQ(uses[3].why, "why of d");
  EXPECT_THAT(diskUses(object, true)[0].why, HasSubstr("five bands"));
}

}  // namespace
}  // namespace rigel::tests
