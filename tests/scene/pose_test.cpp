// Node transforms, skinning, morphing, normals and lights against naive double arithmetic.
#include "scene/pose.h"

#include "scene_files.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <random>

namespace rigel::tools {
namespace {

glm::dmat4 naiveLocal(const Node& node) {
  if (node.hasMatrix) return glm::dmat4(node.matrix);
  const glm::dquat q = glm::normalize(glm::dquat(node.rotation.w, node.rotation.x, node.rotation.y, node.rotation.z));
  return glm::translate(glm::dmat4(1), glm::dvec3(node.translation)) * glm::mat4_cast(q) *
         glm::scale(glm::dmat4(1), glm::dvec3(node.scale));
}

glm::dmat4 naiveWorld(const Scene& scene, int node) {
  glm::dmat4 world(1);
  for (; node >= 0; node = scene.nodes[node].parent) world = naiveLocal(scene.nodes[node]) * world;
  return world;
}

// Inverse transpose, the definition, for matrices that have one.
glm::dvec3 naiveNormal(const glm::dmat4& m, const glm::dvec3& n) {
  return glm::normalize(glm::inverseTranspose(glm::dmat3(m)) * n);
}

struct Random {
  std::mt19937 engine{12345};
  float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine); }
  glm::vec3 vec3(float low, float high) { return {(*this)(low, high), (*this)(low, high), (*this)(low, high)}; }
  glm::vec3 unit() {
    glm::vec3 v(0);
    while (glm::length(v) < 0.1f) v = vec3(-1, 1);
    return glm::normalize(v);
  }
  glm::quat rotation() { return glm::angleAxis((*this)(-3, 3), unit()); }
};

// A chain of joints with any transforms, vertices following up to eight of them.
Scene randomSkinnedScene(Random& random, float scaleLow, float scaleHigh) {
  Scene scene;
  constexpr int kJoints = 12;
  Skin skin;
  for (int j = 0; j < kJoints; ++j) {
    Node node;
    node.parent = j - 1;
    if (j > 0) scene.nodes[j - 1].children.push_back(j);
    node.translation = random.vec3(-0.5f, 0.5f);
    node.rotation = random.rotation();
    node.scale = random.vec3(scaleLow, scaleHigh);
    scene.nodes.push_back(node);
    skin.joints.push_back(j);
    glm::mat4 bind = glm::mat4_cast(random.rotation());
    bind[3] = glm::vec4(random.vec3(-1, 1), 1);
    skin.inverseBind.push_back(bind);
  }
  skin.skeletonRoot = 0;
  Primitive p;
  for (int v = 0; v < 300; ++v) {
    p.positions.push_back(random.vec3(-1, 1));
    p.normals.push_back(random.unit());
    Influences in;
    float sum = 0;
    const int used = 1 + v % 8;
    for (int k = 0; k < used; ++k) {
      in.joint[k] = static_cast<std::uint16_t>(random(0, kJoints - 0.01f));
      in.weight[k] = random(0.1f, 1);
      sum += in.weight[k];
    }
    for (float& w : in.weight) w /= sum;
    p.influences.push_back(in);
    if (v % 3 == 2) p.triangles.emplace_back(v - 2, v - 1, v);
  }
  scene.meshes.push_back({"m", {p}, {}});
  Node meshNode;
  meshNode.mesh = 0;
  meshNode.skin = 0;
  meshNode.translation = {1000, 1000, 1000};  // skinned meshes ignore it
  scene.nodes.push_back(meshNode);
  scene.skins = {skin};
  scene.roots = {0, kJoints};
  return scene;
}

PosedObject poseOnly(const Scene& scene, int clip = kRestPose, double time = 0) {
  ScenePose pose;
  poseScene(scene, clip, time, pose);
  const auto objects = findObjects(scene);
  PosedObject posed;
  if (objects.size() != 1) {
    ADD_FAILURE() << objects.size() << " objects";
    return posed;
  }
  poseObject(scene, objects.front(), pose, posed);
  return posed;
}

