#include "scene/gltf_save.h"

#include "scene/gltf_buffer.h"

#include <rigel/sh.h>

#include <glm/gtc/type_ptr.hpp>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

namespace rigel::tools {
namespace {

using nlohmann::json;

json numbers(const float* values, std::size_t count) {
  json out = json::array();
  for (std::size_t i = 0; i < count; ++i) out.push_back(double{values[i]});
  return out;
}

// glTF forbids empty arrays and objects, hence this in place of plain assignment.
void setUnlessEmpty(json& parent, const char* key, json value) {
  if (!value.empty()) parent[key] = std::move(value);
}

void setName(json& thing, const std::string& name) {
  if (!name.empty()) thing["name"] = name;
}

bool isWritable(const Primitive& primitive) { return !primitive.triangles.empty(); }

class SceneWriter {
 public:
  explicit SceneWriter(const Scene& scene) : scene_(scene) {}

  json document() {
    json out = {{"asset", {{"version", "2.0"}, {"generator", "Rigel"}}}};
    setUnlessEmpty(out, "materials", materials());
    setUnlessEmpty(out, "meshes", meshes());
    writeLights();
    setUnlessEmpty(out, "nodes", nodes());
    setUnlessEmpty(out, "skins", skins());
    setUnlessEmpty(out, "animations", animations());
    json scene = json::object();
    setUnlessEmpty(scene, "nodes", scene_.roots);
    out["scenes"] = json::array({scene});
    out["scene"] = 0;
    for (std::size_t kind = 0; kind < std::size(kLightExtensions); ++kind) {
      if (lights_[kind].empty()) continue;
      out["extensionsUsed"].push_back(kLightExtensions[kind]);
      out["extensions"][kLightExtensions[kind]]["lights"] = lights_[kind];
    }
    if (!scene_.settings.empty()) {
      out["extras"]["rigel"]["settings"] = json::parse(scene_.settings, nullptr, false);
    }
    buffer_.describe(out);
    return out;
  }

  const std::string& bytes() const { return buffer_.bytes(); }

 private:
  json materials() const {
    json out = json::array();
    for (const Material& material : scene_.materials) {
      const glm::vec3& c = material.baseColour;
      json m = {{"pbrMetallicRoughness",
                 {{"baseColorFactor", {double{c.x}, double{c.y}, double{c.z}, 1}}, {"metallicFactor", 0}}}};
      setName(m, material.name);
      if (material.wrap != 0) m["extras"]["wrap"] = double{material.wrap};
      out.push_back(std::move(m));
    }
    return out;
  }

  json primitive(const Primitive& p) {
    json out;
    json& attributes = out["attributes"];
    attributes["POSITION"] = buffer_.addVectors(p.positions, AccessorRange::written);
    if (!p.normals.empty()) attributes["NORMAL"] = buffer_.addVectors(p.normals);
    if (!p.influences.empty()) {
      const bool second = std::ranges::any_of(p.influences, [](const Influences& in) {
        return std::any_of(in.weight.begin() + 4, in.weight.end(), [](float w) { return w != 0; });
      });
      for (std::size_t set = 0; set < (second ? 2u : 1u); ++set) {
        attributes["JOINTS_" + std::to_string(set)] = buffer_.addJoints(p.influences, set);
        attributes["WEIGHTS_" + std::to_string(set)] = buffer_.addWeights(p.influences, set);
      }
    }
    out["indices"] = buffer_.addTriangles(p.triangles);
    for (const MorphTarget& target : p.targets) {
      json t = {{"POSITION", buffer_.addVectors(target.positions, AccessorRange::written)}};
      if (!target.normals.empty()) t["NORMAL"] = buffer_.addVectors(target.normals);
      out["targets"].push_back(std::move(t));
    }
    if (p.material >= 0) out["material"] = p.material;
    return out;
  }

  // Meshes without a triangle cannot be said in glTF; they, and references to them, are left out.
  json meshes() {
    json out = json::array();
    for (const Mesh& mesh : scene_.meshes) {
      if (std::ranges::none_of(mesh.primitives, isWritable)) {
        writtenMesh_.push_back(-1);
        continue;
      }
      writtenMesh_.push_back(static_cast<int>(out.size()));
      json m;
      setName(m, mesh.name);
      for (const Primitive& p : mesh.primitives) {
        if (isWritable(p)) m["primitives"].push_back(primitive(p));
      }
      setUnlessEmpty(m, "weights", numbers(mesh.morphWeights.data(), mesh.morphWeights.size()));
      out.push_back(std::move(m));
    }
    return out;
  }

