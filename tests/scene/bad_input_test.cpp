// Every kind of damaged file and what is said about it: one line that names file, place and cause.
#include "scene_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace rigel::tools {
namespace {

using nlohmann::json;
using test::GltfMaker;

// The message must be `expected` after the file name.
void expectError(GltfMaker& g, const std::string& expected) {
  const test::TemporaryFolder folder;
  const auto file = g.write(folder);
  const auto scene = loadGltf(file);
  ASSERT_FALSE(scene) << "accepted, expected: " << expected;
  EXPECT_EQ(scene.error().line(), file.string() + ": " + expected);
  EXPECT_EQ(scene.error().line().find('\n'), std::string::npos);
}

void expectTextError(const std::string& content, const std::string& expectedPart) {
  const test::TemporaryFolder folder;
  test::writeFile(folder / "t.gltf", content);
  const auto scene = loadGltf(folder / "t.gltf");
  ASSERT_FALSE(scene) << "accepted, expected: " << expectedPart;
  EXPECT_NE(scene.error().line().find(expectedPart), std::string::npos) << scene.error().line();
  EXPECT_EQ(scene.error().line().find('\n'), std::string::npos);
}

json& primitive(GltfMaker& g) { return g.json["meshes"][0]["primitives"][0]; }

void addLight(GltfMaker& g, const json& light) {
  g.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
}

void addAnimation(GltfMaker& g, const std::string& path, const std::vector<float>& times,
                  const std::vector<float>& values, const std::string& type,
                  const std::string& interpolation = "LINEAR") {
  json animation;
  animation["samplers"].push_back({{"input", g.addFloats(times, "SCALAR")},
                                   {"output", g.addFloats(values, type)},
                                   {"interpolation", interpolation}});
  animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}});
  g.json["animations"].push_back(animation);
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
  expectTextError("hello", "is not glTF: neither a GLB header nor valid JSON");
  expectTextError("[1,2]", "is not glTF: the JSON is no object");
  expectTextError("{}", "is not glTF: the JSON has no \"asset\"");
  expectTextError(R"({"asset":{"version":"1.0"}})", "is glTF 1.0, which Rigel does not read");
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
      {[](GltfMaker& g) { primitive(g)["attributes"]["POSITION"] = 99; },
       "/meshes/0/primitives/0/attributes/POSITION: accessor 99 does not exist (there are 2)"},
      {[](GltfMaker& g) { primitive(g)["attributes"]["POSITION"] = -1; },
       "/meshes/0/primitives/0/attributes/POSITION: must be a whole number of at least 0, is -1"},
      {[](GltfMaker& g) { primitive(g)["attributes"]["POSITION"] = 0.5; },
       "/meshes/0/primitives/0/attributes/POSITION: must be a whole number of at least 0, is 0.5"},
      {[](GltfMaker& g) { primitive(g)["attributes"]["POSITION"] = "0"; },
       "/meshes/0/primitives/0/attributes/POSITION: must be a whole number of at least 0, is string"},
      {[](GltfMaker& g) { primitive(g)["indices"] = 7; },
       "/meshes/0/primitives/0/indices: accessor 7 does not exist (there are 2)"},
      {[](GltfMaker& g) { primitive(g)["material"] = 0; },
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
    expectError(g, c.message);
  }
}

