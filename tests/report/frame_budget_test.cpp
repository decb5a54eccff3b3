// --budget-us: one frame's time for all objects of a scene, and what the report says each gave up.
#include "report/formats/report_text.h"
#include "report/words/budget_words.h"
#include "scene/pose.h"
#include "whole_run.h"

#include <gmock/gmock.h>

#include <cmath>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

/// The street with two more cars that stand beside the one that drives, and farther from the lamps.
Scene streetOfThree() {
  Scene scene = *loadScene("sample:street");
  const std::vector<SceneObject> objects = findObjects(scene);
  const auto car = std::ranges::find(objects, false, &SceneObject::isStatic);
  for (const float x : {3.0f, 9.0f}) {
    Node parked = scene.nodes.at(static_cast<std::size_t>(car->meshNodes.at(0)));
    parked.name = "parked";
    parked.parent = -1;
    parked.children.clear();
    parked.translation = {x, 0, x};
    parked.isObject = false;
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back(parked);
  }
  return scene;
}

double sumOfTimes(const SceneReport& scene, std::size_t frame) {
  double sum = 0;
  for (const ObjectReport& object : scene.objects)
    sum += object.rigs.back().frames.at(frame).modelledNanoseconds * 10;  // us of 10000 points
  return sum;
}

class FrameBudget : public testing::Test {
 protected:
  SceneReport with(std::optional<float> budget) const {
    RunOptions options = quickRun(scene_.file, "10:40:10", "poly:6;auto");
    options.budget = budget;
    options.target = LightingTarget{LightingTarget::Kind::totalError, 0.02f};
    auto report = run(options);
    EXPECT_TRUE(report) << (report ? "" : report.error().line());
    return report->scenes.at(0);
  }
  const SavedScene scene_{streetOfThree()};
};

TEST_F(FrameBudget, EveryoneGetsTheTargetWhereThereIsTime) {
  const SceneReport free = with({}), rich = with(100000);
  ASSERT_EQ(rich.objects.size(), 3u);
  EXPECT_TRUE(free.budgets.empty());
  ASSERT_EQ(rich.budgets.size(), 1u) << "poly:6 chooses nothing";
  EXPECT_EQ(rich.budgets[0].framesOver, 0);
  for (std::size_t i = 0; i < rich.objects.size(); ++i) {
    EXPECT_FALSE(rich.objects[i].rigs[0].budget);
    const RigReport& rig = rich.objects[i].rigs[1];
    ASSERT_TRUE(rig.budget && rig.budget->alone);
    EXPECT_FLOAT_EQ(static_cast<float>(rig.budget->granted), 0.02f);
    EXPECT_EQ(rig.total.rms, free.objects[i].rigs[1].total.rms);
    EXPECT_EQ(rig.budget->alone->totalRms, rig.total.rms);
    EXPECT_EQ(givenUp(rig), "nothing");
  }
}

TEST_F(FrameBudget, IsHeldByAllTogetherAndWhatTheyGaveUpIsSaid) {
  const SceneReport free = with({});
  double needed = 0;
  for (std::size_t f = 0; f < 4; ++f) needed = std::max(needed, sumOfTimes(free, f));
  const SceneReport scene = with(static_cast<float>(0.75 * needed));
  const SharedBudget& budget = scene.budgets.at(0);
  EXPECT_EQ(budget.spec, "auto");
  EXPECT_EQ(budget.framesOver, 0);
  double most = 0, mean = 0;
  for (std::size_t f = 0; f < 4; ++f) {
    const double used = sumOfTimes(scene, f);
    EXPECT_LE(used, 1.05 * 0.75 * needed) << f;
    most = std::max(most, used);
    mean += used / 4;
    const double allowed = *scene.objects[0].rigs[1].frames[f].granted;
    for (const ObjectReport& object : scene.objects)
      EXPECT_NEAR(*object.rigs[1].frames[f].granted, allowed, 1e-6) << "the largest error is shared";
  }
  EXPECT_NEAR(budget.most, most, 1e-3 * most);
  EXPECT_NEAR(budget.mean, mean, 1e-3 * mean);

  int losers = 0;
  for (const ObjectReport& object : scene.objects) {
    const RigReport& rig = object.rigs[1];
    EXPECT_GT(rig.budget->granted, rig.budget->alone->granted) << object.name;
    EXPECT_LT(rig.budget->microseconds, rig.budget->alone->microseconds) << object.name;
    if (!gaveUp(rig)) continue;
    ++losers;
    EXPECT_THAT(givenUp(rig), testing::HasSubstr("with the frame to itself"));
  }
  EXPECT_GE(losers, 2);
  Report report;
  report.scenes = {scene};
  EXPECT_THAT(reportText(report), testing::HasSubstr("us a frame for 3 objects lit by auto: "));
  EXPECT_THAT(reportText(report), testing::HasSubstr("parked gave up total RMS "));
}

TEST(FrameBudgetOfOne, SharesWithNobody) {
  RunOptions options = quickRun("sample:street", "10:30:10", "auto");
  options.budget = 70;
  const auto report = run(options);
  ASSERT_TRUE(report) << report.error().line();
  const RigReport& rig = report->scenes[0].objects[0].rigs[0];
  ASSERT_TRUE(rig.budget);
  EXPECT_FALSE(rig.budget->alone);
  EXPECT_GT(rig.budget->granted, 0.02);
  EXPECT_EQ(givenUp(rig), "");
  EXPECT_LE(report->scenes[0].budgets.at(0).most, 1.05 * 70);
}

}  // namespace
}  // namespace rigel::tests
