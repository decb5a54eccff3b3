// What good files may hold: all primitive modes, sparse and packed accessors, lights, extras; and what is noted.
#include "scene/pose.h"
#include "scene_files.h"

#include <rigel/sh.h>

#include <gmock/gmock.h>

#include <fmt/format.h>
#include <cmath>

#include <cstring>

namespace rigel::tools {
namespace {

using nlohmann::json;
using test::GltfMaker;
using test::primitive;
using testing::ElementsAre;
using testing::IsEmpty;

Scene load(GltfMaker& g) {
  const test::TemporaryFolder folder;
  auto scene = loadGltf(g.write(folder));
  if (!scene) {
    ADD_FAILURE() << scene.error().line();
    return {};
  }
  return *std::move(scene);
}

std::vector<glm::uvec3> trianglesOf(std::size_t mode, const std::vector<std::uint16_t>& indices,
                                    std::vector<std::string>* notes = nullptr) {
  GltfMaker g = GltfMaker::triangle();
  primitive(g)["attributes"]["POSITION"] = g.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  primitive(g)["indices"] = g.add(indices, 5123, "SCALAR", indices.size());
  primitive(g)["mode"] = mode;
  const Scene scene = load(g);
  if (notes != nullptr) *notes = scene.notes;
  return scene.meshes.at(0).primitives.at(0).triangles;
}

TEST(Load, TriangleLists) {
  std::vector<std::string> notes;
  EXPECT_THAT(trianglesOf(4, {0, 1, 2, 2, 1, 3, 4, 4}, &notes), ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(2, 1, 3)));
  EXPECT_THAT(notes, ElementsAre("/meshes/0/primitives/0: 2 left-over indices ignored"));
}

TEST(Load, StripsAlternateAndDropTheirStitches) {
  EXPECT_THAT(trianglesOf(5, {0, 1, 2, 3, 4}),
              ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(2, 1, 3), glm::uvec3(2, 3, 4)));
  EXPECT_THAT(trianglesOf(5, {0, 1, 2, 2, 3, 3, 4, 1}), ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(4, 3, 1)));
}

TEST(Load, Fans) {
  EXPECT_THAT(trianglesOf(6, {0, 1, 2, 3, 4}),
              ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3), glm::uvec3(0, 3, 4)));
}

TEST(Load, PrimitivesWithoutIndices) {
  GltfMaker g = GltfMaker::triangle();
  primitive(g).erase("indices");
  EXPECT_THAT(load(g).meshes[0].primitives[0].triangles, ElementsAre(glm::uvec3(0, 1, 2)));
}

TEST(Load, PointsAndLinesAreNoted) {
  GltfMaker g = GltfMaker::triangle();
  json points = primitive(g), lines = primitive(g);
  points["mode"] = 0;
  lines["mode"] = 3;
  g.json["meshes"][0]["primitives"].push_back(points);
  g.json["meshes"][0]["primitives"].push_back(lines);
  const Scene scene = load(g);
  EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
  EXPECT_THAT(scene.notes, ElementsAre("/meshes/0/primitives/1: points ignored: only triangles are lit",
                                       "/meshes/0/primitives/2: lines ignored: only triangles are lit"));
}

