#include "scene_files.h"

namespace rigel::tools::test {

// Bit by bit, unlike the encoder under test.
std::string encodeBase64(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bits, out;
  for (const char c : bytes) {
    for (int b = 7; b >= 0; --b) bits += (static_cast<unsigned char>(c) >> b & 1) != 0 ? '1' : '0';
  }
  while (bits.size() % 6 != 0) bits += '0';
  for (std::size_t i = 0; i < bits.size(); i += 6) out += digits[std::stoul(bits.substr(i, 6), nullptr, 2)];
  while (out.size() % 4 != 0) out += '=';
  return out;
}

int GltfMaker::addBytes(const void* data, std::size_t size, int componentType, const std::string& type,
                        std::size_t count, bool normalized) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
  bytes_.append(static_cast<const char*>(data), size);
  nlohmann::json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                             {"componentType", componentType},
                             {"type", type},
                             {"count", count}};
  if (normalized) accessor["normalized"] = true;
  json["accessors"].push_back(accessor);
  return static_cast<int>(json["accessors"].size()) - 1;
}

int GltfMaker::addFloats(const std::vector<float>& values, const std::string& type) {
  const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
  return add(values, 5126, type, values.size() / width);
}

GltfMaker GltfMaker::triangle() {
  GltfMaker g;
  const int positions = g.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int indices = g.add(std::vector<std::uint16_t>{0, 1, 2}, 5123, "SCALAR", 3);
  nlohmann::json primitive = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
  nlohmann::json mesh;
  mesh["primitives"].push_back(primitive);
  g.json["meshes"].push_back(mesh);
  g.json["nodes"].push_back({{"mesh", 0}, {"name", "triangle"}});
  nlohmann::json scene;
  scene["nodes"].push_back(0);
  g.json["scenes"].push_back(scene);
  return g;
}

GltfMaker GltfMaker::skinned() {
  GltfMaker g = triangle();
  const int joints = g.add(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 3);
  const int weights = g.addFloats({1, 0, 0, 0, .5f, .5f, 0, 0, 0, 1, 0, 0}, "VEC4");
  auto& attributes = g.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  nlohmann::json root = {{"name", "root"}}, tip = {{"name", "tip"}};
  root["children"].push_back(2);
  g.json["nodes"].push_back(root);
  g.json["nodes"].push_back(tip);
  g.json["scenes"][0]["nodes"].push_back(1);
  nlohmann::json skin;
  skin["joints"].push_back(1);
  skin["joints"].push_back(2);
  g.json["skins"].push_back(skin);
  g.json["nodes"][0]["skin"] = 0;
  return g;
}

void GltfMaker::embed() {
  json["buffers"] = nlohmann::json::array();
  json["buffers"].push_back(
      {{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + encodeBase64(bytes_)}});
}

std::filesystem::path GltfMaker::write(const TemporaryFolder& folder, const std::string& name) {
  if (!json.contains("buffers")) embed();
  const std::filesystem::path file = folder / name;
  writeFile(file, json.dump());
  return file;
}

Scene triangleScene(const std::vector<glm::vec3>& corners) {
  Scene scene;
  Primitive primitive;
  primitive.positions = corners;
  for (glm::uint i = 0; i + 2 < corners.size(); i += 3) primitive.triangles.emplace_back(i, i + 1, i + 2);
  scene.meshes.push_back({"mesh", {primitive}, {}});
  Node node;
  node.name = "mesh";
  node.mesh = 0;
  scene.nodes.push_back(node);
  scene.roots = {0};
  return scene;
}

