// Accessors, buffers and the arrays of a mesh that do not hold what they should.
#include "bad_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace rigel::tools {
namespace {

using nlohmann::json;
using test::GltfMaker;

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
    test::expectLoadError(g, c.message);
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
    test::primitive(g)["attributes"]["POSITION"] = g.addFloats({0, 0, 0, 1, 0, 0, 0, bad, 0}, "VEC3");
    test::expectLoadError(g, std::string("/meshes/0/primitives/0/attributes/POSITION: accessor 2 holds ") +
                                 (std::isnan(bad) ? "NaN" : "infinity") + " in element 2");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    test::primitive(g)["indices"] = g.add(std::vector<std::uint16_t>{0, 1, 3}, 5123, "SCALAR", 3);
    test::expectLoadError(
        g, "/meshes/0/primitives/0/indices: accessor 2 holds index 3 in element 2, there are 3 vertices");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    test::primitive(g)["indices"] = g.add(std::vector<std::uint8_t>{0, 255, 1}, 5121, "SCALAR", 3);
    test::expectLoadError(
        g, "/meshes/0/primitives/0/indices: accessor 2 holds the primitive-restart value 255 in element 1");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    test::primitive(g)["attributes"]["NORMAL"] = g.addFloats({0, 0, 1, 0, 0, 1}, "VEC3");
    test::expectLoadError(g, "/meshes/0/primitives/0/attributes/NORMAL: accessor 2 has 2 elements, POSITION has 3");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    test::primitive(g)["mode"] = 9;
    test::expectLoadError(g, "/meshes/0/primitives/0/mode: 9 is none of glTF's");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    test::primitive(g)["targets"] = json::array({{{"NORMAL", 0}}});
    test::expectLoadError(g, "/meshes/0/primitives/0/targets/0/NORMAL: the primitive itself has no NORMAL");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    test::primitive(g)["targets"] = json::array({{{"POSITION", 0}}});
    g.json["meshes"][0]["weights"] = {1, 2};
    test::expectLoadError(g, "/meshes/0/weights: must have 1 numbers, has 2");
  }
}

}  // namespace
}  // namespace rigel::tools