TEST(Load, SparseAccessorsReplaceElements) {
  GltfMaker g = GltfMaker::triangle();
  const int indices = g.add(std::vector<std::uint8_t>{2}, 5121, "SCALAR", 1);
  const int values = g.addFloats({7, 8, 9}, "VEC3");
  const json sparse = {{"count", 1},
                       {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                       {"values", {{"bufferView", values}}}};
  g.json["accessors"][0]["sparse"] = sparse;
  EXPECT_EQ(load(g).meshes[0].primitives[0].positions[2], glm::vec3(7, 8, 9));
  // Without a view of its own the rest is zero.
  g.json["accessors"][0].erase("bufferView");
  const Scene scene = load(g);
  EXPECT_EQ(scene.meshes[0].primitives[0].positions[1], glm::vec3(0));
  EXPECT_EQ(scene.meshes[0].primitives[0].positions[2], glm::vec3(7, 8, 9));
}

TEST(Load, InterleavedVertices) {
  GltfMaker g = GltfMaker::triangle();
  std::vector<float> both;
  for (int v = 0; v < 3; ++v) {
    both.insert(both.end(), {static_cast<float>(v), 0.5f * static_cast<float>(v), 1, 0, 0, 1});
  }
  const int accessor = g.add(both, 5126, "VEC3", 3);
  g.json["bufferViews"][accessor]["byteStride"] = 24;
  primitive(g)["attributes"]["POSITION"] = accessor;
  json normals = g.json["accessors"][accessor];
  normals["byteOffset"] = 12;
  g.json["accessors"].push_back(normals);
  primitive(g)["attributes"]["NORMAL"] = accessor + 1;
  const Scene scene = load(g);
  EXPECT_EQ(scene.meshes[0].primitives[0].positions[2], glm::vec3(2, 1, 1));
  EXPECT_EQ(scene.meshes[0].primitives[0].normals[2], glm::vec3(0, 0, 1));
}

TEST(Load, QuantizedMeshesNeedTheirExtension) {
  GltfMaker g = GltfMaker::triangle();
  primitive(g)["attributes"]["POSITION"] =
      g.add(std::vector<std::int16_t>{0, 0, 0, 0, 32767, -32768, -32767, 0, 0, 16384, 0, 0}, 5122, "VEC3", 3, true);
  g.json["bufferViews"].back()["byteStride"] = 8;
  primitive(g)["attributes"]["NORMAL"] =
      g.add(std::vector<std::int8_t>{0, 0, 127, 0, 127, 0, 0, 0, -128, 0, 0, 0}, 5120, "VEC3", 3, true);
  g.json["bufferViews"].back()["byteStride"] = 4;
  const test::TemporaryFolder folder;
  EXPECT_FALSE(loadGltf(g.write(folder)));
  g.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  g.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  const Scene scene = load(g);
  const Primitive& p = scene.meshes[0].primitives[0];
  EXPECT_EQ(p.positions[1], glm::vec3(1, -1, -1));
  EXPECT_EQ(p.positions[2].y, static_cast<float>(16384 / 32767.));
  EXPECT_EQ(p.normals[2], glm::vec3(-1, 0, 0));
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST(Load, NormalizedWeightsAndSecondInfluenceSet) {
  GltfMaker g = GltfMaker::skinned();
  auto& attributes = primitive(g)["attributes"];
  attributes["WEIGHTS_0"] =
      g.add(std::vector<std::uint8_t>{51, 51, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 3, true);
  attributes["JOINTS_1"] = g.add(std::vector<std::uint16_t>{1, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0}, 5123, "VEC4", 3);
  attributes["WEIGHTS_1"] =
      g.add(std::vector<std::uint16_t>{39321, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 5123, "VEC4", 3, true);
  const Scene scene = load(g);
  const auto& in = scene.meshes[0].primitives[0].influences;
  EXPECT_NEAR(in[0].weight[0], 0.2, 1e-6);
  EXPECT_NEAR(in[0].weight[4], 0.6, 1e-6);
  EXPECT_EQ(in[0].joint[4], 1);
  EXPECT_EQ(in[1].joint[5], 0);  // 9 exists nowhere, but has no weight
  EXPECT_EQ(in[2].weight[0], 1);
  EXPECT_THAT(scene.notes, ElementsAre("/meshes/0/primitives/0/attributes: 1 vertices without weights follow joint 0"));
}

TEST(Load, WeightsAreNormalized) {
  GltfMaker g = GltfMaker::skinned();
  primitive(g)["attributes"]["WEIGHTS_0"] = g.addFloats({2, 0, 0, 0, 1, 3, 0, 0, 0.7f, 0.2f, 0.1f, 0}, "VEC4");
  const Scene scene = load(g);
  for (const Influences& in : scene.meshes[0].primitives[0].influences) {
    double sum = 0;
    for (const float w : in.weight) sum += w;
    EXPECT_NEAR(sum, 1, 1e-6);
  }
  EXPECT_EQ(scene.meshes[0].primitives[0].influences[1].weight[1], 0.75f);
  EXPECT_THAT(scene.notes,
              ElementsAre("/meshes/0/primitives/0/attributes: weights of 2 vertices did not sum to 1; rescaled"));
}

TEST(Load, SkeletonRootIsTheClosestCommonAncestor) {
  GltfMaker g = GltfMaker::skinned();
  EXPECT_EQ(load(g).skins[0].skeletonRoot, 1);  // joint 1 is the parent of joint 2
  g.json["nodes"][1]["children"] = {2, 3};
  g.json["nodes"].push_back({{"name", "other"}});
  g.json["skins"][0]["joints"] = {2, 3};
  EXPECT_EQ(load(g).skins[0].skeletonRoot, 1);
  g.json["skins"][0]["skeleton"] = 3;  // not above node 2
  const Scene scene = load(g);
  EXPECT_EQ(scene.skins[0].skeletonRoot, 1);
  EXPECT_THAT(scene.notes, ElementsAre("/skins/0/skeleton: node 3 is not above all joints; node 1 is used"));
}

TEST(Load, Lights) {
  GltfMaker g = GltfMaker::triangle();
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  json& lights = g.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back({{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0}}, {"name", "sun"}});
  lights.push_back({{"type", "point"}});
  lights.push_back({{"type", "spot"}, {"intensity", 2}, {"range", 7}, {"spot", {{"innerConeAngle", 0.1}}}});
  lights.push_back(
      {{"type", "point"}, {"intensity", 10}, {"range", 5}, {"extras", {{"radius", 0.5}}}, {"name", "ball"}});
  lights.push_back({{"type", "point"}, {"intensity", 4}, {"extras", "anything"}});
  for (int i = 0; i < 5; ++i) {
    json node;
    node["extensions"]["KHR_lights_punctual"]["light"] = i;
    g.json["nodes"].push_back(node);
  }
  const Scene scene = load(g);
  ASSERT_EQ(scene.lights.size(), 5u);
  EXPECT_EQ(std::get<DirectionalLight>(scene.lights[0].shape).irradiance, (Rgb{3, 1.5f, 0}));
  const auto& point = std::get<PointLight>(scene.lights[1].shape);
  EXPECT_EQ(point.intensity, (Rgb{1, 1, 1}));
  EXPECT_EQ(point.radius, kDefaultPointRadius);
  EXPECT_EQ(point.range, kNoRange);
  const auto& spot = std::get<SpotLight>(scene.lights[2].shape);
  EXPECT_EQ(spot.innerAngle, 0.1f);
  EXPECT_EQ(spot.outerAngle, static_cast<float>(kPi / 4));
  EXPECT_EQ(spot.range, 7);
  const auto& sphere = std::get<SphereLight>(scene.lights[3].shape);
  EXPECT_EQ(sphere.radius, 0.5f);
  EXPECT_EQ(sphere.radiance.r, static_cast<float>(10 / (kPi * 0.25)));
  EXPECT_EQ(std::get<PointLight>(scene.lights[scene.nodes[5].light].shape).intensity.r, 4);
  EXPECT_THAT(scene.notes, ElementsAre("range of sphere light \"ball\" ignored"));
}

TEST(Load, DisksOutOfPunctualLights) {
  GltfMaker g = GltfMaker::triangle();
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  json& lights = g.json["extensions"]["KHR_lights_punctual"]["lights"];
  const json disk = {{"rigel", {{"type", "disk"}, {"radius", 0.5}}}};
  lights.push_back({{"type", "point"}, {"intensity", 10}, {"color", {1, 0.5, 0}}, {"extras", disk}});
  lights.push_back({{"type", "spot"}, {"name", "panel"}, {"range", 5}, {"spot", json::object()}, {"extras", disk}});
  lights.push_back({{"type", "spot"}, {"spot", {{"outerConeAngle", kPi / 2}}}, {"extras", disk}});
  lights.back()["extras"]["rigel"]["twoSided"] = true;
  const Scene scene = load(g);
  ASSERT_EQ(scene.lights.size(), 3u);
  const auto& first = std::get<DiskLight>(scene.lights[0].shape);
  EXPECT_EQ(first.radius, 0.5f);
  EXPECT_EQ(first.direction, (Vec3{0, 0, -1}));
  EXPECT_FALSE(first.twoSided);
  // From afar and on its axis, pi r^2 L is the intensity.
  EXPECT_EQ(first.radiance, (Rgb{static_cast<float>(10 / (kPi * 0.25)), static_cast<float>(5 / (kPi * 0.25)), 0}));
  EXPECT_FALSE(scene.lights[0].scalesWithNode);
  EXPECT_TRUE(std::get<DiskLight>(scene.lights[2].shape).twoSided);
  EXPECT_THAT(scene.notes, ElementsAre("range of disk light \"panel\" ignored",
                                       "cone of disk light \"panel\" ignored: disks emit into the whole half space"));
}

TEST(Load, AreaLightsOfTheDraft) {
  GltfMaker g = GltfMaker::triangle();
  g.json["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"type", "point"}});
  json& lights = g.json["extensions"]["EXT_lights_area"]["lights"];
  lights.push_back({{"type", "rect"}, {"name", "window"}, {"rect", {{"aspect", 2}}}});
  lights.push_back({{"type", "disk"}, {"size", 3}, {"intensity", 200}, {"color", {1, 0.5, 0}}, {"name", "lamp"}});
  lights.push_back({{"type", "disk"}, {"extras", {{"rigel", {{"twoSided", true}}}}}});
  for (int i = 0; i < 3; ++i) {
    json node;
    node["extensions"]["EXT_lights_area"]["light"] = i;
    g.json["nodes"].push_back(node);
  }
  g.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;  // beside the rect, which is not read
  g.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_lights_area"};
  g.json["extensionsRequired"] = {"EXT_lights_area"};
  const Scene scene = load(g);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.nodes[1].light, 0);
  EXPECT_EQ(scene.nodes[2].light, 1);
  EXPECT_EQ(scene.nodes[3].light, 2);
  EXPECT_TRUE(scene.lights[1].scalesWithNode);
  const auto& lamp = std::get<DiskLight>(scene.lights[1].shape);
  EXPECT_EQ(lamp.radius, 1.5f);
  EXPECT_EQ(lamp.radiance, (Rgb{200, 100, 0}));
  EXPECT_FALSE(lamp.twoSided);
  const auto& plain = std::get<DiskLight>(scene.lights[2].shape);
  EXPECT_EQ(plain.radius, 0.5f);
  EXPECT_EQ(plain.radiance, (Rgb{1000, 1000, 1000}));
  EXPECT_TRUE(plain.twoSided);
  EXPECT_THAT(scene.notes,
              ElementsAre("area light \"window\" ignored: rect is not supported by this version (disk is)"));
}

TEST(Load, ExtrasMarkNodesAndMaterials) {
  GltfMaker g = GltfMaker::triangle();
  g.json["nodes"][0]["extras"] = {{"rigel", {{"static", true}, {"object", true}}}, {"other", {1, 2}}};
  g.json["materials"] = json::array({{{"extras", {{"wrap", 0.5}}}, {"name", "cloth"}}, {{"extras", 3}}});
  const Scene scene = load(g);
  EXPECT_TRUE(scene.nodes[0].isStatic);
  EXPECT_TRUE(scene.nodes[0].isObject);
  EXPECT_EQ(scene.materials[0].wrap, 0.5f);
  EXPECT_EQ(scene.materials[1].wrap, 0);
}

TEST(Load, WhatIsNotUsedIsNoted) {
  GltfMaker g = GltfMaker::triangle();
  g.json["cameras"] = json::array({{{"type", "perspective"}}});
  g.json["images"] =
      json::array({{{"uri", "not there.png"}}, {{"uri", "%!QAAAQAAA5"}}, {{"uri", "data:image/png;base64,@@"}}});
  g.json["textures"] = json::array({{{"source", 9}}});
  g.json["extensionsUsed"] = {"KHR_materials_unlit", "EXT_lights_image_based"};
  g.json["extensionsRequired"] = {"KHR_texture_transform"};
  g.json["materials"] = json::array({{{"name", "lamp"}, {"emissiveFactor", {1, 1, 1}}}});
  g.json["scenes"].push_back(json::object());
  EXPECT_THAT(load(g).notes,
              ElementsAre("extension EXT_lights_image_based ignored: not supported by this version",
                          "extension KHR_materials_unlit ignored: not supported by this version",
                          "extension KHR_texture_transform ignored: not supported by this version",
                          "1 camera(s) ignored", "textures ignored: colours are the materials' base colour factors",
                          "emission of material \"lamp\" ignored: surfaces are no lights",
                          "1 of 2 scenes ignored: scene 0 is used"));
}

TEST(Load, Animations) {
  GltfMaker g = GltfMaker::triangle();
  json animation;
  const int times = g.addFloats({0.5f, 2}, "SCALAR");
  animation["samplers"].push_back({{"input", times}, {"output", g.addFloats({1, 2, 3, 4, 5, 6}, "VEC3")}});
  animation["samplers"].push_back(
      {{"input", times},
       {"output", g.add(std::vector<std::int8_t>{0, 0, 0, 127, 127, 0, 0, 0}, 5120, "VEC4", 2, true)},
       {"interpolation", "STEP"}});
  animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}});
  animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}});
  animation["channels"].push_back({{"sampler", 0}, {"target", {{"path", "translation"}}}});
  animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "pointer"}}}});
  g.json["animations"].push_back(animation);
  animation["name"] = "named";
  g.json["animations"].push_back(animation);
  const Scene scene = load(g);
  ASSERT_EQ(scene.animations.size(), 2u);
  EXPECT_EQ(scene.animations[0].name, "clip 0");
  EXPECT_EQ(scene.animations[1].name, "named");
  EXPECT_EQ(scene.animations[0].duration, 2);
  ASSERT_EQ(scene.animations[0].channels.size(), 2u);
  EXPECT_EQ(scene.animations[0].channels[0].interpolation, Interpolation::linear);
  EXPECT_EQ(scene.animations[0].channels[1].interpolation, Interpolation::step);
  EXPECT_THAT(scene.animations[0].channels[1].values, ElementsAre(0, 0, 0, 1, 1, 0, 0, 0));
  EXPECT_EQ(scene.notes.size(), 4u);
  EXPECT_EQ(scene.notes[0], "/animations/0/channels/2: ignored: it moves no node (path \"translation\")");
  EXPECT_EQ(scene.notes[1], "/animations/0/channels/3: ignored: path \"pointer\" is not supported");
}