TEST(BadInput, AccessorsThatDoNotFit) {
  struct Case {
    std::function<void(GltfMaker&)> damage;
    const char* message;
  };
  const Case cases[] = {
      {[](GltfMaker& g) { g.json["accessors"][0]["count"] = 4; },
       "/accessors/0: needs bytes 0 to 48 of bufferView 0, which has 36"},
      {[](GltfMaker& g) { g.json["accessors"][0]["byteOffset"] = 4; },
       "/accessors/0: needs bytes 4 to 40 of bufferView 0, which has 36"},
      {[](GltfMaker& g) { g.json["accessors"][0]["byteOffset"] = 9007199254740988; },
       "/accessors/0: needs bytes 9007199254740988 to 9007199254741024 of bufferView 0, which has 36"},
      {[](GltfMaker& g) { g.json["accessors"][0]["byteOffset"] = 2; },
       "/accessors/0: is not aligned to its component size 4"},
      {[](GltfMaker& g) { g.json["bufferViews"][0]["byteLength"] = 100; },
       "/bufferViews/0: ends at byte 100, buffer 0 has 42"},
      {[](GltfMaker& g) { g.json["bufferViews"][0]["byteOffset"] = 40; },
       "/bufferViews/0: ends at byte 76, buffer 0 has 42"},
      {[](GltfMaker& g) { g.json["bufferViews"][0]["byteStride"] = 8; },
       "/accessors/0: elements of 12 bytes overlap: byteStride of bufferView 0 is 8"},
      {[](GltfMaker& g) { g.json["bufferViews"][0]["byteStride"] = 256; },
       "/bufferViews/0/byteStride: must be a multiple of 4 from 4 to 252, is 256"},
      {[](GltfMaker& g) { g.json["accessors"][0]["type"] = "VEC2"; },
       "/meshes/0/primitives/0/attributes/POSITION: accessor 0 must be VEC3, is VEC2"},
      {[](GltfMaker& g) { g.json["accessors"][0]["type"] = "VEC5"; }, "/accessors/0/type: \"VEC5\" is none of glTF's"},
      {[](GltfMaker& g) { g.json["accessors"][0]["componentType"] = 5123; },
       "/meshes/0/primitives/0/attributes/POSITION: accessor 0 has component type UNSIGNED_SHORT, which is not allowed "
       "here"},
      {[](GltfMaker& g) { g.json["accessors"][0]["componentType"] = 5124; },
       "/accessors/0/componentType: 5124 is none of glTF's"},
      {[](GltfMaker& g) { g.json["accessors"][0]["count"] = 0; }, "/accessors/0/count: must be at least 1"},
      {[](GltfMaker& g) {
         g.json["accessors"][0]["count"] = 4294967296;
         g.json["accessors"][0].erase("bufferView");
       },
       "/accessors/0: count 4294967296 is absurd: the file's data would grow beyond all proportion to its size"},
      {[](GltfMaker& g) {
         g.embed();
         g.json["buffers"][0]["byteLength"] = 1000;
       },
       "/buffers/0: \"uri\" is not base64 data of exactly byteLength bytes"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}}});
       },
       "/accessors/0: is in buffer 0, which has neither \"uri\" nor a GLB binary chunk"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "gone.bin"}}});
       },
       "/buffers/0/uri: file does not exist"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "%zz.bin"}}});
       },
       "/buffers/0/uri: \"%zz.bin\" holds a broken % escape"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "http://a.b/c.bin"}}});
       },
       "/buffers/0/uri: \"http://a.b/c.bin\" is not a file beside this one"},
      {[](GltfMaker& g) {
         g.json["accessors"][0]["sparse"] = {
             {"count", 9}, {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
       },
       "/accessors/0/sparse/count: must be 1 to 3, is 9"},
      {[](GltfMaker& g) {
         const int indices = g.add(std::vector<std::uint16_t>{1, 1}, 5123, "SCALAR", 2);
         g.json["accessors"][0]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", 0}}}};
       },
       "/accessors/0/sparse/indices: index 1 (number 1) does not increase"},
      {[](GltfMaker& g) {
         const int indices = g.add(std::vector<std::uint16_t>{1, 3}, 5123, "SCALAR", 2);
         g.json["accessors"][0]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", 0}}}};
       },
       "/accessors/0/sparse/indices: index 3 (number 1) is beyond the accessor's 3 elements"},
  };
  for (const Case& c : cases) {
    GltfMaker g = GltfMaker::triangle();
    c.damage(g);
    expectError(g, c.message);
  }
}

