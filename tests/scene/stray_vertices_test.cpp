// Vertices that no triangle uses must reach neither a box nor a scale.
#include "scene/pose.h"
#include "scene_files.h"

#include <gtest/gtest.h>

namespace rigel::tools {
namespace {

using nlohmann::json;
using test::GltfMaker;

/// The triangle of GltfMaker::skinned() (which has joints, weights), with normals and a morph target, between strays:
/// vertices 1, 3 and 4 of 6 are its corners, used in the order 3, 1, 4.
GltfMaker strayMaker(bool withStrays) {
  GltfMaker g = GltfMaker::skinned();
  json& primitive = g.json["meshes"][0]["primitives"][0];
  const auto pick = [&](const std::vector<float>& corners, int width, float stray) {
    if (!withStrays) return corners;
    std::vector<float> all(static_cast<std::size_t>(6 * width), stray);
    const int places[] = {1, 3, 4};
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < width; ++k) all[places[c] * width + k] = corners[c * width + k];
    return all;
  };
  const auto joints = [&]() -> std::vector<std::uint8_t> {
    if (!withStrays) return {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
    return {1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0};
  }();
  const std::size_t count = withStrays ? 6 : 3;
  primitive["attributes"] = {
      {"POSITION", g.addFloats(pick({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3, 1000), "VEC3")},
      {"NORMAL", g.addFloats(pick({0, 0, 1, 0, 1, 0, 1, 0, 0}, 3, 0), "VEC3")},
      {"JOINTS_0", g.add(joints, 5121, "VEC4", count)},
      {"WEIGHTS_0", g.addFloats(pick({1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0}, 4, .25f), "VEC4")}};
  primitive["targets"] = json::array({{{"POSITION", g.addFloats(pick({0, 0, 1, 0, 0, 2, 0, 0, 3}, 3, -500), "VEC3")},
                                       {"NORMAL", g.addFloats(pick({1, 0, 0, 0, 1, 0, 0, 0, 1}, 3, 7), "VEC3")}}});
  primitive["indices"] =
      g.add(withStrays ? std::vector<std::uint16_t>{3, 1, 4} : std::vector<std::uint16_t>{1, 0, 2}, 5123, "SCALAR", 3);
  g.json["nodes"][2]["translation"] = {0, 0, 5};
  g.json["nodes"][0]["weights"] = json::array({0.5f});
  return g;
}

Scene load(GltfMaker g) {
  const test::TemporaryFolder folder;
  auto scene = loadGltf(g.write(folder));
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().line());
  return scene ? *std::move(scene) : Scene{};
}

TEST(StrayVertices, AreDroppedFromEveryArrayAlike) {
  const Scene clean = load(strayMaker(false));
  const Scene scene = load(strayMaker(true));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Primitive& a = scene.meshes[0].primitives.at(0);
  const Primitive& b = clean.meshes.at(0).primitives.at(0);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.influences.size(), 3u);
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(a.influences[v].joint, b.influences[v].joint) << v;
    EXPECT_EQ(a.influences[v].weight, b.influences[v].weight) << v;
  }
  ASSERT_EQ(a.targets.size(), 1u);
  EXPECT_EQ(a.targets[0].positions, b.targets[0].positions);
  EXPECT_EQ(a.targets[0].normals, b.targets[0].normals);
  EXPECT_TRUE(scene.notes.empty());
}

TEST(StrayVertices, ThePosedObjectIsTheSame) {
  const auto posedOf = [](const Scene& scene) {
    ScenePose pose;
    poseScene(scene, kRestPose, 0, pose);
    PosedObject posed;
    poseObject(scene, findObjects(scene).at(0), pose, posed);
    return posed;
  };
  const PosedObject clean = posedOf(load(strayMaker(false)));
  const PosedObject posed = posedOf(load(strayMaker(true)));
  ASSERT_EQ(clean.positions.size(), 3u);
  EXPECT_EQ(posed.positions, clean.positions);
  EXPECT_EQ(posed.normals, clean.normals);
  for (const glm::vec3& p : posed.positions) EXPECT_LT(glm::length(p), 10);  // the strays are at 1000 and -500
}

TEST(StrayVertices, LeftOverIndicesUseNone) {
  GltfMaker g = strayMaker(true);
  g.json["meshes"][0]["primitives"][0]["indices"] =
      g.add(std::vector<std::uint16_t>{3, 1, 4, 0, 5}, 5123, "SCALAR", 5);  // the last two make no triangle
  EXPECT_EQ(load(std::move(g)).meshes.at(0).primitives.at(0).positions.size(), 3u);
}

TEST(StrayVertices, APrimitiveWithoutTrianglesIsNotedAndLeftOut) {
  GltfMaker g = GltfMaker::triangle();
  json extra = g.json["meshes"][0]["primitives"][0];
  extra["indices"] = g.add(std::vector<std::uint16_t>{0, 1}, 5123, "SCALAR", 2);
  g.json["meshes"][0]["primitives"].push_back(extra);
  const Scene scene = load(std::move(g));
  EXPECT_EQ(scene.meshes.at(0).primitives.size(), 1u);
  EXPECT_EQ(scene.notes, (std::vector<std::string>{"/meshes/0/primitives/1: 2 left-over indices ignored",
                                                   "/meshes/0/primitives/1: ignored: has no triangle"}));
}

TEST(StrayVertices, MessagesNumberVerticesAsTheFileDoes) {
  GltfMaker g = strayMaker(true);
  std::vector<std::uint8_t> joints(24, 0);
  joints[4 * 4] = 9;  // vertex 4, which becomes vertex 2
  g.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = g.add(joints, 5121, "VEC4", 6);
  const test::TemporaryFolder folder;
  const auto scene = loadGltf(g.write(folder));
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "vertex 4 of mesh 0 follows joint 9, skin 0 has 2");
}

}  // namespace
}  // namespace rigel::tools