Scene everythingScene() {
  Scene scene;
  scene.name = "everything";
  scene.materials = {
      {"plain", {0.1f, 0.7f, 0.3f}, 0}, {"skin", {0.9f, 0.6f, 0.5f}, 0.3f}, {"negative", {1, 1, 1}, -0.25f}};

  Primitive morphed;
  morphed.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3f, 0.1f, 0.7f}};
  morphed.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  morphed.triangles = {{0, 1, 2}, {1, 2, 3}};
  morphed.targets = {{{{0, 0, 1}, {0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0}}, {{0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},
                     {{{0, 0, 0}, {1, 2, 3}, {0, 0, 0}, {0, 0, 0}}, {}}};
  morphed.material = 0;
  Primitive flat;
  flat.positions = {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
  flat.triangles = {{0, 1, 2}};
  flat.targets = {{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {}}, {{{0, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {}}};
  scene.meshes.push_back({"morphed", {morphed, flat}, {0.25f, 0.75f}});

  Primitive skinned;
  skinned.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  skinned.triangles = {{0, 1, 2}};
  skinned.material = 1;
  skinned.influences.resize(3);
  skinned.influences[0].weight[0] = 1;
  skinned.influences[1].joint = {0, 1, 2, 1, 2, 0, 0, 0};
  skinned.influences[1].weight = {0.5f, 0.25f, 0.125f, 0.0625f, 0.0625f, 0, 0, 0};
  skinned.influences[2].joint = {2, 0, 0, 0, 0, 0, 0, 0};
  skinned.influences[2].weight = {1, 0, 0, 0, 0, 0, 0, 0};
  scene.meshes.push_back({"skinned", {skinned}, {}});

  scene.nodes.resize(11);
  const auto link = [&](int parent, int child) {
    scene.nodes[parent].children.push_back(child);
    scene.nodes[child].parent = parent;
  };
  scene.nodes[0].name = "root";
  scene.nodes[0].isObject = true;
  scene.nodes[1].name = "morph node";
  scene.nodes[1].mesh = 0;
  scene.nodes[1].morphWeights = {0.5f, 0};
  scene.nodes[1].translation = {0.1f, 0.2f, 0.3f};
  scene.nodes[1].rotation = glm::quat(0.8f, 0.6f, 0, 0);
  scene.nodes[1].scale = {1, -2, 0.5f};
  scene.nodes[2].name = "skinned node";
  scene.nodes[2].mesh = 1;
  scene.nodes[2].skin = 0;
  for (int joint = 3; joint < 6; ++joint) {
    scene.nodes[joint].name = "joint " + std::to_string(joint - 3);
    scene.nodes[joint].translation = {0, 0.5f, 0};
  }
  scene.nodes[6].name = "lamp \"\xc3\xa9\"";
  scene.nodes[6].light = 0;
  scene.nodes[6].isStatic = true;
  scene.nodes[7].hasMatrix = true;
  scene.nodes[7].matrix[3] = {4, 5, 6, 1};
  scene.nodes[7].matrix[0] = {0, 0, -1, 0};
  scene.nodes[7].matrix[2] = {1, 0, 0, 0};
  scene.nodes[7].light = 3;
  link(0, 1);
  link(3, 4);
  link(4, 5);
  link(0, 6);
  link(0, 7);
  link(7, 8);
  scene.nodes[8].light = 2;
  scene.nodes[9].translation = {0, 3, 0};
  scene.nodes[9].rotation = glm::quat(0.8f, -0.6f, 0, 0);
  scene.nodes[9].light = 5;
  scene.nodes[10].scale = {2, 3, 0.5f};
  scene.nodes[10].light = 6;
  scene.roots = {0, 2, 3, 9, 10};

  Skin skin;
  skin.name = "rig";
  skin.joints = {3, 4, 5};
  skin.inverseBind.assign(3, glm::mat4(1));
  skin.inverseBind[1][3] = {0.1f, -0.5f, 0.3f, 1};
  skin.skeletonRoot = 3;
  scene.skins = {skin};

  scene.lights = {{"sphere", SphereLight{{}, 0.3f, {12.7f, 3.3f, 0.1f}}},
                  {"sun", DirectionalLight{{0, 0, -1}, {0.9f, 1.1f, 1.3f}}},
                  {"spot", SpotLight{{}, {0, 0, -1}, {7, 8, 9.1f}, 0.2f, 0.7f, 0.02f, 12.5f}},
                  {"point", PointLight{{}, {1e4f, 0, 17.3f}}},
                  {"", PointLight{{}, {0, 0, 0}, 0.5f, 3}},
                  {"panel", DiskLight{{}, {0, 0, -1}, 0.7f, {5.1f, 4.9f, 0.3f}, false}},
                  {"area", DiskLight{{}, {0, 0, -1}, 0.1f, {9, 0.7f, 1.3f}, true}, true}};

  Animation walk{"walk", {}, 2};
  walk.channels.push_back({1, AnimationPath::translation, Interpolation::step, 3, {0, 1.5f}, {1, 2, 3, 4, 5, 6}});
  walk.channels.push_back(
      {1, AnimationPath::weights, Interpolation::linear, 2, {0.5f, 1, 2}, {0, 1, 0.5f, 0.5f, 1, 0.1f}});
  walk.channels.push_back(
      {3, AnimationPath::rotation, Interpolation::linear, 4, {0, 1.5f}, {0, 0, 0, 1, 0.6f, 0, 0, 0.8f}});
  Animation jump{"jump", {}, 1};
  jump.channels.push_back(
      {4, AnimationPath::rotation, Interpolation::cubicSpline, 4, {0, 1}, {0, 0,    0, 0, 0, 0, 0, 1, 0.1f, 0, 0, 0,
                                                                           0, 0.2f, 0, 0, 0, 1, 0, 0, 0,    0, 0, 0}});
  jump.channels.push_back({5, AnimationPath::scale, Interpolation::linear, 3, {0.25f}, {2, 3, 4}});
  scene.animations = {walk, jump};
  return scene;
}

}  // namespace rigel::tools::test