TEST(BadInput, ABufferFileShorterThanItSays) {
  const test::TemporaryFolder folder;
  GltfMaker g = GltfMaker::triangle();
  test::writeFile(folder / "short.bin", g.bytes().substr(0, 20));
  g.json["buffers"] = json::array({{{"byteLength", g.bytes().size()}, {"uri", "short.bin"}}});
  const auto scene = loadGltf(g.write(folder));
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().line().find("/buffers/0: has 20 bytes, byteLength says 42"), std::string::npos);
}

TEST(BadInput, VerticesAndIndices) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["attributes"]["POSITION"] = g.addFloats({0, 0, 0, 1, 0, 0, 0, bad, 0}, "VEC3");
    expectError(g, std::string("/meshes/0/primitives/0/attributes/POSITION: accessor 2 holds ") +
                       (std::isnan(bad) ? "NaN" : "infinity") + " in element 2");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["indices"] = g.add(std::vector<std::uint16_t>{0, 1, 3}, 5123, "SCALAR", 3);
    expectError(g, "/meshes/0/primitives/0/indices: accessor 2 holds index 3 in element 2, there are 3 vertices");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["indices"] = g.add(std::vector<std::uint8_t>{0, 255, 1}, 5121, "SCALAR", 3);
    expectError(g, "/meshes/0/primitives/0/indices: accessor 2 holds the primitive-restart value 255 in element 1");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["attributes"]["NORMAL"] = g.addFloats({0, 0, 1, 0, 0, 1}, "VEC3");
    expectError(g, "/meshes/0/primitives/0/attributes/NORMAL: accessor 2 has 2 elements, POSITION has 3");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["mode"] = 9;
    expectError(g, "/meshes/0/primitives/0/mode: 9 is none of glTF's");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["targets"] = json::array({{{"NORMAL", 0}}});
    expectError(g, "/meshes/0/primitives/0/targets/0/NORMAL: the primitive itself has no NORMAL");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["targets"] = json::array({{{"POSITION", 0}}});
    g.json["meshes"][0]["weights"] = {1, 2};
    expectError(g, "/meshes/0/weights: must have 1 numbers, has 2");
  }
}

TEST(BadInput, NoMesh) {
  {
    GltfMaker g = GltfMaker::triangle();
    g.json["nodes"][0].erase("mesh");
    expectError(g, "no mesh: nothing to light");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    primitive(g)["mode"] = 1;  // lines
    expectError(g, "no mesh: nothing to light");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    g.json["nodes"].push_back({{"name", "empty"}});
    g.json["scenes"][0]["nodes"] = {1};  // the mesh is in no scene
    expectError(g, "no mesh: nothing to light");
  }
}