TEST(Load, BufferFilesBesideTheDocumentWithEscapedNames) {
  const test::TemporaryFolder folder;
  GltfMaker g = GltfMaker::triangle();
  std::filesystem::create_directories(folder / "a b");
  test::writeFile(folder / "a b" / "d%1.bin", g.bytes() + "more than byteLength");
  g.json["buffers"] = json::array({{{"byteLength", g.bytes().size()}, {"uri", "a%20b/d%251.bin"}}});
  const auto scene = loadGltf(g.write(folder));
  ASSERT_TRUE(scene) << scene.error().line();
  EXPECT_EQ(scene->meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0));
}

TEST(Load, DataUrisOfAnyNameAndType) {
  GltfMaker g = GltfMaker::triangle();
  const std::string base64 = test::encodeBase64(g.bytes());
  std::string padless = base64, escapedPadding = base64, percent;
  while (padless.ends_with('=')) padless.pop_back();
  for (std::size_t at; (at = escapedPadding.find('=')) != std::string::npos;) escapedPadding.replace(at, 1, "%3D");
  for (const char c : g.bytes()) percent += fmt::format("%{:02x}", static_cast<unsigned char>(c));
  for (const std::string& uri :
       {"data:application/gltf-buffer;base64," + base64, "data:;base64," + base64,
        "data:model/vnd.odd+x;base64," + base64,
        "DATA:application/octet-stream;name=my%20buffer.bin;charset=utf-8;BASE64," + base64,
        "data:application/octet-stream;base64," + padless, "data:image/png;base64," + escapedPadding,
        "data:application/octet-stream," + percent}) {
    SCOPED_TRACE(uri);
    g.json["buffers"] = json::array({{{"byteLength", g.bytes().size()}, {"uri", uri}}});
    EXPECT_EQ(load(g).meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0));
  }
}

