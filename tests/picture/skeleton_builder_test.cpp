#include "samples/skeleton_builder.h"

#include "samples/scene_builder.h"

#include <gmock/gmock.h>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>

namespace rigel::tools {
namespace {

const std::vector<Bone> kChain{{"a", -1, {0, 1, 0}, {1, 1, 0}, 0.1f, 0.1f},
                               {"b", 0, {1, 1, 0}, {2, 1, 0}, 0.1f, 0.1f},
                               {"c", 1, {2, 1, 0}, {3, 1, 0}, 0.1f, 0.1f}};

TEST(AddSkeleton, BindPoseLeavesPointsWhereTheyAre) {
  Scene scene;
  const Skeleton skeleton = addSkeleton(scene, "chain", kNoParent, kChain);
  ASSERT_EQ(skeleton.joints.size(), 3u);
  const Skin& skin = scene.skins.at(0);
  EXPECT_EQ(skin.skeletonRoot, skeleton.joints[0]);
  glm::vec3 world{0};
  for (std::size_t j = 0; j < 3; ++j) {
    world += scene.nodes[static_cast<std::size_t>(skeleton.joints[j])].translation;
    EXPECT_EQ(world, kChain[j].head);
    EXPECT_EQ(glm::vec3(skin.inverseBind[j][3]), -kChain[j].head);
  }
}

float weightOf(const Influences& influences, int joint) {
  float sum = 0;
  for (std::size_t i = 0; i < influences.weight.size(); ++i)
    if (influences.joint[i] == joint) sum += influences.weight[i];
  return sum;
}

TEST(BindToBones, WeightsPassSmoothlyFromBoneToBone) {
  constexpr int kSteps = 600;
  Primitive line;
  for (int i = 0; i <= kSteps; ++i) line.positions.push_back({3.0f * static_cast<float>(i) / kSteps, 1.1f, 0});
  bindToBones(line, kChain, 0.2f);
  EXPECT_EQ(weightOf(line.influences[100], 0), 1) << "the middle of a bone is all its own";
  EXPECT_EQ(weightOf(line.influences[300], 1), 1);
  EXPECT_NEAR(weightOf(line.influences[200], 0), 0.5f, 1e-5f) << "halfway at the joint";
  float largest = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < 3; ++j) {
      largest = std::max(largest, std::abs(weightOf(line.influences[i], j) - weightOf(line.influences[i + 1], j)));
    }
  }
  EXPECT_LT(largest, 0.02f) << "over 5 mm";
}

TEST(BindToBones, FiveBonesAtOneDistanceStillSumToOne) {
  std::vector<Bone> star;
  for (int i = 0; i < 6; ++i) {
    const float a = static_cast<float>(i);
    star.push_back({"b", i - 1, {std::cos(a), std::sin(a), 0}, {2 * std::cos(a), 2 * std::sin(a), 0}, 0.1f, 0.1f});
  }
  Primitive p;
  p.positions = {{0, 0, 0}, {0, 0, 3}};
  bindToBones(p, star, 0.5f);
  for (const Influences& influences : p.influences) {
    float sum = 0;
    for (const float w : influences.weight) {
      EXPECT_TRUE(std::isfinite(w));
      sum += w;
    }
    EXPECT_NEAR(sum, 1, 1e-5f);
  }
}

TEST(Aim, TurnsMinusZToTheDirection) {
  for (const glm::vec3 d :
       {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0, -1, 0), glm::vec3(0.3f, -2, 5), glm::vec3(1e-4f, 0, 1)}) {
    EXPECT_LT(glm::distance(aim(d) * glm::vec3(0, 0, -1), glm::normalize(d)), 2e-3f) << d.x << " " << d.y << " " << d.z;
  }
}

TEST(Scatter, IsUniformAndRepeatable) {
  Scatter a(3), b(3), c(4);
  double sum = 0;
  int same = 0;
  for (int i = 0; i < 10000; ++i) {
    const float x = a.uniform(2, 4);
    EXPECT_GE(x, 2);
    EXPECT_LT(x, 4);
    EXPECT_EQ(x, b.uniform(2, 4));
    same += x == c.uniform(2, 4);
    sum += static_cast<double>(x);
  }
  EXPECT_NEAR(sum / 10000, 3, 0.03);
  EXPECT_LT(same, 10);
}

}  // namespace
}  // namespace rigel::tools
