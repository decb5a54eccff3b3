// Which parts of a scene become objects, their frames, names and marks.
#include "scene/pose.h"
#include "scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rigel::tools {
namespace {

int add(Scene& scene, int parent, const std::string& name, int mesh = -1) {
  Node node;
  node.name = name;
  node.parent = parent;
  node.mesh = mesh;
  const int index = static_cast<int>(scene.nodes.size());
  if (parent < 0) {
    scene.roots.push_back(index);
  } else {
    scene.nodes[parent].children.push_back(index);
  }
  scene.nodes.push_back(node);
  return index;
}

Scene withMesh() {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.nodes.clear();
  scene.roots.clear();
  return scene;
}

std::vector<std::string> names(const std::vector<SceneObject>& objects) {
  std::vector<std::string> out;
  for (const SceneObject& o : objects) out.push_back(o.name);
  return out;
}

TEST(Objects, EachMeshNodeIsOneWithItsOwnFrame) {
  Scene scene = withMesh();
  const int group = add(scene, -1, "group");
  add(scene, group, "a", 0);
  add(scene, group, "b", 0);
  const auto objects = findObjects(scene);
  EXPECT_EQ(names(objects), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(objects[0].frameNode, 1);
  EXPECT_EQ(objects[1].frameNode, 2);
  EXPECT_EQ(objects[1].vertexCount, 3);
}

TEST(Objects, NamesAreUnique) {
  Scene scene = withMesh();
  for (const char* name : {"a", "a", "a 2", "", "", "a"}) add(scene, -1, name, 0);
  // Nodes without a name take the mesh's.
  EXPECT_EQ(names(findObjects(scene)), (std::vector<std::string>{"a", "a 2", "a 2 2", "mesh", "mesh 2", "a 3"}));
}

TEST(Objects, AMarkedNodeGathersWhatIsBelow) {
  Scene scene = withMesh();
  const int loose = add(scene, -1, "loose", 0);
  const int car = add(scene, -1, "car");
  const int body = add(scene, car, "body", 0);
  const int wheel = add(scene, body, "wheel", 0);
  scene.nodes[car].isObject = true;
  scene.nodes[wheel].isObject = true;  // inside another: no object of its own
  const auto objects = findObjects(scene);
  ASSERT_EQ(names(objects), (std::vector<std::string>{"loose", "car"}));
  EXPECT_EQ(objects[0].meshNodes, std::vector<int>{loose});
  EXPECT_EQ(objects[1].meshNodes, (std::vector<int>{body, wheel}));
  EXPECT_EQ(objects[1].frameNode, car);
  EXPECT_EQ(objects[1].vertexCount, 6);
  EXPECT_EQ(objects[1].triangles[1], glm::uvec3(3, 4, 5));
}

TEST(Objects, StaticMarksReachDown) {
  Scene scene = withMesh();
  const int room = add(scene, -1, "room");
  scene.nodes[room].isStatic = true;
  const int table = add(scene, room, "table");
  add(scene, table, "leg", 0);
  add(scene, -1, "cat", 0);
  const auto objects = findObjects(scene);
  ASSERT_EQ(names(objects), (std::vector<std::string>{"leg", "cat"}));
  EXPECT_TRUE(objects[0].isStatic);
  EXPECT_FALSE(objects[1].isStatic);
}

TEST(Objects, ASkinGathersItsMeshesInTheSkeletonsFrame) {
  Scene scene = withMesh();
  scene.meshes[0].primitives[0].influences.resize(3);
  for (Influences& in : scene.meshes[0].primitives[0].influences) in.weight[0] = 1;
  const int body = add(scene, -1, "body", 0);
  const int joint = add(scene, -1, "hips");
  const int head = add(scene, joint, "head", 0);
  scene.nodes[body].skin = scene.nodes[head].skin = 0;
  Skin skin{"", {joint}, {glm::mat4(1)}, joint};
  scene.skins = {skin};
  auto objects = findObjects(scene);
  ASSERT_EQ(names(objects), std::vector<std::string>{"hips"});
  EXPECT_EQ(objects[0].meshNodes, (std::vector<int>{body, head}));
  EXPECT_EQ(objects[0].frameNode, joint);
  scene.skins[0].name = "person";
  EXPECT_EQ(names(findObjects(scene)), std::vector<std::string>{"person"});
  // Scenery only when all of its meshes are.
  scene.nodes[body].isStatic = true;
  EXPECT_FALSE(findObjects(scene)[0].isStatic);
  scene.nodes[head].isStatic = true;
  EXPECT_TRUE(findObjects(scene)[0].isStatic);
}

TEST(Objects, NodesOutsideTheSceneHoldNone) {
  Scene scene = withMesh();
  add(scene, -1, "in", 0);
  add(scene, -1, "out", 0);
  scene.roots = {0};
  EXPECT_EQ(names(findObjects(scene)), std::vector<std::string>{"in"});
}

TEST(Objects, TrianglesCarryTheirMaterial) {
  const Scene scene = test::everythingScene();
  const auto objects = findObjects(scene);
  ASSERT_EQ(objects.size(), 2u);
  ASSERT_EQ(objects[0].triangles.size(), 3u);
  EXPECT_EQ(objects[0].triangleColour[0], glm::vec3(0.1f, 0.7f, 0.3f));
  EXPECT_EQ(objects[0].triangleColour[2], glm::vec3(1));  // without a material
  EXPECT_EQ(objects[1].triangleWrap[0], 0.3f);
}

TEST(Objects, PosesKeepTheirSizeAndStopAllocating) {
  const Scene scene = test::everythingScene();
  const auto objects = findObjects(scene);
  ScenePose pose;
  PosedObject posed;
  poseScene(scene, 0, 0, pose);
  poseObject(scene, objects[1], pose, posed);
  const glm::vec3* positions = posed.positions.data();
  const glm::mat4* matrices = posed.skinMatrices.data();
  const glm::mat4* nodes = pose.worldFromNode.data();
  for (int frame = 1; frame < 60; ++frame) {
    poseScene(scene, 0, frame / 30., pose);
    poseObject(scene, objects[1], pose, posed);
    EXPECT_EQ(posed.positions.data(), positions);
    EXPECT_EQ(posed.skinMatrices.data(), matrices);
    EXPECT_EQ(pose.worldFromNode.data(), nodes);
  }
  EXPECT_EQ(posed.worldFromRig, pose.worldFromNode[3]);
}

}  // namespace
}  // namespace rigel::tools