TEST(Load, NamesOfBufferFilesThatWereNotEscaped) {
  const test::TemporaryFolder folder;
  GltfMaker g = GltfMaker::triangle();
  for (const char* name : {"100% of it.bin", "a:b.bin", "%20.bin", "caf\xc3\xa9 #1?.bin"}) {
    SCOPED_TRACE(name);
    test::writeFile(folder / name, g.bytes());
    g.json["buffers"] = json::array({{{"byteLength", g.bytes().size()}, {"uri", name}}});
    const auto scene = loadGltf(g.write(folder));
    ASSERT_TRUE(scene) << scene.error().line();
  }
}

TEST(Load, BuffersNobodyReadsMayBeOutOfReach) {
  GltfMaker g = GltfMaker::triangle();
  g.embed();
  g.json["buffers"].push_back({{"byteLength", 9}, {"uri", "not there.bin"}});
  g.json["buffers"].push_back({{"byteLength", 9}, {"uri", "https://example.org/a.bin"}});
  g.json["buffers"].push_back({{"byteLength", 9}});
  EXPECT_EQ(load(g).meshes.size(), 1u);
}

TEST(Load, FromMemoryNoFileIsOpened) {
  const test::TemporaryFolder folder;
  GltfMaker g = GltfMaker::triangle();
  test::writeFile(folder / "there.bin", g.bytes());
  g.json["buffers"] = json::array({{{"byteLength", g.bytes().size()}, {"uri", (folder / "there.bin").string()}}});
  ASSERT_TRUE(loadGltf(g.write(folder)));
  const auto scene = loadGltfFromMemory(g.json.dump(), "memory");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().line(), testing::EndsWith("is not a file beside this one"));
  g.embed();
  EXPECT_TRUE(loadGltfFromMemory(g.json.dump(), "memory"));
}

