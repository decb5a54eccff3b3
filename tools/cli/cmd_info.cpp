// `rigel info`: what a scene holds, as Rigel sees it.
#include "cli/command.h"
#include "scene/gltf_load.h"
#include "scene/pose.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFramesPerSecond = 30;  // DESIGN section 7: frames count at 30 a second of the clip
constexpr double kFrameSlack = 1e-3;     // of a frame: 0.8333333 s are 25 frames

struct InfoOptions {
  std::string source;
  bool json = false;
};

Json triple(Rgb c) { return {c.r, c.g, c.b}; }

// Size of the box around the object's triangles in the rest pose, in world axes.
glm::vec3 restSize(const SceneObject& object, const PosedObject& posed) {
  glm::vec3 low = posed.positions[object.triangles.front().x], high = low;
  for (const glm::uvec3& t : object.triangles) {
    for (const glm::uint v : {t.x, t.y, t.z}) {
      low = glm::min(low, posed.positions[v]);
      high = glm::max(high, posed.positions[v]);
    }
  }
  return high - low;
}

// The nodes whose movement moves a vertex of the object: its own, its joints, all above them.
std::vector<bool> movingNodes(const Scene& scene, const SceneObject& object) {
  std::vector<bool> moving(scene.nodes.size(), false);
  const auto add = [&](int node) {
    for (; node >= 0 && !moving[node]; node = scene.nodes[node].parent) moving[node] = true;
  };
  for (const int meshNode : object.meshNodes) {
    const Node& node = scene.nodes[meshNode];
    if (node.skin < 0) {
      add(meshNode);
    } else {
      for (const int joint : scene.skins[node.skin].joints) add(joint);
    }
  }
  return moving;
}

std::vector<std::string> clipsThatMove(const Scene& scene, const SceneObject& object) {
  const std::vector<bool> moving = movingNodes(scene, object);
  std::vector<bool> morphing(scene.nodes.size(), false);
  for (const int meshNode : object.meshNodes) morphing[meshNode] = true;
  std::vector<std::string> clips;
  for (const Animation& animation : scene.animations) {
    const bool moves = std::ranges::any_of(animation.channels, [&](const Channel& channel) {
      return channel.path == AnimationPath::weights ? morphing[channel.node] : moving[channel.node];
    });
    if (moves) clips.push_back(animation.name);
  }
  return clips;
}

Json describeObject(const Scene& scene, const SceneObject& object, const ScenePose& rest) {
  PosedObject posed;
  poseObject(scene, object, rest, posed);
  const glm::vec3 size = restSize(object, posed);
  std::set<int> joints;
  std::size_t targets = 0;
  bool flat = false;
  for (const int meshNode : object.meshNodes) {
    const Node& node = scene.nodes[meshNode];
    if (node.skin >= 0) joints.insert(scene.skins[node.skin].joints.begin(), scene.skins[node.skin].joints.end());
    targets = std::max(targets, scene.meshes[node.mesh].morphWeights.size());
    for (const Primitive& p : scene.meshes[node.mesh].primitives) flat = flat || p.normals.empty();
  }
  return {{"name", object.name},
          {"static", object.isStatic},
          {"triangles", object.triangles.size()},
          {"vertices", object.vertexCount},
          {"size", {size.x, size.y, size.z}},
          {"joints", joints.size()},
          {"morph_targets", targets},
          {"flat_shaded", flat},
          {"clips", clipsThatMove(scene, object)}};
}

Json describeClip(const Animation& animation) {
  const int frames = static_cast<int>(std::floor(animation.duration * kFramesPerSecond + kFrameSlack)) + 1;
  return {{"name", animation.name},
          {"duration", animation.duration},
          {"frames", frames},
          {"channels", animation.channels.size()}};
}

Json describeLight(const DirectionalLight& light) {
  return {{"type", "directional"}, {"irradiance", triple(light.irradiance)}};
}

template <class Light>
Json describeBulb(const char* type, const Light& light) {
  Json out = {{"type", type}, {"intensity", triple(light.intensity)}, {"radius", light.radius}};
  if (light.range != kNoRange) out["range"] = light.range;
  return out;
}

Json describeLight(const PointLight& light) { return describeBulb("point", light); }

Json describeLight(const SpotLight& light) {
  Json out = describeBulb("spot", light);
  out["inner"] = light.innerAngle;
  out["outer"] = light.outerAngle;
  return out;
}

Json describeLight(const SphereLight& light) {
  return {{"type", "sphere"}, {"radiance", triple(light.radiance)}, {"radius", light.radius}};
}

Json describeLight(const DiskLight& light) {
  return {
      {"type", "disk"}, {"radiance", triple(light.radiance)}, {"radius", light.radius}, {"two_sided", light.twoSided}};
}

// Names as poseLights gives them, positions in the rest pose.
Json describeLights(const Scene& scene, const ScenePose& rest) {
  PosedLights posed;
  poseLights(scene, rest, posed);
  Json out = Json::array();
  const auto add = [&](const auto& light) {
    Json entry = {{"name", posed.names[out.size()]}};
    entry.update(describeLight(light));
    if constexpr (requires { light.position; }) {
      entry["position"] = {light.position.x, light.position.y, light.position.z};
    }
    if constexpr (requires { light.direction; }) {
      entry["direction"] = {light.direction.x, light.direction.y, light.direction.z};
    }
    out.push_back(std::move(entry));
  };
  for (int i = 0; i < posed.set.directionalCount(); ++i) add(posed.set.directional(i));
  for (int i = 0; i < posed.set.pointCount(); ++i) add(posed.set.point(i));
  for (int i = 0; i < posed.set.spotCount(); ++i) add(posed.set.spot(i));
  for (int i = 0; i < posed.set.sphereCount(); ++i) add(posed.set.sphere(i));
  for (int i = 0; i < posed.set.diskCount(); ++i) add(posed.set.disk(i));
  return out;
}