TEST(Pose, SkinningMatchesANaiveDoubleReference) {
  // Twelve chained float matrices against double: relative to the largest coordinate. Worst measured: 4e-6.
  constexpr double kChainRounding = 1e-5;
  Random random;
  double worst = 0, worstNormal = 0;
  int compared = 0;
  for (int round = 0; round < 20; ++round) {
    const Scene scene = randomSkinnedScene(random, 0.6f, 1.4f);
    const PosedObject posed = poseOnly(scene);
    const Primitive& p = scene.meshes[0].primitives[0];
    for (std::size_t v = 0; v < p.positions.size(); ++v) {
      glm::dmat4 blended(0);
      for (std::size_t k = 0; k < 8; ++k) {
        const int joint = p.influences[v].joint[k];
        blended += double{p.influences[v].weight[k]} *
                   (naiveWorld(scene, scene.skins[0].joints[joint]) * glm::dmat4(scene.skins[0].inverseBind[joint]));
      }
      const glm::dvec3 expected(blended * glm::dvec4(glm::dvec3(p.positions[v]), 1));
      worst = std::max(worst, glm::distance(expected, glm::dvec3(posed.positions[v])) / (1 + glm::length(expected)));
      // Blending may all but flatten a vertex's frame; its normal is then ill-conditioned, not wrong.
      const glm::dmat3 linear(blended);
      const double flatness = std::abs(glm::determinant(linear)) /
                              std::pow(glm::length(linear[0]) + glm::length(linear[1]) + glm::length(linear[2]), 3);
      if (flatness < 1e-3) continue;
      worstNormal =
          std::max(worstNormal, glm::distance(naiveNormal(blended, p.normals[v]), glm::dvec3(posed.normals[v])));
      ++compared;
    }
  }
  EXPECT_GT(compared, 3000);
  EXPECT_LT(worst, kChainRounding);
  EXPECT_LT(worstNormal, 30 * kChainRounding);  // times the conditioning allowed above
  std::printf("[ measured ] skinning: position %.2g, normal %.2g over %d vertices\n", worst, worstNormal, compared);
}

TEST(Pose, SkinnedMeshIgnoresItsNode) {
  Random random;
  Scene scene = randomSkinnedScene(random, 1, 1);
  const PosedObject before = poseOnly(scene);
  scene.nodes.back().translation = {-5, 0, 0};
  scene.nodes.back().scale = {0, 0, 0};
  EXPECT_EQ(before.positions, poseOnly(scene).positions);
}

Scene quadWithNormal(const glm::vec3& normal) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.meshes[0].primitives[0].normals.assign(3, glm::normalize(normal));
  return scene;
}

TEST(Pose, NormalsFollowTheInverseTranspose) {
  constexpr double kRounding = 1e-6;  // a few float operations; worst measured 3e-7
  Random random;
  double worst = 0;
  for (int round = 0; round < 500; ++round) {
    Scene scene = quadWithNormal(random.unit());
    Node& node = scene.nodes[0];
    node.rotation = random.rotation();
    node.scale = random.vec3(0.2f, 3);
    for (int axis = 0; axis < 3; ++axis) {
      if (random(0, 1) < 0.5f) node.scale[axis] = -node.scale[axis];
    }
    const glm::dvec3 expected = naiveNormal(naiveWorld(scene, 0), scene.meshes[0].primitives[0].normals[0]);
    worst = std::max(worst, glm::distance(expected, glm::dvec3(poseOnly(scene).normals[0])));
  }
  EXPECT_LT(worst, kRounding);
  std::printf("[ measured ] normals: %.2g\n", worst);
}

TEST(Pose, NormalsAreFiniteUnderCollapsedScales) {
  Random random;
  for (int zeros = 1; zeros < 8; ++zeros) {
    Scene scene = quadWithNormal(random.unit());
    scene.nodes[0].rotation = random.rotation();
    for (int axis = 0; axis < 3; ++axis) scene.nodes[0].scale[axis] = (zeros >> axis & 1) != 0 ? 0.f : 2.f;
    for (const glm::vec3& n : poseOnly(scene).normals) {
      EXPECT_TRUE(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z));
      const float length = glm::length(n);
      EXPECT_TRUE(length == 0 || std::abs(length - 1) < 1e-6f) << "length " << length;
    }
  }
  // Flattened along z, what remains is a sheet whose normal is z.
  Scene sheet = quadWithNormal({0.3f, 0.4f, 0.5f});
  sheet.nodes[0].scale = {1, 2, 0};
  EXPECT_NEAR(poseOnly(sheet).normals[0].z, 1, 1e-6f);
}

TEST(Pose, TinyAndHugeScalesKeepUnitNormals) {
  // The cofactor squares the scale: 1e-15 gives 1e-30, still a float; its squared length is not.
  for (const float scale : {1e-15f, 1e-8f, 1e8f, 1e15f}) {
    Scene scene = quadWithNormal({1, 2, 3});
    scene.nodes[0].scale = glm::vec3(scale);
    EXPECT_NEAR(glm::distance(poseOnly(scene).normals[0], glm::normalize(glm::vec3(1, 2, 3))), 0, 1e-6f) << scale;
  }
}

