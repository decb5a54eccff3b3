// rigel render: a scene through the GPU path, to pictures, compared with the CPU path or the truth.
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "cli/run_arguments.h"
#include "cli/user_cache.h"
#include "picture/image_io.h"
#include "picture/tone_map.h"
#include "render/scene_render.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

struct RenderArguments {
  std::string scene;
  std::string rig = "auto";
  RunArguments run{"0"};
  std::string object;
  std::string size = "1280x720";
  int supersampling = 2;
  std::string storage = "float32";
  std::string disks = "quadrature";
  bool perVertex = false;
  std::string against;
  bool validate = false;
  bool noShaderCache = false;
  bool json = false;
  bool quiet = false;
  std::string out;
};

const std::map<std::string, RigStorage> kStorages{{"float32", RigStorage::float32},
                                                  {"float16", RigStorage::float16},
                                                  {"texture32", RigStorage::texture32},
                                                  {"texture16", RigStorage::texture16}};
const std::map<std::string, Effect> kDiskBands{{"quadrature", Effect::light_near_diskQuadrature},
                                               {"table", Effect::light_near_diskTable}};
const std::map<std::string, RenderReference> kReferences{
    {"", RenderReference::none}, {"cpu", RenderReference::cpu}, {"truth", RenderReference::truth}};

Result<RenderOptions> parse(const RenderArguments& a) {
  RenderOptions options;
  auto run = a.run.options();
  if (!run) return run.error();
  options.run = *std::move(run);
  options.run.scenes = {a.scene};
  const auto rig = parseRigSpec(a.rig);
  if (!rig) return rig.error();
  if (const auto error = checkGpuRig(*rig)) return *error;
  options.run.rigs = {*rig};
  if (options.run.clip == "all") return Error{"one clip at a time", "--clip all"};
  if (const auto error = checkOptions(options.run)) return *error;
  const auto size = parsePictureSize(a.size);
  if (!size) return size.error();
  std::tie(options.width, options.height) = *size;
  options.object = a.object;
  options.supersampling = a.supersampling;
  options.storage = kStorages.at(a.storage);
  if (isTexture(options.storage) && !fitsTexture(*rig))
    return Error{"textures hold lattices alone, without slopes, @gauss or cubic blends",
                 "--storage " + a.storage + " --rig " + a.rig};
  options.perVertex = a.perVertex;
  options.wrappedDisk = kDiskBands.at(a.disks);
  options.against = kReferences.at(a.against);
  if (!a.noShaderCache) options.shaderCache = userCacheFile("shaders");
  const std::string extension = std::filesystem::path(a.out).extension();
  if (extension != ".exr" && extension != ".png")
    return Error{"a file name ending in .exr or .png is needed", "--out " + a.out};
  return options;
}

std::optional<Error> write(const RenderResult& result, const std::filesystem::path& file) {
  const auto written = file.extension() == ".exr" ? writeExr(result.radiance, file, ExrDepth::full)
                                                  : writePng(toneMap(result.radiance, result.exposure), file);
  return written ? std::nullopt : std::optional(written.error());
}

/// What is said of all frames together.
class Summary {
 public:
  Summary(const RenderArguments& arguments, const GpuContext& context)
      : json_{{"scene", arguments.scene},
              {"rig", arguments.rig},
              {"storage", arguments.storage},
              {"device", context.name()}} {}

  /// `deviceMilliseconds`: to make the device.
  void start(const SceneRender& render, const GpuContext& context, double deviceMilliseconds) {
    json_["load_ms"] = deviceMilliseconds + render.loadMilliseconds();
    json_["pipelines"] = render.pipelines();
    for (const auto* notes : {&context.notes(), &render.notes()})
      notes_.insert(notes_.end(), notes->begin(), notes->end());
  }

