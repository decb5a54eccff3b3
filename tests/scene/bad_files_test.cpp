// Files that are not glTF, break its container, point nowhere, ask too much.
#include "bad_input.h"
#include "scene/pose.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

namespace rigel::tools {
namespace {

using nlohmann::json;
using test::GltfMaker;

void expectTextError(const std::string& content, const std::string& expectedPart) {
  const test::TemporaryFolder folder;
  test::writeFile(folder / "t.gltf", content);
  const auto scene = loadGltf(folder / "t.gltf");
  ASSERT_FALSE(scene) << "accepted, expected: " << expectedPart;
  EXPECT_NE(scene.error().line().find(expectedPart), std::string::npos) << scene.error().line();
  EXPECT_EQ(scene.error().line().find('\n'), std::string::npos);
}

TEST(BadInput, TheBasesAreGood) {
  for (GltfMaker g : {GltfMaker::triangle(), GltfMaker::skinned()}) {
    const test::TemporaryFolder folder;
    const auto scene = loadGltf(g.write(folder));
    ASSERT_TRUE(scene) << scene.error().line();
    EXPECT_TRUE(scene->notes.empty());
  }
}

TEST(BadInput, FilesAndContainers) {
  const auto missing = loadGltf("/nowhere/at all.gltf");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().line(), "/nowhere/at all.gltf: file does not exist");
  const auto folder = loadGltf("/tmp");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().line(), "/tmp: is a directory");
  expectTextError("", "is not glTF");
  expectTextError("hello", "is not glTF: begins with neither a GLB header nor JSON");
  expectTextError("  \r\n", "is not glTF: begins with neither a GLB header nor JSON");
  expectTextError("{hello", "is not glTF: neither a GLB header nor valid JSON");
  expectTextError("[1,2]", "is not glTF: the JSON is no object");
  expectTextError("{}", "is not glTF: the JSON has no \"asset\"");
  expectTextError(R"({"asset":{"version":"1.0"}})", "is glTF 1.0, which Rigel does not read");
  expectTextError(R"({"asset":{"version":1.0},"meshes":{}})", "is glTF 1, which Rigel does not read");
  expectTextError(R"({"accessors":{"a":{}},"scenes":{}})", "is glTF 1.0, which Rigel does not read");
  expectTextError(R"({"asset":{"version":"3.0"}})", "/asset/version: glTF version \"3.0\" is not known");
  expectTextError(R"({"asset":{"version":2}})", "/asset/version: must be a string");
  expectTextError(R"({"images":[{"uri":"%!QAAAQAAA5"}],"asset":{"version":""}})", "/asset/version: glTF version \"\"");
  expectTextError(R"({"asset":{"version":"2.0"},"x":)" + std::string(100, '[') + std::string(100, ']') + "}",
                  "nested deeper");
  expectTextError(std::string(2000000, '['), "nested deeper");
  expectTextError(R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1e999,1,1]}]})", "is not glTF");
  expectTextError("glTF", "GLB is cut short");
  expectTextError(std::string("glTF\1\0\0\0", 8) + std::string(20, '\0'), "is glTF 1.0");
  expectTextError(std::string("glTF\2\0\0\0\xff\xff\0\0", 12) + std::string(20, '\0'), "GLB header says 65535 bytes");
}

TEST(BadInput, IndicesThatPointNowhere) {
  struct Case {
    std::function<void(GltfMaker&)> damage;
    const char* message;
  };
  const Case cases[] = {
      {[](GltfMaker& g) { test::primitive(g)["attributes"]["POSITION"] = 99; },
       "/meshes/0/primitives/0/attributes/POSITION: accessor 99 does not exist (there are 2)"},
      {[](GltfMaker& g) { test::primitive(g)["attributes"]["POSITION"] = -1; },
       "/meshes/0/primitives/0/attributes/POSITION: must be a whole number of at least 0, is -1"},
      {[](GltfMaker& g) { test::primitive(g)["attributes"]["POSITION"] = 0.5; },
       "/meshes/0/primitives/0/attributes/POSITION: must be a whole number of at least 0, is 0.5"},
      {[](GltfMaker& g) { test::primitive(g)["attributes"]["POSITION"] = "0"; },
       "/meshes/0/primitives/0/attributes/POSITION: must be a whole number of at least 0, is string"},
      {[](GltfMaker& g) { test::primitive(g)["indices"] = 7; },
       "/meshes/0/primitives/0/indices: accessor 7 does not exist (there are 2)"},
      {[](GltfMaker& g) { test::primitive(g)["material"] = 0; },
       "/meshes/0/primitives/0/material: material 0 does not exist (there are 0)"},
      {[](GltfMaker& g) { g.json["nodes"][0]["mesh"] = 1; }, "/nodes/0/mesh: mesh 1 does not exist (there are 1)"},
      {[](GltfMaker& g) { g.json["nodes"][0]["skin"] = 0; }, "/nodes/0/skin: skin 0 does not exist (there are 0)"},
      {[](GltfMaker& g) { g.json["nodes"][0]["children"] = {3}; },
       "/nodes/0/children/0: node 3 does not exist (there are 1)"},
      {[](GltfMaker& g) { g.json["scenes"][0]["nodes"][0] = 5; },
       "/scenes/0/nodes/0: node 5 does not exist (there are 1)"},
      {[](GltfMaker& g) { g.json["scene"] = 2; }, "/scene: scene 2 does not exist (there are 1)"},
      {[](GltfMaker& g) { g.json["accessors"][0]["bufferView"] = 4; },
       "/accessors/0/bufferView: bufferView 4 does not exist (there are 2)"},
      {[](GltfMaker& g) { g.json["bufferViews"][0]["buffer"] = 1; },
       "/bufferViews/0/buffer: buffer 1 does not exist (there are 1)"},
      {[](GltfMaker& g) { g.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0; },
       "/nodes/0/extensions/KHR_lights_punctual/light: light 0 does not exist (there are 0)"},
  };
  for (const Case& c : cases) {
    GltfMaker g = GltfMaker::triangle();
    c.damage(g);
    test::expectLoadError(g, c.message);
  }
}