TEST(Load, EmptyListsAndUndeclaredLightsAreNoted) {
  GltfMaker g = GltfMaker::triangle();
  g.json["animations"] = json::array();
  g.json["nodes"][0]["children"] = json::array();
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
  EXPECT_THAT(load(g).notes, ElementsAre("/extensions/KHR_lights_punctual is not in extensionsUsed, but read",
                                         "/animations: an empty list, taken for none"));
}

TEST(Load, AnimationsWhoseKeyTimesHaveNoDataAreNoted) {
  GltfMaker g = GltfMaker::triangle();
  g.json["accessors"].push_back({{"componentType", 5126}, {"type", "SCALAR"}, {"count", 2}});
  g.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 2}});
  g.json["animations"] =
      json::array({{{"samplers", json::array({{{"input", 2}, {"output", 3}}})},
                    {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}})}}});
  const Scene scene = load(g);
  EXPECT_THAT(scene.notes, ElementsAre("/animations/0/channels/0: ignored: its key times have no data"));
  EXPECT_TRUE(scene.animations[0].channels.empty());
}

TEST(Load, ManySkinsAndManyNodesWithoutNames) {
  GltfMaker g = GltfMaker::skinned();
  const json node = {{"mesh", 0}};
  for (int i = 0; i < 500; ++i) {
    const std::size_t joint = g.json["nodes"].size();
    g.json["nodes"].push_back(json::object());
    g.json["nodes"].push_back(json::object());
    g.json["nodes"].push_back({{"mesh", 0}, {"skin", g.json["skins"].size()}});
    for (const std::size_t n : {joint, joint + 1, joint + 2}) g.json["scenes"][0]["nodes"].push_back(n);
    g.json["skins"].push_back({{"joints", {joint, joint + 1}}, {"skeleton", joint}});
  }
  const Scene scene = load(g);
  const auto objects = findObjects(scene);
  ASSERT_EQ(objects.size(), 501u);
  EXPECT_EQ(objects[1].name, "object");
  EXPECT_EQ(objects[500].name, "object 500");
}