  void add(const RenderResult& result, const std::string& file) {
    Json row{{"frame", result.number},
             {"time", result.time},
             {"file", file},
             {"frame_ms", result.frameMilliseconds},
             {"shading_ms", result.frameMilliseconds - result.unlitMilliseconds}};
    row["rigs"] = Json::array();
    for (const RigState& rig : result.rigs)
      row["rigs"].push_back({{"object", rig.object}, {"sh_vectors", rig.shVectors}, {"near_lights", rig.near.size()}});
    if (frames_.empty()) json_["first_frame_ms"] = result.drawMilliseconds;
    if (result.difference) {
      const Difference& d = *result.difference;
      row.update({{"rms", d.rms},
                  {"max", d.max},
                  {"p99", d.p99},
                  {"covered", d.covered},
                  {"compared", d.compared},
                  {"apart", d.apart}});
      squares_ += d.rms * d.rms;
      max_ = std::max(max_, d.max);
      p99_ = std::max(p99_, d.p99);
      pixels_ += d.compared;
      covered_ += d.covered;
      compared_ = true;
    }
    frames_.push_back(row);
    effects_.add(result.effects);
    milliseconds_.push_back(result.frameMilliseconds);
    for (int s = 0; s < FitTimes::kStages; ++s)
      if (result.stages.stages[s]) stages_[s].push_back(*result.stages.stages[s]);
  }

  Json json() const {
    Json out = json_;
    if (compared_)
      out.update({{"rms", std::sqrt(squares_ / static_cast<double>(frames_.size()))},
                  {"max", max_},
                  {"p99", p99_},
                  {"covered", covered_},
                  {"compared", pixels_}});
    out["frame_ms"] = median(milliseconds_);
    out["effects"] = Json::array();
    for (const Effect effect : kAllEffects)
      if (effects_.has(effect)) out["effects"].push_back(effectName(effect));
    out["stages"] = Json::object();
    for (int s = 0; s < FitTimes::kStages; ++s)
      if (!stages_[s].empty()) out["stages"][FitTimes::kNames[s]] = median(stages_[s]);
    out["notes"] = notes_;
    out["frames"] = frames_;
    return out;
  }

 private:
  static double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
  }

  Json json_;
  Json frames_ = Json::array();
  std::vector<std::string> notes_;
  Effects effects_;
  std::vector<double> milliseconds_;
  std::array<std::vector<double>, FitTimes::kStages> stages_;
  double squares_ = 0, max_ = 0, p99_ = 0;
  std::size_t pixels_ = 0, covered_ = 0;
  bool compared_ = false;
};

void print(const Json& summary) {
  for (const Json& frame : summary["frames"]) {
    std::string line = fmt::format("{}: {:.1f} ms, of which {:.1f} ms of shading", frame["file"].get<std::string>(),
                                   frame["frame_ms"].get<double>(), frame["shading_ms"].get<double>());
    if (frame.contains("rms"))
      line += fmt::format("; difference RMS {:.2g}, largest {:.2g} of the mean light ({} of {} pixels compared)",
                          frame["rms"].get<double>(), frame["max"].get<double>(), frame["compared"].get<int>(),
                          frame["covered"].get<int>());
    fmt::print("{}\n", line);
  }
  std::string effects;
  for (const Json& effect : summary["effects"]) effects += (effects.empty() ? "" : ", ") + effect.get<std::string>();
  fmt::print("{}; effects: {}\n", summary["device"].get<std::string>(), effects);
  for (const Json& note : summary["notes"]) fmt::print("note: {}\n", note.get<std::string>());
}

