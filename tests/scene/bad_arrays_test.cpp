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
       "/buffers/0: has 42 bytes, byteLength says 1000"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "data:application/gltf-buffer;base64,AA*A"}}});
       },
       "/buffers/0/uri: \"data:application/gltf-buffer;base64\" is not valid base64 data"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "data:;base64"}}});
       },
       "/buffers/0/uri: \"data:;base64\": a data URI needs a comma before its data"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", ":"}}});
       },
       "/buffers/0/uri: \":\" is no URI"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", ""}}});
       },
       "/buffers/0/uri: is empty"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "."}}});
       },
       "/buffers/0/uri: is a directory"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}, {"uri", "/dev/zero"}}});
       },
       "/buffers/0/uri: is no regular file"},
      {[](GltfMaker& g) {
         g.embed();
         g.json["buffers"][0]["byteLength"] = 9007199254740992;
       },
       "/buffers/0: the buffers have more than 1073741824 bytes"},
      {[](GltfMaker& g) { g.json["bufferViews"][1]["byteStride"] = 8; },
       "/bufferViews/1/byteStride: is 8, the view has 6 bytes"},
      {[](GltfMaker& g) {  // which nobody reads
         g.json["accessors"].push_back(
             {{"bufferView", 1}, {"componentType", 5121}, {"type", "MAT2"}, {"count", 1}, {"byteOffset", 0}});
       },
       "/accessors/2: needs bytes 0 to 8 of bufferView 1, which has 6"},
      {[](GltfMaker& g) {
         g.json["accessors"][0].erase("bufferView");
         g.json["accessors"][0]["byteOffset"] = 4;
       },
       "/accessors/0/byteOffset: is 4, but there is no bufferView"},
      {[](GltfMaker& g) {
         g.json["buffers"] = json::array({{{"byteLength", 42}}});
         g.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 1}};
       },
       "/bufferViews/0: is compressed by EXT_meshopt_compression, which Rigel does not read"},
      {[](GltfMaker& g) {
         g.json["accessors"][0].erase("bufferView");
         test::primitive(g)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
       },
       "/meshes/0/primitives/0: is compressed by KHR_draco_mesh_compression, which Rigel does not read"},
      {[](GltfMaker& g) {
         const int indices = g.add(std::vector<std::uint32_t>{1}, 5125, "SCALAR", 1);
         g.json["bufferViews"][indices]["byteStride"] = 4;
         g.json["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5125}}},
                                             {"values", {{"bufferView", 0}}}};
       },
       "/accessors/0/sparse/indices: bufferView 2 has a byteStride, which sparse data cannot have"},
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

TEST(BadInput, MorphTargetsOfNothingStayBounded) {
  GltfMaker g = GltfMaker::triangle();
  test::primitive(g)["attributes"]["POSITION"] = g.addFloats(std::vector<float>(3 * 5000, 0.25f), "VEC3");
  for (int i = 0; i < 6000; ++i) test::primitive(g)["targets"].push_back(json::object());
  const test::TemporaryFolder folder;
  const auto scene = loadGltf(g.write(folder));
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().line().find("count 15000 is absurd"), std::string::npos) << scene.error().line();
}

TEST(BadInput, WeightsOfPrimitivesThatAreNotDrawn) {
  GltfMaker g = GltfMaker::skinned();
  json ignored = test::primitive(g);
  ignored["mode"] = 0;
  ignored["attributes"]["WEIGHTS_0"] = g.addFloats({-1, 2, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  g.json["meshes"].push_back({{"primitives", json::array({ignored})}});
  test::expectLoadError(g, "/meshes/1/primitives/0/attributes/WEIGHTS_0: vertex 0 has the negative weight -1");
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
