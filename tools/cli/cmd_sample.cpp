// rigel sample: lists the built-in scenes, or writes one as glTF.
#include "command.h"
#include "report/run/run_settings.h"
#include "samples/samples.h"
#include "scene/gltf_save.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

namespace rigel::tools {
namespace {

struct SampleOptions {
  std::string name;
  std::string out;
  bool list = false;
  bool json = false;
};

/// What a listing says of a scene.
struct Counts {
  std::size_t triangles = 0, lights = 0;
  double duration = 0;
};

Counts count(const Scene& scene) {
  Counts counts;
  for (const Node& node : scene.nodes) {
    if (node.mesh < 0 || node.isStatic) continue;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      counts.triangles += p.triangles.size();
    }
  }
  counts.lights = scene.lights.size();
  for (const Animation& animation : scene.animations) counts.duration = std::max(counts.duration, animation.duration);
  return counts;
}

std::string names() {
  std::string all;
  for (const Sample& sample : samples()) all += (all.empty() ? "" : ", ") + sample.name;
  return all;
}

int list(bool asJson) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Sample& sample : samples()) {
    const Counts c = count(sample.make());
    if (asJson) {
      rows.push_back({{"name", sample.name},
                      {"summary", sample.summary},
                      {"triangles", c.triangles},
                      {"lights", c.lights},
                      {"duration", c.duration}});
    } else {
      fmt::print("{:<8} {:>6} triangles {:>3} lights {:>4.1f} s  {}\n", sample.name, c.triangles, c.lights, c.duration,
                 sample.summary);
    }
  }
  if (asJson) fmt::print("{}\n", nlohmann::json{{"samples", rows}}.dump(2));
  return kExitOk;
}

int write(const Sample& sample, const SampleOptions& options) {
  Scene scene = sample.make();
  RunOptions run;  // as `rigel report` would, so that the file says it all
  run.rigs = *parseRigSpecs(kDefaultRigs);
  scene.settings = runSettingsText(run);
  const Result<std::size_t> bytes = saveGltf(scene, options.out);
  if (!bytes) return fail(kExitBadInput, bytes.error().line());
  if (options.json) {
    fmt::print("{}\n", nlohmann::json{{"name", sample.name}, {"file", options.out}, {"bytes", *bytes}}.dump());
  } else {
    fmt::print("{}: {} bytes\n", options.out, *bytes);
  }
  return kExitOk;
}

int run(const SampleOptions& options) {
  if (options.list) {
    if (!options.name.empty()) return fail(kExitBadUse, "sample: --list takes no scene name");
    return list(options.json);
  }
  if (options.name.empty()) return fail(kExitBadUse, "sample: name a scene (" + names() + ") or use --list");
  const auto all = samples();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Sample& s) { return s.name == options.name; });
  if (found == all.end()) {
    return fail(kExitBadUse, fmt::format("sample: no scene \"{}\"; there are {}", options.name, names()));
  }
  if (options.out.empty()) return fail(kExitBadUse, "sample: --out FILE.glb says where to write");
  return write(*found, options);
}

}  // namespace

Command addSample(CLI::App& root) {
  auto options = std::make_shared<SampleOptions>();
  CLI::App* app = root.add_subcommand("sample", "Write a built-in scene as glTF, or list them");
  app->add_option("name", options->name, "Scene: " + names());
  app->add_option("-o,--out", options->out, "File to write: .glb, or .gltf with embedded buffers");
  app->add_flag("--list", options->list, "List the scenes");
  app->add_flag("--json", options->json, "Print JSON");
  return {app, [options] { return run(*options); }};
}

}  // namespace rigel::tools