TEST(Pose, FlatMeshesHaveZeroNormalsAndOutwardWindingWhenMirrored) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.nodes[0].scale = {-1, 1, 1};
  const auto objects = findObjects(scene);
  ASSERT_EQ(objects.size(), 1u);
  const PosedObject posed = poseOnly(scene);
  for (const glm::vec3& n : posed.normals) EXPECT_EQ(n, glm::vec3(0));
  const glm::uvec3 t = objects[0].triangles[0];
  const glm::vec3 geometric =
      glm::cross(posed.positions[t.y] - posed.positions[t.x], posed.positions[t.z] - posed.positions[t.x]);
  EXPECT_GT(geometric.z, 0);
}

TEST(Pose, MorphAddsWeightedTargetsBeforeTheTransform) {
  Scene scene = test::everythingScene();
  scene.animations.clear();
  for (const std::vector<float>& weights :
       {std::vector<float>{0.5f, 0.25f}, std::vector<float>{-1, 2}, std::vector<float>{}}) {
    scene.nodes[1].morphWeights = weights;
    const std::vector<float>& used = weights.empty() ? scene.meshes[0].morphWeights : weights;
    ScenePose pose;
    poseScene(scene, kRestPose, 0, pose);
    const auto objects = findObjects(scene);
    PosedObject posed;
    poseObject(scene, objects[0], pose, posed);
    std::size_t at = 0;
    for (const Primitive& p : scene.meshes[0].primitives) {
      for (std::size_t v = 0; v < p.positions.size(); ++v, ++at) {
        glm::dvec3 position(p.positions[v]), normal(p.normals.empty() ? glm::vec3(0) : p.normals[v]);
        for (std::size_t t = 0; t < p.targets.size(); ++t) {
          position += double{used[t]} * glm::dvec3(p.targets[t].positions[v]);
          if (!p.targets[t].normals.empty()) normal += double{used[t]} * glm::dvec3(p.targets[t].normals[v]);
        }
        const glm::dmat4 world = naiveWorld(scene, 1);
        EXPECT_LT(glm::distance(glm::dvec3(world * glm::dvec4(position, 1)), glm::dvec3(posed.positions[at])), 4e-6);
        const glm::dvec3 expected = p.normals.empty() ? glm::dvec3(0) : naiveNormal(world, normal);
        EXPECT_LT(glm::distance(expected, glm::dvec3(posed.normals[at])), 1e-6);
      }
    }
    EXPECT_EQ(at, posed.positions.size());
  }
}

TEST(Pose, AnimatedMorphWeights) {
  const Scene scene = test::everythingScene();
  ScenePose pose;
  poseScene(scene, 0, 1.5, pose);
  ASSERT_EQ(pose.morphWeights[1].size(), 2u);
  EXPECT_NEAR(pose.morphWeights[1][0], 0.75, 1e-6);
  EXPECT_NEAR(pose.morphWeights[1][1], 0.3, 1e-6);
  EXPECT_TRUE(pose.morphWeights[0].empty());
  poseScene(scene, kRestPose, 0, pose);
  EXPECT_EQ(pose.morphWeights[1], (std::vector<float>{0.5f, 0}));
}

TEST(Pose, ClipsOverrideOnlyWhatTheyMove) {
  const Scene scene = test::everythingScene();
  ScenePose pose, rest;
  poseScene(scene, kRestPose, 0, rest);
  poseScene(scene, 0, 1.6, pose);
  EXPECT_EQ(glm::vec3(pose.worldFromNode[1][3]), glm::vec3(4, 5, 6));
  EXPECT_EQ(pose.worldFromNode[7], rest.worldFromNode[7]);
  EXPECT_EQ(glm::length(glm::vec3(pose.worldFromNode[1][1])), glm::length(glm::vec3(rest.worldFromNode[1][1])));
}

TEST(Pose, ChildrenMayComeBeforeTheirParents) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Node parent;
  parent.translation = {1, 2, 3};
  parent.children = {0};
  scene.nodes.push_back(parent);
  scene.nodes[0].parent = 1;
  scene.roots = {1};
  EXPECT_EQ(poseOnly(scene).positions[0], glm::vec3(1, 2, 3));
}

