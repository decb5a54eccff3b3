// rigel report: the main job. Fits rigs frame by frame, compares them with the truth, writes the report.
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "report/made_directory.h"
#include "report/report_json.h"
#include "report/report_text.h"
#include "report/scene_run.h"
#include "report/staged_images.h"
#include "report/write_report.h"

#include <rigel/sh.h>
#include <rigel/wrap.h>

#include <fmt/format.h>

#include <memory>
#include <optional>

namespace rigel::tools {
namespace {

constexpr const char* kDefaultRigs = "constant;gradient;mixed:l3,g,c;lattice:3x2x2;lattice:8x4x2;poly:6;poly:12;auto";

struct Arguments {
  std::vector<std::string> scenes;
  std::string rigs = kDefaultRigs;
  std::string clip;
  std::string frames = "0:";
  double rate = kDefaultRate;
  std::string near;
  std::optional<float> error, totalError, budget;
  float wrap = 0;
  CLI::Option* wrapGiven = nullptr;
  int bands = kDefaultBands;
  float exposure = 1;
  std::string lights;
  bool noImages = false;
  bool json = false;
  bool quiet = false;
  std::string out;
};

std::optional<LightingTarget> targetOf(const Arguments& a) {
  using Kind = LightingTarget::Kind;
  if (a.error) return LightingTarget{Kind::spatialError, *a.error};
  if (a.totalError) return LightingTarget{Kind::totalError, *a.totalError};
  return std::nullopt;
}

Result<RunOptions> parse(const Arguments& arguments) {
  if (arguments.out.empty()) return Error{"the name of a directory is missing", "--out"};
  RunOptions options;
  auto rigs = parseRigSpecs(arguments.rigs);
  if (!rigs) return rigs.error();
  const auto frames = parseFrameRange(arguments.frames);
  if (!frames) return frames.error();
  options.scenes = arguments.scenes;
  options.rigs = *std::move(rigs);
  options.clip = arguments.clip;
  options.frames = *frames;
  options.rate = arguments.rate;
  if (!arguments.near.empty()) {
    const auto near = parseNear(arguments.near);
    if (!near) return near.error();
    options.near = *near;
  }
  if (arguments.error && arguments.totalError)
    return Error{"only one of the two can be aimed at",
                 fmt::format("--error {:g} --total-error {:g}", *arguments.error, *arguments.totalError)};
  options.target = targetOf(arguments);
  options.budget = arguments.budget;
  if (arguments.wrapGiven->count() > 0) options.wrap = arguments.wrap;
  options.bands = arguments.bands;
  options.exposure = arguments.exposure;
  options.lights = arguments.lights;
  options.images = !arguments.noImages;
  if (const auto error = checkOptions(options)) return *error;
  return options;
}

/// The command as typed, for the report's foot; the program by its name alone.
std::string commandLine(const Arguments& a) {
  std::string line = "rigel report";
  for (const std::string& scene : a.scenes) line += " " + scene;
  line += " --rig \"" + a.rigs + "\"";
  if (!a.clip.empty()) line += " --clip " + a.clip;
  if (a.frames != "0:") line += " --frames " + a.frames;
  if (a.rate != kDefaultRate) line += fmt::format(" --rate {}", a.rate);
  if (!a.near.empty()) line += " --near " + a.near;
  if (const std::string aim = aimOptions(targetOf(a), a.budget); !aim.empty()) line += " " + aim;
  if (a.wrapGiven->count() > 0) line += fmt::format(" --wrap {}", a.wrap);
  if (a.bands != kDefaultBands) line += fmt::format(" --bands {}", a.bands);
  if (a.exposure != 1) line += fmt::format(" --exposure {}", a.exposure);
  if (!a.lights.empty()) line += " --lights " + a.lights;
  if (a.noImages) line += " --no-images";
  return line + " --out " + a.out;
}

int runReportCommand(const Arguments& arguments) {
  const auto options = parse(arguments);
  if (!options) return fail(kExitBadUse, options.error().line());

  rememberInterrupts();
  const std::filesystem::path out(arguments.out);
  const auto made = MadeDirectory::make(out);
  if (!made) return fail(kExitBadInput, made.error().line());
  if (const auto error = reportObstacle(out)) return fail(kExitBadInput, error->line());
  const auto images = StagedImages::begin(out, options->images);
  if (!images) return fail(kExitBadInput, images.error().line());

  auto report = [&] {
    ProgressLine progress(arguments.quiet);
    return runReport(*options, (*images)->directory(), [&](double share, const std::string& what) {
      stopIfInterrupted();
      progress(share, what);
    });
  }();
  if (!report) return fail(kExitBadInput, report.error().line());
  report->version = RIGEL_VERSION;
  report->commandLine = commandLine(arguments);

  if (const auto error = (*images)->putInPlace()) return fail(kExitBadInput, error->line());
  const auto written = writeReport(*report, out);
  if (!written) return fail(kExitBadInput, written.error().line());
  (*images)->keep();
  if (arguments.json) {
    fmt::print("{}\n", jsonText(*reportJson(*report), -1));  // written above, so it is sound
  } else {
    fmt::print("{}\n{}\n", reportText(*report), written->html.string());
  }
  return kExitOk;
}

}  // namespace

Command addReport(CLI::App& root) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* app =
      root.add_subcommand("report", "Fit rigs to an animated scene, compare them with the truth, write a report");
  app->add_option("SCENE", arguments->scenes, "glTF files (.gltf, .glb) or sample:NAME (see: rigel sample --list)")
      ->required();
  app->add_option("--rig", arguments->rigs, "Rig specs, separated by ';'")->capture_default_str();
  app->add_option("--clip", arguments->clip, "Animation clip by name, or 'all' [the first]");
  app->add_option("--frames", arguments->frames, "FIRST:LAST:STEP in frames of the clip, counted at --rate")
      ->capture_default_str();
  app->add_option("--rate", arguments->rate, "Frames a second at which the clip is looked at")->capture_default_str();
  app->add_option("--near", arguments->near,
                  "Lights evaluated exactly at every point: a number, or auto [auto for `auto` rigs, 0 for others]");
  app->add_option("--error", arguments->error,
                  "What `auto` and --near auto aim at: spatial RMS error over the mean light [0.05]");
  app->add_option("--total-error", arguments->totalError, "The same for the total RMS error");
  app->add_option("--budget-us", arguments->budget,
                  "Time for all objects of a frame together, in modelled microseconds, 10000 points an object:\n"
                  "what each aims at is then given up where it shows least [no limit]");
  arguments->wrapGiven =
      app->add_option("--wrap", arguments->wrap, "Wrap reflectance of everything; 0 is Lambert [the materials']")
          ->check(CLI::Range(kMinWrap, kMaxWrap));
  app->add_option("--bands", arguments->bands, "SH bands")
      ->capture_default_str()
      ->check(CLI::Range(kMinBands, kMaxBands));
  app->add_option("--lights", arguments->lights, "Take the lights of another scene, scaled to this one's size");
  app->add_option("--exposure", arguments->exposure, "Multiplies all light")->capture_default_str();
  app->add_flag("--no-images", arguments->noImages, "Leave the pictures out");
  app->add_flag("--json", arguments->json, "Print report.json on standard output instead of the table");
  app->add_flag("--quiet", arguments->quiet, "No progress on standard error");
  app->add_option("--out", arguments->out, "Directory for report.html, report.json and images/")->required();
  app->footer(
      "Rig models: constant, gradient, lattice:AxBxC[:linear|smooth|cubic], mixed:m1,m2,m3 (c, g or lN an axis, by\n"
      "decreasing extent of the object; xyz: before them pins the axes), poly:K, invquad:K. Suffix @corners, @gauss,\n"
      "@numeric or @lsq picks how parameters are computed. auto[:K] takes, in each frame, as many of K SH vectors and\n"
      "as many near lights as its target needs.\n\n"
      "Examples: rigel report sample:street --rig \"gradient;poly:6\" --out street\n"
      "          rigel report sample:touch --rig \"auto;poly:6\" --near auto --error 0.02 --out touch\n"
      "          rigel report crowd.glb --lights sample:street --rig auto --budget-us 3000 --out crowd");
  return {app, [arguments] { return runReportCommand(*arguments); }};
}

}  // namespace rigel::tools