  json nodes() const {
    json out = json::array();
    for (const Node& node : scene_.nodes) {
      json n = json::object();
      setName(n, node.name);
      setUnlessEmpty(n, "children", node.children);
      if (node.hasMatrix) {
        n["matrix"] = numbers(glm::value_ptr(node.matrix), 16);
      } else {
        const glm::quat& q = node.rotation;
        if (node.translation != glm::vec3(0)) n["translation"] = numbers(&node.translation.x, 3);
        if (q != glm::quat(1, 0, 0, 0)) n["rotation"] = {double{q.x}, double{q.y}, double{q.z}, double{q.w}};
        if (node.scale != glm::vec3(1)) n["scale"] = numbers(&node.scale.x, 3);
      }
      if (node.mesh >= 0 && writtenMesh_[node.mesh] >= 0) {
        n["mesh"] = writtenMesh_[node.mesh];
        if (node.skin >= 0) n["skin"] = node.skin;
        setUnlessEmpty(n, "weights", numbers(node.morphWeights.data(), node.morphWeights.size()));
      }
      if (node.light >= 0) {
        const WrittenLight& light = writtenLight_[node.light];
        n["extensions"][kLightExtensions[light.extension]]["light"] = light.index;
      }
      if (node.isStatic) n["extras"]["rigel"]["static"] = true;
      if (node.isObject) n["extras"]["rigel"]["object"] = true;
      out.push_back(std::move(n));
    }
    return out;
  }

  json skins() {
    json out = json::array();
    for (const Skin& skin : scene_.skins) {
      json s = {{"joints", skin.joints}, {"inverseBindMatrices", buffer_.addMatrices(skin.inverseBind)}};
      setName(s, skin.name);
      if (skin.skeletonRoot >= 0) s["skeleton"] = skin.skeletonRoot;
      out.push_back(std::move(s));
    }
    return out;
  }

  json animations() {
    constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
    constexpr const char* kInterpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    json out = json::array();
    for (const Animation& animation : scene_.animations) {
      json a = json::object();
      setName(a, animation.name);
      for (const Channel& channel : animation.channels) {
        const bool weights = channel.path == AnimationPath::weights;
        a["channels"].push_back(
            {{"sampler", a["channels"].size()},
             {"target", {{"node", channel.node}, {"path", kPaths[static_cast<int>(channel.path)]}}}});
        a["samplers"].push_back({{"input", buffer_.addTimes(channel.times)},
                                 {"output", buffer_.addFloats(channel.values, weights ? 1 : channel.width)},
                                 {"interpolation", kInterpolations[static_cast<int>(channel.interpolation)]}});
      }
      if (a.contains("channels")) out.push_back(std::move(a));
    }
    return out;
  }

  // colour * intensity with the largest channel of colour at 1; quotient and product in double give the float back.
  static void setPower(json& light, Rgb power, double factor = 1) {
    const double largest = std::max({power.r, power.g, power.b});
    light["intensity"] = largest * factor;
    if (largest > 0) light["color"] = {power.r / largest, power.g / largest, power.b / largest};
  }

  template <class Light>
  static void setSmallRadiusAndRange(json& out, const Light& light) {
    if (light.radius != kDefaultPointRadius) out["extras"]["rigel"]["pointRadius"] = double{light.radius};
    if (light.range != kNoRange) out["range"] = double{light.range};
  }

  static void describe(json& out, const DirectionalLight& light) {
    out["type"] = "directional";
    setPower(out, light.irradiance);
  }
  static void describe(json& out, const PointLight& light) {
    out["type"] = "point";
    setPower(out, light.intensity);
    setSmallRadiusAndRange(out, light);
  }
  static void describe(json& out, const SpotLight& light) {
    out["type"] = "spot";
    setPower(out, light.intensity);
    setSmallRadiusAndRange(out, light);
    // glTF wants inner < outer; a sharp cone keeps its outer angle.
    const float inner = light.innerAngle < light.outerAngle ? light.innerAngle : std::nextafter(light.outerAngle, 0.f);
    out["spot"] = {{"innerConeAngle", double{inner}}, {"outerConeAngle", double{light.outerAngle}}};
  }
  static void describe(json& out, const SphereLight& light) {
    out["type"] = "point";
    const double radius = light.radius;
    setPower(out, light.radiance, kPi * radius * radius);
    out["extras"]["radius"] = radius;
  }

