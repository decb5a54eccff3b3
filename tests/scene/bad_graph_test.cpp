// Nodes, skins, animations, lights and materials that make no sense.
#include "bad_input.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace rigel::tools {
namespace {

using nlohmann::json;
using test::GltfMaker;

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
    test::expectLoadError(g, "/nodes/1: node loop: 1 < 3 < 2 < 1 (child < parent)");
  }
  {
    GltfMaker g = node({{"children", {1}}});
    test::expectLoadError(g, "/nodes/1: node loop: 1 < 1 (child < parent)");
  }
  {
    GltfMaker g = node({{"children", {3}}});
    g.json["nodes"].push_back({{"children", {3}}});
    g.json["nodes"].push_back(json::object());
    test::expectLoadError(g, "/nodes/2/children/0: node 3 already has the parent 1");
  }
  {
    GltfMaker g = node({{"children", {0}}});
    test::expectLoadError(g, "/scenes/0/nodes/0: node 0 is a child of node 1");
  }
  {
    GltfMaker g = node({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", {1, 1, 1}}});
    test::expectLoadError(g, "/nodes/1: has both matrix and scale");
  }
  {
    GltfMaker g = node({{"matrix", {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    test::expectLoadError(g, "/nodes/1/matrix: is not affine: its last row must be 0 0 0 1");
  }
  {
    GltfMaker g = node({{"translation", {1, 2}}});
    test::expectLoadError(g, "/nodes/1/translation: must have 3 numbers, has 2");
  }
  {
    GltfMaker g = node({{"translation", {1, 2, 1e200}}});
    test::expectLoadError(g, "/nodes/1/translation/2: 1e+200 does not fit a float");
  }
  {
    GltfMaker g = node({{"translation", {1, 2, nullptr}}});
    test::expectLoadError(g, "/nodes/1/translation/2: must be a number, is null");
  }
  {
    GltfMaker g = node({{"rotation", {0, 0, 0, 0}}});
    test::expectLoadError(g, "/nodes/1/rotation: is no unit quaternion: its length is 0");
  }
  {
    GltfMaker g = node({{"weights", {1}}});
    test::expectLoadError(g, "/nodes/1/weights: there are no morph targets for them");
  }
  {
    GltfMaker g = node({{"extras", {{"rigel", {{"static", 1}}}}}});
    test::expectLoadError(g, "/nodes/1/extras/rigel/static: must be true or false, is number");
  }
}

TEST(BadInput, Skins) {
  struct Case {
    std::function<void(GltfMaker&)> damage;
    const char* message;
  };
  const auto weights = [](const std::vector<float>& w) {
    return [w](GltfMaker& g) { test::primitive(g)["attributes"]["WEIGHTS_0"] = g.addFloats(w, "VEC4"); };
  };
  const Case cases[] = {
      {[](GltfMaker& g) {
         test::primitive(g)["attributes"]["JOINTS_0"] =
             g.add(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 3);
       },
       "/nodes/0: vertex 1 of mesh 0 follows joint 2, skin 0 has 2"},
      {weights({1, 0, 0, 0, -.5f, 1.5f, 0, 0, 0, 1, 0, 0}),
       "/meshes/0/primitives/0/attributes/WEIGHTS_0: vertex 1 has the negative weight -0.5"},
      {[](GltfMaker& g) { test::primitive(g)["attributes"].erase("WEIGHTS_0"); },
       "/meshes/0/primitives/0/attributes: has JOINTS_0 without WEIGHTS_0"},
      {[](GltfMaker& g) {
         test::primitive(g)["attributes"].erase("WEIGHTS_0");
         test::primitive(g)["attributes"].erase("JOINTS_0");
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
    test::expectLoadError(g, c.message);
  }
}

TEST(BadInput, Animations) {
  const auto expectAnimationError = [](const std::string& path, const std::vector<float>& times,
                                       const std::vector<float>& values, const std::string& type,
                                       const std::string& kind, const std::string& message) {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, path, times, values, type, kind);
    test::expectLoadError(g, message);
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
    test::expectLoadError(g, "/animations/0/channels/1: moves the same property of node 0 as a channel before it");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, "translation", {0, 1}, two, "VEC3");
    g.json["animations"][0]["channels"][0]["sampler"] = 1;
    test::expectLoadError(g, "/animations/0/channels/0/sampler: sampler 1 does not exist (there are 1)");
  }
  {
    GltfMaker g = GltfMaker::triangle();
    addAnimation(g, "translation", {0, 1}, two, "VEC3");
    g.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    test::expectLoadError(g, "/animations/0/channels/0/target: moves node 0, whose transform is a fixed matrix");
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
    test::expectLoadError(g, message);
  }
  const std::pair<json, std::string> disks[] = {
      {{{"type", "disk"}}, "/extras/rigel: has no \"radius\""},
      {{{"type", "disk"}, {"radius", 0}}, "/extras/rigel/radius: must be more than 0, is 0"},
      {{{"type", "disk"}, {"radius", 1e-60}}, "/extras/rigel/radius: must be more than 0, is 1e-60"},
      {{{"type", "disk"}, {"radius", "1"}}, "/extras/rigel/radius: must be a number, is string"},
      {{{"type", "disk"}, {"radius", 1e-30}},
       "/extras/rigel/radius: 1e-30 is so small that the radiance does not fit a float"},
      {{{"type", "disk"}, {"radius", 1}, {"twoSided", 1}}, "/extras/rigel/twoSided: must be true or false, is number"},
      {{{"type", "tube"}, {"radius", 1}}, "/extras/rigel/type: \"tube\" is not known (disk is)"},
      {{{"type", 1}}, "/extras/rigel/type: must be a string, is number"},
  };
  for (const auto& [disk, message] : disks) {
    GltfMaker g = GltfMaker::triangle();
    addLight(g, {{"type", "point"}, {"extras", {{"rigel", disk}}}});
    test::expectLoadError(g, at + message);
  }
  GltfMaker sun = GltfMaker::triangle();
  addLight(sun, {{"type", "directional"}, {"extras", {{"rigel", {{"type", "disk"}, {"radius", 1}}}}}});
  test::expectLoadError(sun, at + "/type: \"directional\": a disk takes the intensity [cd] of a point or spot light");
  for (const double wrap : {-0.3, 1.01}) {
    GltfMaker g = GltfMaker::triangle();
    g.json["materials"] = json::array({{{"extras", {{"wrap", wrap}}}}});
    test::expectLoadError(g, fmt::format("/materials/0/extras/wrap: must lie in [-0.25, 1], is {}", wrap));
  }
  GltfMaker g = GltfMaker::triangle();
  g.json["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0, 0, 1}}}}}});
  test::expectLoadError(g, "/materials/0/pbrMetallicRoughness/baseColorFactor: must lie in [0, 1], has 2");
}

TEST(BadInput, AreaLights) {
  const std::string at = "/extensions/EXT_lights_area/lights";
  const std::pair<json, std::string> lights[] = {
      {{{"type", "sphere"}}, at + "/0/type: \"sphere\" is none of rect, disk"},
      {{{"type", "disk"}, {"size", 0}}, at + "/0/size: must be more than 0, is 0"},
      {{{"type", "disk"}, {"size", -1}}, at + "/0/size: must be more than 0, is -1"},
      {{{"type", "disk"}, {"intensity", -1}}, at + "/0/intensity: must be at least 0, is -1"},
      {{{"type", "disk"}, {"color", {1, 1}}}, at + "/0/color: must have 3 numbers, has 2"},
  };
  for (const auto& [light, message] : lights) {
    GltfMaker g = GltfMaker::triangle();
    g.json["extensions"]["EXT_lights_area"]["lights"].push_back(light);
    test::expectLoadError(g, message);
  }
  GltfMaker g = GltfMaker::triangle();
  g.json["extensions"]["EXT_lights_area"]["lights"].push_back({{"type", "disk"}});
  g.json["nodes"][0]["extensions"]["EXT_lights_area"]["light"] = 1;
  test::expectLoadError(g, "/nodes/0/extensions/EXT_lights_area/light: light 1 does not exist (there are 1)");
  g.json["nodes"][0]["extensions"]["EXT_lights_area"]["light"] = 0;
  addLight(g, {{"type", "point"}});
  g.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  test::expectLoadError(g, "/nodes/0: has a punctual and an area light: a node may carry one");
}

}  // namespace
}  // namespace rigel::tools