TEST(BadInput, Nodes) {
  const auto node = [](json fields) {
    GltfMaker g = GltfMaker::triangle();
    g.json["nodes"].push_back(std::move(fields));
    return g;
  };
  {
    GltfMaker g = node({{"children", {2}}});
    g.json["nodes"].push_back({{"children", {3}}});
    g.json["nodes"].push_back({{"children", {1}}});
    expectError(g, "/nodes/1: node loop: 1 < 3 < 2 < 1 (child < parent)");
  }
  {
    GltfMaker g = node({{"children", {1}}});
    expectError(g, "/nodes/1: node loop: 1 < 1 (child < parent)");
  }
  {
    GltfMaker g = node({{"children", {3}}});
    g.json["nodes"].push_back({{"children", {3}}});
    g.json["nodes"].push_back(json::object());
    expectError(g, "/nodes/2/children/0: node 3 already has the parent 1");
  }
  {
    GltfMaker g = node({{"children", {0}}});
    expectError(g, "/scenes/0/nodes/0: node 0 is a child of node 1");
  }
  {
    GltfMaker g = node({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", {1, 1, 1}}});
    expectError(g, "/nodes/1: has both matrix and scale");
  }
  {
    GltfMaker g = node({{"matrix", {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    expectError(g, "/nodes/1/matrix: is not affine: its last row must be 0 0 0 1");
  }
  {
    GltfMaker g = node({{"translation", {1, 2}}});
    expectError(g, "/nodes/1/translation: must have 3 numbers, has 2");
  }
  {
    GltfMaker g = node({{"translation", {1, 2, 1e200}}});
    expectError(g, "/nodes/1/translation/2: 1e+200 does not fit a float");
  }
  {
    GltfMaker g = node({{"translation", {1, 2, nullptr}}});
    expectError(g, "/nodes/1/translation/2: must be a number, is null");
  }
  {
    GltfMaker g = node({{"rotation", {0, 0, 0, 0}}});
    expectError(g, "/nodes/1/rotation: is no unit quaternion: its length is 0");
  }
  {
    GltfMaker g = node({{"weights", {1}}});
    expectError(g, "/nodes/1/weights: there are no morph targets for them");
  }
  {
    GltfMaker g = node({{"extras", {{"rigel", {{"static", 1}}}}}});
    expectError(g, "/nodes/1/extras/rigel/static: must be true or false, is number");
  }
}

TEST(BadInput, Skins) {
  struct Case {
    std::function<void(GltfMaker&)> damage;
    const char* message;
  };
  const auto weights = [](const std::vector<float>& w) {
    return [w](GltfMaker& g) { primitive(g)["attributes"]["WEIGHTS_0"] = g.addFloats(w, "VEC4"); };
  };
  const Case cases[] = {
      {[](GltfMaker& g) {
         primitive(g)["attributes"]["JOINTS_0"] =
             g.add(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 3);
       },
       "/nodes/0: vertex 1 of mesh 0 follows joint 2, skin 0 has 2"},
      {weights({1, 0, 0, 0, -.5f, 1.5f, 0, 0, 0, 1, 0, 0}),
       "/meshes/0/primitives/0/attributes/WEIGHTS_0: vertex 1 has the negative weight -0.5"},
      {[](GltfMaker& g) { primitive(g)["attributes"].erase("WEIGHTS_0"); },
       "/meshes/0/primitives/0/attributes: has JOINTS_0 without WEIGHTS_0"},
      {[](GltfMaker& g) {
         primitive(g)["attributes"].erase("WEIGHTS_0");
         primitive(g)["attributes"].erase("JOINTS_0");
       },
       "/nodes/0: has a skin, but primitive 0 of mesh 0 has no JOINTS_0 and WEIGHTS_0"},
      {[](GltfMaker& g) {
         g.json["skins"][0]["joints"] = {1, 9};
       },
       "/skins/0/joints/1: node 9 does not exist (there are 3)"},
      {[](GltfMaker& g) {
         g.json["skins"][0]["joints"] = {1, 1};
       },
       "/skins/0/joints/1: node 1 is listed twice"},
      {[](GltfMaker& g) { g.json["skins"][0]["joints"] = json::array(); }, "/skins/0/joints: must not be empty"},
      {[](GltfMaker& g) { g.json["skins"][0].erase("joints"); }, "/skins/0: has no \"joints\""},
      {[](GltfMaker& g) { g.json["skins"][0]["skeleton"] = 4; },
       "/skins/0/skeleton: node 4 does not exist (there are 3)"},
      {[](GltfMaker& g) {
         g.json["skins"][0]["inverseBindMatrices"] =
             g.addFloats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
       },
       "/skins/0/inverseBindMatrices: accessor 4 has 1 matrices for 2 joints"},
      {[](GltfMaker& g) {
         g.json["skins"][0]["inverseBindMatrices"] = g.addFloats(std::vector<float>(32, 0.f), "MAT4");
       },
       "/skins/0/inverseBindMatrices: matrix 0 is not affine: its last row must be 0 0 0 1"},
      {[](GltfMaker& g) { g.json["scenes"][0]["nodes"] = {0}; },
       "/nodes/0: joint node 1 of skin 0 is not in the scene"},
      {[](GltfMaker& g) { g.json["nodes"][0].erase("mesh"); }, "/nodes/0: has a skin but no mesh"},
  };
  for (const Case& c : cases) {
    GltfMaker g = GltfMaker::skinned();
    c.damage(g);
    expectError(g, c.message);
  }
}

TEST(BadInput, Animations) {
  const auto expectAnimationError = [](const std::string& path, const std::vector<float>& times,
                                       const std::vector<float>& values, const std::string& type,
                                       const std::string& kind, const std::string& message) {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, path, times, values, type, kind);
    expectError(g, message);
  };
  const std::vector<float> two = {0, 0, 0, 1, 1, 1};
  expectAnimationError("translation", {0, 0}, two, "VEC3", "LINEAR",
                       "/animations/0/samplers/0/input: accessor 2: key 1 at 0 s does not come after key 0 at 0 s");
  expectAnimationError("translation", {1, 0.5f}, two, "VEC3", "LINEAR",
                       "/animations/0/samplers/0/input: accessor 2: key 1 at 0.5 s does not come after key 0 at 1 s");
  expectAnimationError("translation", {-1, 0}, two, "VEC3", "LINEAR",
                       "/animations/0/samplers/0/input: accessor 2 begins at the negative time -1");
  expectAnimationError("translation", {0, 1, 2}, two, "VEC3", "LINEAR",
                       "/animations/0/samplers/0/output: accessor 3 holds 6 numbers; 3 keys of 3 need 9");
  expectAnimationError("translation", {0, 1}, two, "VEC3", "CUBICSPLINE",
                       "/animations/0/samplers/0/output: accessor 3 holds 6 numbers; 2 keys of 9 need 18");
  expectAnimationError("translation", {0, 1}, two, "VEC3", "SMOOTH",
                       "/animations/0/samplers/0/interpolation: \"SMOOTH\" is none of STEP, LINEAR, CUBICSPLINE");
  expectAnimationError("rotation", {0, 1}, two, "VEC3", "LINEAR",
                       "/animations/0/samplers/0/output: accessor 3 must be VEC4, is VEC3");
  expectAnimationError("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", "LINEAR",
                       "/animations/0/samplers/0/output: key 1 is no unit quaternion: its length is 0");
  expectAnimationError("weights", {0, 1}, {0, 1}, "SCALAR", "LINEAR",
                       "/animations/0/channels/0/target: moves morph weights of node 0, which has no morph targets");
  expectAnimationError("translation", {0, 1}, {0, 0, 0, std::nanf(""), 1, 1}, "VEC3", "LINEAR",
                       "/animations/0/samplers/0/output: accessor 3 holds NaN in element 1");
  {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, "translation", {0, 1}, two, "VEC3");
    g.json["animations"][0]["channels"].push_back(g.json["animations"][0]["channels"][0]);
    expectError(g, "/animations/0/channels/1: moves the same property of node 0 as a channel before it");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, "translation", {0, 1}, two, "VEC3");
    g.json["animations"][0]["channels"][0]["sampler"] = 1;
    expectError(g, "/animations/0/channels/0/sampler: sampler 1 does not exist (there are 1)");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, "translation", {0, 1}, two, "VEC3");
    g.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    expectError(g, "/animations/0/channels/0/target: moves node 0, whose transform is a fixed matrix");
  }
}

TEST(BadInput, LightsAndMaterials) {
  const std::string at = "/extensions/KHR_lights_punctual/lights/0";
  const std::pair<json, std::string> lights[] = {
      {{{"type", "point"}, {"extras", {{"radius", -0.5}}}}, at + "/extras/radius: must be at least 0, is -0.5"},
      {{{"type", "point"}, {"extras", {{"radius", "big"}}}}, at + "/extras/radius: must be a number, is string"},
      {{{"type", "point"}, {"intensity", 1e30}, {"extras", {{"radius", 1e-30}}}},
       at + "/extras/radius: 1e-30 is so small that the radiance does not fit a float"},
      {{{"type", "point"}, {"intensity", -1}}, at + "/intensity: must be at least 0, is -1"},
      {{{"type", "point"}, {"intensity", 1e60}}, at + "/intensity: 1e+60 does not fit a float"},
      {{{"type", "point"}, {"intensity", nullptr}}, at + "/intensity: must be a number, is null"},
      {{{"type", "point"}, {"color", {1, 1}}}, at + "/color: must have 3 numbers, has 2"},
      {{{"type", "point"}, {"color", {1, -1, 1}}}, at + "/color/1: must be at least 0, is -1"},
      {{{"type", "point"}, {"range", 0}}, at + "/range: must be more than 0, is 0"},
      {{{"type", "area"}}, at + "/type: \"area\" is none of directional, point, spot"},
      {{{"intensity", 1}}, at + ": has no \"type\""},
      {{{"type", "spot"}}, at + ": has no \"spot\""},
      {{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}},
       at + "/spot: innerConeAngle 0.5 must be less than outerConeAngle 0.5"},
      {{{"type", "spot"}, {"spot", {{"innerConeAngle", -0.5}}}},
       at + "/spot/innerConeAngle: must be at least 0, is -0.5"},
      {{{"type", "spot"}, {"spot", {{"outerConeAngle", 4}}}}, at + "/spot/outerConeAngle: must be at most pi, is 4"},
  };
  for (const auto& [light, message] : lights) {
    GltfMaker g = GltfMaker::triangle();
    addLight(g, light);
    expectError(g, message);
  }
  for (const double wrap : {-0.3, 1.01}) {
    GltfMaker g = GltfMaker::triangle();
    g.json["materials"] = json::array({{{"extras", {{"wrap", wrap}}}}});
    expectError(g, fmt::format("/materials/0/extras/wrap: must lie in [-0.25, 1], is {}", wrap));
  }
  GltfMaker g = GltfMaker::triangle();
  g.json["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0, 0, 1}}}}}});
  expectError(g, "/materials/0/pbrMetallicRoughness/baseColorFactor: must lie in [0, 1], has 2");
}

TEST(BadInput, RequiredExtensions) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "VENDOR_unheard_of"}) {
    GltfMaker g = GltfMaker::triangle();
    g.json["extensionsRequired"] = json::array({"KHR_lights_punctual", name});
    expectError(g, fmt::format("/extensionsRequired/1: the file requires {}, which Rigel does not read", name));
  }
}

TEST(BadInput, OneAccessorReadOverAndOverStaysBounded) {
  GltfMaker g = GltfMaker::triangle();
  g.json["accessors"][0]["count"] = 3000000;
  g.json["accessors"][0].erase("bufferView");
  primitive(g).erase("indices");
  for (int i = 0; i < 5; ++i) g.json["meshes"][0]["primitives"].push_back(primitive(g));
  const test::TemporaryFolder folder;
  const auto scene = loadGltf(g.write(folder));
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().line().find("/accessors/0: count 3000000 is absurd"), std::string::npos)
      << scene.error().line();
}

TEST(BadInput, ManyNodesShowingOneMeshStayBounded) {
  GltfMaker g = GltfMaker::triangle();
  std::vector<float> many(3 * 30000, 0.25f);
  primitive(g)["attributes"]["POSITION"] = g.addFloats(many, "VEC3");
  for (int i = 1; i < 4000; ++i) {
    g.json["nodes"].push_back({{"mesh", 0}});
    g.json["scenes"][0]["nodes"].push_back(i);
  }
  expectError(g, "its nodes show 120000000 vertices, more than 100000000");
}

}  // namespace
}  // namespace rigel::tools