  // Programs that know no disks see a spot light of the widest cone, or for both faces a point light.
  static void describe(json& out, const DiskLight& light) {
    const double radius = light.radius;
    json& ours = out["extras"]["rigel"];
    ours = {{"type", "disk"}, {"radius", radius}};
    if (light.twoSided) ours["twoSided"] = true;
    out["type"] = light.twoSided ? "point" : "spot";
    if (!light.twoSided) out["spot"]["outerConeAngle"] = kPi / 2;
    setPower(out, light.radiance, kPi * radius * radius);
  }
  static void describeArea(json& out, const DiskLight& light) {
    out["type"] = "disk";
    out["size"] = 2 * double{light.radius};
    setPower(out, light.radiance);
    if (light.twoSided) out["extras"]["rigel"]["twoSided"] = true;
  }

  void writeLights() {
    for (const SceneLight& light : scene_.lights) {
      json l;
      setName(l, light.name);
      const auto* disk = std::get_if<DiskLight>(&light.shape);
      const bool area = disk != nullptr && light.scalesWithNode;
      if (area) {
        describeArea(l, *disk);
      } else {
        std::visit([&](const auto& shape) { describe(l, shape); }, light.shape);
      }
      const std::size_t extension = area ? 1 : 0;
      writtenLight_.push_back({extension, lights_[extension].size()});
      lights_[extension].push_back(std::move(l));
    }
  }

  static constexpr const char* kLightExtensions[] = {"KHR_lights_punctual", "EXT_lights_area"};
  struct WrittenLight {
    std::size_t extension, index;  // the latter among the extension's lights
  };

  const Scene& scene_;
  GltfBuffer buffer_;
  std::vector<int> writtenMesh_;
  std::vector<WrittenLight> writtenLight_;
  json lights_[std::size(kLightExtensions)];
};

void appendWord(std::string& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  char bytes[4];
  std::memcpy(bytes, &word, 4);
  out.append(bytes, 4);
}

std::string packGlb(std::string text, const std::string& chunk) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t total = 12 + 8 + text.size() + (chunk.empty() ? 0 : 8 + chunk.size());
  std::string out = "glTF";
  appendWord(out, 2);
  appendWord(out, total);
  appendWord(out, text.size());
  out += "JSON" + text;
  if (!chunk.empty()) {
    appendWord(out, chunk.size());
    out.append("BIN\0", 4);
    out += chunk;
  }
  return out;
}

Result<std::size_t> writeAside(const std::filesystem::path& file, const std::string& content) {
  std::filesystem::path aside = file;
  aside += ".part" + std::to_string(getpid());
  std::error_code error;
  std::ofstream stream(aside, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (stream) std::filesystem::rename(aside, file, error);
  if (!stream || error) {
    std::error_code ignored;
    std::filesystem::remove(aside, ignored);
    return Error{"cannot be written" + (error ? " (" + error.message() + ")" : std::string()), file.string()};
  }
  return content.size();
}

}  // namespace

Result<std::size_t> saveGltf(const Scene& scene, const std::filesystem::path& file) {
  const bool glb = file.extension() == ".glb";
  if (!glb && file.extension() != ".gltf") return Error{"must end in .glb or .gltf", file.string()};
  SceneWriter writer(scene);
  json document = writer.document();
  if (writer.bytes().size() > 0xf0000000u) return Error{"the scene is beyond the 4 GiB of a GLB", file.string()};
  if (!glb && !writer.bytes().empty()) {
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(writer.bytes());
  }
  // Names that are no UTF-8 must not stop the writing.
  const std::string text = document.dump(glb ? -1 : 1, ' ', false, json::error_handler_t::replace);
  return writeAside(file, glb ? packGlb(text, writer.bytes()) : text);
}

}  // namespace rigel::tools