// How a captured run was asked for; null where the file does not say.
Json settingsOf(const Scene& scene) {
  return scene.settings.empty() ? Json(nullptr) : Json::parse(scene.settings, nullptr, false);
}

Json describeScene(const Scene& scene, const std::string& source) {
  ScenePose rest;
  poseScene(scene, kRestPose, 0, rest);
  Json objects = Json::array(), clips = Json::array(), materials = Json::array();
  for (const SceneObject& object : findObjects(scene)) objects.push_back(describeObject(scene, object, rest));
  for (const Animation& animation : scene.animations) clips.push_back(describeClip(animation));
  for (const Material& m : scene.materials) {
    materials.push_back(
        {{"name", m.name}, {"base_colour", {m.baseColour.x, m.baseColour.y, m.baseColour.z}}, {"wrap", m.wrap}});
  }
  return {{"scene", source},        {"objects", objects},
          {"clips", clips},         {"lights", describeLights(scene, rest)},
          {"materials", materials}, {"settings", settingsOf(scene)},
          {"notes", scene.notes}};
}

std::string tripleText(const Json& v) {
  const auto text = [&](int i) { return fmt::format("{:.4g}", v[i].get<double>() + 0.0); };  // -0 becomes 0
  return text(0) + " " + text(1) + " " + text(2);
}

std::string lightText(const Json& light) {
  std::string text = light["type"].get<std::string>();
  constexpr std::pair<const char*, const char*> kPowers[] = {
      {"irradiance", "W/m2"}, {"intensity", "W/sr"}, {"radiance", "W/(m2 sr)"}};
  for (const auto& [key, unit] : kPowers) {
    if (light.contains(key)) text += fmt::format(", {} {} {}", key, tripleText(light[key]), unit);
  }
  if (light.contains("radius")) text += fmt::format(", radius {:.4g} m", light["radius"].get<double>());
  if (light.contains("range")) text += fmt::format(", range {:.4g} m", light["range"].get<double>());
  if (light.value("two_sided", false)) text += ", both faces";
  if (light.contains("inner")) {
    text += fmt::format(", cone {:.4g} to {:.4g} rad", light["inner"].get<double>(), light["outer"].get<double>());
  }
  if (light.contains("position")) text += ", at " + tripleText(light["position"]);
  if (light.contains("direction")) text += ", along " + tripleText(light["direction"]);
  return text;
}

std::string objectText(const Json& object) {
  std::string text = fmt::format("{} triangles, {} m", object["triangles"].get<int>(), tripleText(object["size"]));
  if (object["static"]) text += ", static";
  if (object["joints"] > 0) text += fmt::format(", {} joints", object["joints"].get<int>());
  if (object["morph_targets"] > 0) text += fmt::format(", {} morph targets", object["morph_targets"].get<int>());
  if (object["flat_shaded"]) text += ", flat shaded";
  for (std::size_t i = 0; i < object["clips"].size(); ++i) {
    text += (i == 0 ? ", moved by " : ", ") + object["clips"][i].get<std::string>();
  }
  return text;
}

template <class Text>
void printSection(const char* title, const Json& entries, Text&& text) {
  if (entries.empty()) return;
  fmt::print("\n{}\n", title);
  for (const Json& entry : entries) fmt::print("  {}\n", text(entry));
}

void printText(const Json& info) {
  const auto named = [](const Json& entry, const std::string& text) {
    const auto name = entry["name"].get<std::string>();
    return fmt::format("{:<20} {}", name.empty() ? "(no name)" : name, text);
  };
  fmt::print("{}\n", info["scene"].get<std::string>());
  printSection("objects", info["objects"], [&](const Json& o) { return named(o, objectText(o)); });
  printSection("clips", info["clips"], [&](const Json& c) {
    return named(c, fmt::format("{:.4g} s, {} frames, {} channels", c["duration"].get<double>(), c["frames"].get<int>(),
                                c["channels"].get<int>()));
  });
  printSection("lights", info["lights"], [&](const Json& l) { return named(l, lightText(l)); });
  printSection("materials", info["materials"], [&](const Json& m) {
    return named(m, fmt::format("colour {}, wrap {:.4g}", tripleText(m["base_colour"]), m["wrap"].get<double>()));
  });
  if (!info["settings"].is_null()) {
    fmt::print("\nsettings\n");
    for (const auto& [name, value] : info["settings"].items())
      fmt::print("  {:<20} {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  printSection("notes", info["notes"], [](const Json& note) { return note.get<std::string>(); });
}

}  // namespace

Command addInfo(CLI::App& root) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* app = root.add_subcommand("info", "Describe a scene: objects, clips, lights, materials");
  app->add_option("FILE", options->source, "A .gltf or .glb file, or sample:NAME")->required();
  app->add_flag("--json", options->json, "Print JSON");
  return {app, [options] {
            const Result<Scene> scene = loadScene(options->source);
            if (!scene) return fail(kExitBadInput, scene.error().line());
            const Json info = describeScene(*scene, options->source);
            if (options->json) {
              fmt::print("{}\n", info.dump(2, ' ', false, Json::error_handler_t::replace));
            } else {
              printText(info);
            }
            return kExitOk;
          }};
}

}  // namespace rigel::tools