// They are valid: `rigel info` describes them; what needs something to light refuses them.
TEST(BadInput, NothingToLightIsNoted) {
  const std::function<void(GltfMaker&)> changes[] = {
      [](GltfMaker& g) { g.json["nodes"][0].erase("mesh"); },
      [](GltfMaker& g) { test::primitive(g)["mode"] = 1; },  // lines
      [](GltfMaker& g) {                                     // the mesh is in no scene
        g.json["nodes"].push_back({{"name", "empty"}});
        g.json["scenes"][0]["nodes"] = {1};
      },
      [](GltfMaker& g) {
        g.json = {{"asset", {{"version", "2.0"}}}};
      },
  };
  for (const auto& change : changes) {
    GltfMaker g = GltfMaker::triangle();
    g.embed();
    change(g);
    const test::TemporaryFolder folder;
    test::writeFile(folder / "t.gltf", g.json.dump());
    const auto scene = loadGltf(folder / "t.gltf");
    ASSERT_TRUE(scene) << scene.error().line();
    ASSERT_FALSE(scene->notes.empty());
    EXPECT_EQ(scene->notes.back(), "no mesh of triangles: there is nothing to light");
    EXPECT_TRUE(findObjects(*scene).empty());
  }
}

TEST(BadInput, AbsurdlyManyThingsAreRefusedBeforeTheyAreBuilt) {
  const auto list = [](const char* key, const std::string& entry, std::size_t count) {
    std::string text = R"({"asset":{"version":"2.0"},")" + std::string(key) + "\":[" + entry;
    for (std::size_t i = 1; i < count; ++i) text += "," + entry;
    return text + "]}";
  };
  expectTextError(list("nodes", "{}", 4194305), "JSON has more than 4194304 objects and arrays");
  expectTextError(list("bufferViews", "0", 524289), "/bufferViews: has 524289 entries, more than 524288");
}

// A pipe would wait for ever, a device never end.
TEST(BadInput, OnlyRegularFilesAreRead) {
  const auto scene = loadGltf("/dev/zero");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().line(), "/dev/zero: is no regular file");
}

TEST(BadInput, AChainOfThousandsOfJoints) {
  constexpr int kJoints = 20000;
  GltfMaker g = GltfMaker::skinned();
  json& nodes = g.json["nodes"];
  json& joints = g.json["skins"][0]["joints"];
  for (int i = 0; i < kJoints; ++i) {
    const std::size_t node = nodes.size();
    nodes[node - 1]["children"] = json::array({node});
    nodes.push_back(json::object());
    joints.push_back(node);
  }
  const test::TemporaryFolder folder;
  const auto scene = loadGltf(g.write(folder));
  ASSERT_TRUE(scene) << scene.error().line();
  EXPECT_EQ(scene->skins[0].joints.size(), kJoints + 2u);
  EXPECT_EQ(scene->skins[0].skeletonRoot, 1);
}

TEST(BadInput, RequiredExtensions) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "VENDOR_unheard_of"}) {
    GltfMaker g = GltfMaker::triangle();
    g.json["extensionsRequired"] = json::array({"KHR_lights_punctual", name});
    test::expectLoadError(g,
                          fmt::format("/extensionsRequired/1: the file requires {}, which Rigel does not read", name));
  }
}

TEST(BadInput, OneAccessorReadOverAndOverStaysBounded) {
  GltfMaker g = GltfMaker::triangle();
  g.json["accessors"][0]["count"] = 3000000;
  g.json["accessors"][0].erase("bufferView");
  test::primitive(g).erase("indices");
  for (int i = 0; i < 5; ++i) g.json["meshes"][0]["primitives"].push_back(test::primitive(g));
  const test::TemporaryFolder folder;
  const auto scene = loadGltf(g.write(folder));
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().line().find("/accessors/0: count 3000000 is absurd"), std::string::npos)
      << scene.error().line();
}

TEST(BadInput, ManyNodesShowingOneMeshStayBounded) {
  GltfMaker g = GltfMaker::triangle();
  std::vector<float> many(3 * 30000, 0.25f);
  test::primitive(g)["attributes"]["POSITION"] = g.addFloats(many, "VEC3");
  test::primitive(g).erase("indices");
  for (int i = 1; i < 4000; ++i) {
    g.json["nodes"].push_back({{"mesh", 0}});
    g.json["scenes"][0]["nodes"].push_back(i);
  }
  test::expectLoadError(g, "its nodes show 120000000 vertices, more than 25000000");
}

}  // namespace
}  // namespace rigel::tools