TEST(Load, GlbByContentWhateverItsName) {
  GltfMaker g = GltfMaker::triangle();
  g.json["buffers"] = json::array({{{"byteLength", g.bytes().size()}}});
  std::string text = g.json.dump(), chunk = g.bytes();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &v, 4);
    return bytes;
  };
  const std::string body = word(text.size()) + "JSON" + text + word(chunk.size()) + std::string("BIN\0", 4) + chunk;
  const std::string glb = "glTF" + word(2) + word(12 + body.size()) + body;
  const test::TemporaryFolder folder;
  test::writeFile(folder / "a.gltf", glb + "trailing bytes are not the GLB's");
  const auto scene = loadGltf(folder / "a.gltf");
  ASSERT_TRUE(scene) << scene.error().line();
  EXPECT_EQ(scene->name, "a.gltf");
  // Cut anywhere, it is refused.
  for (std::size_t length = 0; length < glb.size(); ++length) {
    test::writeFile(folder / "cut.glb", glb.substr(0, length));
    const auto cut = loadGltf(folder / "cut.glb");
    ASSERT_FALSE(cut) << length;
    EXPECT_EQ(cut.error().line().find('\n'), std::string::npos);
  }
}

TEST(Load, FilesWithoutScenesShowAllRoots) {
  GltfMaker g = GltfMaker::triangle();
  g.json.erase("scenes");
  g.json["nodes"].push_back({{"children", {0}}});
  EXPECT_THAT(load(g).roots, ElementsAre(1));
}

TEST(Load, NamesStayOnOneLine) {
  GltfMaker g = GltfMaker::triangle();
  g.json["nodes"][0]["name"] = "two\nlines\t";
  EXPECT_EQ(load(g).nodes[0].name, "two lines ");
}

TEST(Load, UnknownSampleListsTheKnownOnes) {
  const auto scene = loadScene("sample:nothing");
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().line().find("sample:nothing: no such sample; there are "), std::string::npos);
}

}  // namespace
}  // namespace rigel::tools