TEST(Pose, ADeepChainNeedsNoDeepStack) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  constexpr int kDepth = 200000;
  scene.nodes.resize(kDepth);
  for (int i = 1; i < kDepth; ++i) {
    scene.nodes[i].parent = i - 1;
    scene.nodes[i - 1].children.push_back(i);
    scene.nodes[i].translation = {1, 0, 0};
  }
  std::swap(scene.nodes[0].mesh, scene.nodes[kDepth - 1].mesh);
  EXPECT_EQ(poseOnly(scene).positions[0].x, kDepth - 1);
}

TEST(Pose, LightsTakePositionAndDirectionButNoScale) {
  Scene scene = test::everythingScene();
  scene.nodes[8].translation = {1, 0, 0};
  scene.nodes[8].scale = {3, 3, 3};
  ScenePose pose;
  poseScene(scene, kRestPose, 0, pose);
  PosedLights lights;
  poseLights(scene, pose, lights);
  ASSERT_EQ(lights.names, (std::vector<std::string>{"point", "spot", "sphere", "panel", "area"}));
  ASSERT_EQ(lights.set.pointCount(), 1);
  ASSERT_EQ(lights.set.spotCount(), 1);
  ASSERT_EQ(lights.set.sphereCount(), 1);
  EXPECT_EQ(lights.set.point(0).position, (Vec3{4, 5, 6}));
  // The matrix node turns x to -z and z to x: the spot's -z shines along -x, its +x offset lies towards -z.
  const SpotLight spot = lights.set.spot(0);
  EXPECT_EQ(spot.position, (Vec3{4, 5, 5}));
  EXPECT_NEAR(spot.direction.x, -1, 1e-6);
  EXPECT_EQ(spot.intensity, (Rgb{7, 8, 9.1f}));
  EXPECT_EQ(spot.radius, 0.02f);
  EXPECT_EQ(spot.range, 12.5f);
  EXPECT_EQ(lights.set.sphere(0).radius, 0.3f);
}

TEST(Pose, DisksFaceAlongTheirNodesAndGrowWhereTheirExtensionSaysSo) {
  Scene scene = test::everythingScene();
  scene.nodes[9].scale = {4, 4, 4};
  ScenePose pose;
  poseScene(scene, kRestPose, 0, pose);
  PosedLights lights;
  poseLights(scene, pose, lights);
  ASSERT_EQ(lights.set.diskCount(), 2);
  const DiskLight panel = lights.set.disk(0), area = lights.set.disk(1);
  EXPECT_EQ(panel.position, (Vec3{0, 3, 0}));
  // Turned about x by -2 acos(0.8), that is cos 0.28, sin -0.96: -z goes to (0, -0.96, -0.28).
  EXPECT_NEAR(panel.direction.y, -0.96, 1e-6);
  EXPECT_NEAR(panel.direction.z, -0.28, 1e-6);
  EXPECT_EQ(panel.radius, 0.7f) << "punctual lights ignore scale";
  EXPECT_FALSE(panel.twoSided);
  EXPECT_NEAR(area.radius, 0.3, 1e-7) << "the largest of 2, 3, 0.5 counts";
  EXPECT_EQ(area.radiance, (Rgb{9, 0.7f, 1.3f}));
  EXPECT_TRUE(area.twoSided);
}

TEST(Pose, OneLightOnTwoNodesIsTwoLightsWithTwoNames) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.lights = {{"lamp", PointLight{{}, {1, 1, 1}}}};
  scene.nodes.resize(4);
  for (int i = 1; i < 4; ++i) {
    scene.nodes[i].light = 0;
    scene.nodes[i].translation.x = static_cast<float>(i);
  }
  scene.roots = {0, 1, 2};  // node 3 is outside the scene
  ScenePose pose;
  poseScene(scene, kRestPose, 0, pose);
  PosedLights lights;
  poseLights(scene, pose, lights);
  EXPECT_EQ(lights.names, (std::vector<std::string>{"lamp", "lamp 2"}));
  EXPECT_EQ(lights.set.point(1).position.x, 2);
}

TEST(Pose, FlattenedLightNodesStillHaveADirection) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.lights = {{"sun", DirectionalLight{{0, 0, -1}, {1, 1, 1}}}};
  scene.nodes[0].light = 0;
  for (const glm::vec3& scale : {glm::vec3(1, 1, 0), glm::vec3(0), glm::vec3(1e-20f)}) {
    scene.nodes[0].scale = scale;
    ScenePose pose;
    poseScene(scene, kRestPose, 0, pose);
    PosedLights lights;
    poseLights(scene, pose, lights);
    EXPECT_EQ(lights.set.directional(0).direction, (Vec3{0, 0, -1}));
  }
}

}  // namespace
}  // namespace rigel::tools