int runRender(const RenderArguments& arguments) {
  const auto options = parse(arguments);
  if (!options) return fail(kExitBadUse, options.error().line());
  rememberInterrupts();
  GpuOptions device;
  device.validation = arguments.validate;
  if (!arguments.noShaderCache) device.pipelineCache = userCacheFile("pipelines");
  const auto start = std::chrono::steady_clock::now();
  auto context = GpuContext::create(device);
  if (!context) return fail(kExitBadInput, context.error().line());
  const std::chrono::duration<double, std::milli> deviceTime = std::chrono::steady_clock::now() - start;

  Summary summary(arguments, *context);
  {
    ProgressLine progress(arguments.quiet);
    progress(0, "loading " + arguments.scene);
    auto render = SceneRender::create(*options, *context);
    if (!render) return fail(kExitBadInput, render.error().line());
    if (!device.pipelineCache.empty()) context->savePipelineCache();  // what cannot be kept is only slower next time
    summary.start(*render, *context, deviceTime.count());
    const std::vector<int>& frames = render->frames();
    for (std::size_t f = 0; f < frames.size(); ++f) {
      stopIfInterrupted();
      progress(static_cast<double>(f) / static_cast<double>(frames.size()), fmt::format("frame {}", frames[f]));
      const auto result = render->render(frames[f]);
      if (!result) return fail(kExitBadInput, result.error().line());
      if (result->difference && result->difference->compared == 0)
        return fail(kExitBadInput, fmt::format("{}: no pixel of frame {} can be compared", arguments.scene, frames[f]));
      const auto file = numberedFile(arguments.out, frames[f], frames.size() > 1);
      if (const auto error = write(*result, file)) return fail(kExitBadInput, error->line());
      summary.add(*result, file.string());
    }
  }
  for (const std::string& message : context->messages()->take()) return fail(kExitBadInput, "Vulkan: " + message);
  const Json json = summary.json();
  if (arguments.json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print(json);
  }
  return kExitOk;
}

std::vector<std::string> namesOf(const auto& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map)
    if (!name.empty()) names.push_back(name);
  return names;
}

}  // namespace

Command addRender(CLI::App& root) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* app = root.add_subcommand("render", "Draw a scene on the GPU (Vulkan), lit by its rigs and near lights");
  app->add_option("SCENE", arguments->scene, "A glTF file (.gltf, .glb) or sample:NAME (see: rigel sample --list)")
      ->required();
  app->add_option("--rig", arguments->rig, "Rig spec")->capture_default_str();
  arguments->run.add(*app);
  app->add_option("--object", arguments->object, "Frame this object [all that move]");
  app->add_option("--size", arguments->size, "Picture, WIDTHxHEIGHT")->capture_default_str();
  app->add_option("--supersampling", arguments->supersampling, "Samples a side of each pixel of the picture")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxSupersampling));
  app->add_option("--storage", arguments->storage, "How coefficients reach the shader; texture: lattice rigs alone")
      ->capture_default_str()
      ->check(CLI::IsMember(namesOf(kStorages)));
  app->add_option("--disks", arguments->disks, "Where shaders take the bands of near disk lights from, on what wraps")
      ->check(CLI::IsMember(namesOf(kDiskBands)))
      ->capture_default_str();
  app->add_flag("--per-vertex", arguments->perVertex, "Shade vertices instead of pixels");
  app->add_option("--against", arguments->against, "Compare with the CPU path (cpu) or exact irradiance (truth)")
      ->check(CLI::IsMember(namesOf(kReferences)));
  app->add_flag("--validate", arguments->validate, "Let Vulkan's validation layer watch; its messages are errors");
  app->add_flag("--no-shader-cache", arguments->noShaderCache,
                "Make every shader and pipeline anew, and keep none for the next run");
  app->add_flag("--json", arguments->json, "Print figures as JSON");
  app->add_flag("--quiet", arguments->quiet, "No progress on standard error");
  app->add_option("--out", arguments->out,
                  "FILE.exr (linear radiance) or FILE.png; FILE-0042.png where frames are several")
      ->required();
  app->footer(
      "The device is the best there is; RIGEL_VULKAN_DEVICE takes another by part of its name. Without a GPU Mesa's\n"
      "lavapipe does: apt-get install mesa-vulkan-drivers. Under XDG_CACHE_HOME (~/.cache) rigel/shaders keeps shaders "
      "as\n"
      "scenes called for them, and rigel/pipelines what this device's driver compiled; Mesa's own cache is under\n"
      "MESA_SHADER_CACHE_DIR.\n\n"
      "--json: load_ms is the device, its pipelines and their first draws; first_frame_ms the first frame until it "
      "has\n"
      "been read back; frame_ms the device's time for a frame. No scene, rig or file is counted.\n\n"
      "Examples: rigel render sample:street --out street.png\n"
      "          rigel render sample:dragon --rig poly:6 --near 2 --frames 0:60 --out dragon.png\n"
      "          rigel render sample:stage --rig poly:12 --against truth --json --out stage.exr");
  return {app, [arguments] { return runRender(*arguments); }};
}

}  // namespace rigel::tools
