// rigel report: the main job. Fits rigs frame by frame, compares them with the truth, writes the report.
#include "cli/command.h"
#include "cli/compare_reports.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "cli/run_arguments.h"
#include "render/gpu_shading.h"
#include "report/files/made_directory.h"
#include "report/files/staged_images.h"
#include "report/files/write_report.h"
#include "report/formats/report_json.h"
#include "report/formats/report_text.h"
#include "report/run/capture.h"
#include "report/run/scene_run.h"
#include "scene/gltf_load.h"

#include <rigel/gpu_rig.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace rigel::tools {
namespace {

struct ReportArguments {
  std::vector<std::string> scenes;
  CompareArguments compare;
  std::string rigs = kDefaultRigs;
  RunArguments run;
  std::string device = "cpu";
  bool noImages = false;
  bool json = false;
  bool quiet = false;
  std::string out;
  std::string capture;
  std::string settingsNote;  // what came out of the scene's own settings
  const CLI::App* app = nullptr;
};

/// Takes from a captured file's settings what the command line leaves open, and says so. Built-in scenes have none;
/// several scenes cannot each have their own.
std::optional<Error> adoptSettings(ReportArguments& arguments) {
  if (arguments.scenes.size() != 1 || arguments.scenes.front().starts_with("sample:")) return std::nullopt;
  const std::string& file = arguments.scenes.front();
  const auto scene = loadScene(file);
  if (!scene) return scene.error();
  if (scene->settings.empty()) return std::nullopt;
  auto settings = parseRunSettings(scene->settings);
  if (!settings) return Error{settings.error().message, file + ": " + settings.error().place};
  std::vector<std::string> taken;
  if (settings->rigs && arguments.app->count("--rig") == 0) {
    arguments.rigs = *settings->rigs;
    taken.push_back("rigs");
  }
  std::ranges::move(arguments.run.adopt(*settings), std::back_inserter(taken));
  std::string& note = arguments.settingsNote;
  note = taken.empty() ? "settings in the file: all overridden"
                       : "settings from the file: " + fmt::format("{}", fmt::join(taken, ", "));
  for (const std::string& unknown : settings->notes) note += "; " + unknown;
  return std::nullopt;
}

Result<RunOptions> parse(const ReportArguments& arguments) {
  if (arguments.scenes.empty()) return Error{"name a scene, or --compare reports", "SCENE"};
  if (arguments.out.empty()) return Error{"the name of a directory is missing", "--out"};
  if (arguments.compare.maxError || arguments.compare.maxTime)
    return Error{"this judges what --compare compares", "--max-error-ratio, --max-time-ratio"};
  auto rigs = parseRigSpecs(arguments.rigs);
  if (!rigs) return rigs.error();
  if (arguments.device == "gpu") {
    for (const RigSpec& rig : *rigs)
      if (const auto error = checkGpuRig(rig)) return *error;
  }
  auto options = arguments.run.options();
  if (!options) return options.error();
  options->scenes = arguments.scenes;
  options->rigs = *std::move(rigs);
  options->images = !arguments.noImages;
  options->settingsNote = arguments.settingsNote;
  if (const auto error = checkOptions(*options)) return *error;
  return options;
}

/// The command as typed, for the report's foot; the program by its name alone.
std::string commandLine(const ReportArguments& a) {
  std::string line = "rigel report";
  for (const std::string& scene : a.scenes) line += " " + scene;
  line += " --rig \"" + a.rigs + "\"";
  line += a.run.text();
  if (a.device != "cpu") line += " --device " + a.device;
  if (a.noImages) line += " --no-images";
  return line + " --out " + a.out;
}

int runReportCommand(ReportArguments arguments) {
  if (const auto error = adoptSettings(arguments)) return fail(kExitBadInput, error->line());
  auto options = parse(arguments);
  if (!options) return fail(kExitBadUse, options.error().line());
  std::optional<GpuContext> device;  // outlives what shades with it
  if (arguments.device == "gpu") {
    auto context = GpuContext::create();
    if (!context) return fail(kExitBadInput, context.error().line());
    device = *std::move(context);
    options->cost = CostModel::shaders();
    options->shading = [&] { return makeGpuShading(*device); };
  }

  rememberInterrupts();
  const std::filesystem::path out(arguments.out);
  const auto made = MadeDirectory::make(out);
  if (!made) return fail(kExitBadInput, made.error().line());
  if (const auto error = reportObstacle(out)) return fail(kExitBadInput, error->line());
  const auto images = StagedImages::begin(out, options->images);
  if (!images) return fail(kExitBadInput, images.error().line());

  if (!arguments.capture.empty()) {  // before the run, so that one which fails can be sent too
    const auto written = writeCapture(*options, arguments.capture);
    if (!written) return fail(kExitBadInput, written.error().line());
  }
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
  if (device) report->device = device->name();

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

int compare(ReportArguments& arguments) {
  if (!arguments.scenes.empty())
    return fail(kExitBadUse, arguments.scenes.front() + ": --compare takes reports, and no scene beside them");
  arguments.compare.out = arguments.out;
  arguments.compare.json = arguments.json;
  return compareReportFiles(arguments.compare);
}

}  // namespace

Command addReport(CLI::App& root) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* app =
      root.add_subcommand("report", "Fit rigs to an animated scene, compare them with the truth, write a report");
  app->add_option("SCENE", arguments->scenes, "glTF files (.gltf, .glb) or sample:NAME (see: rigel sample --list)");
  app->add_option("--rig", arguments->rigs, "Rig specs, separated by ';'")->capture_default_str();
  arguments->run.add(*app);
  app->add_option("--device", arguments->device,
                  "Who evaluates rigs at points and in pictures: cpu, or gpu (Vulkan), which also measures half floats")
      ->capture_default_str()
      ->check(CLI::IsMember({"cpu", "gpu"}));
  app->add_option("--capture", arguments->capture,
                  "Write scene, lights and settings as one glTF file (.glb): rigel report FILE.glb runs them again");
  app->add_flag("--no-images", arguments->noImages, "Leave the pictures out");
  app->add_flag("--json", arguments->json, "Print report.json on standard output instead of the table");
  app->add_flag("--quiet", arguments->quiet, "No progress on standard error");
  arguments->app = app;
  app->add_option("--out", arguments->out, "Directory for report.html, report.json, report.md, report.csv and images/");
  app->add_option("--compare", arguments->compare.files,
                  "Instead of a scene: report.json of two runs or more, side by side; --out DIR takes compare.html, "
                  "compare.md, compare.csv and compare.json")
      ->type_name("FILE...");
  app->add_option("--max-error-ratio", arguments->compare.maxError,
                  "Exit with 1 where an error of a later run is more than this times the first run's");
  app->add_option("--max-time-ratio", arguments->compare.maxTime, "The same for times");
  app->footer(
      "Rig models: constant, gradient, lattice:AxBxC[:linear|smooth|cubic], mixed:m1,m2,m3 (c, g or lN an axis, by\n"
      "decreasing extent of the object; xyz: before them pins the axes), poly:K, invquad:K. Suffix @corners, @gauss,\n"
      "@numeric or @lsq picks how parameters are computed. auto[:K] takes, in each frame, as many of K SH vectors and\n"
      "as many near lights as its target needs. For comparison, on the CPU alone, what the paper tried and dropped:\n"
      "rbf:K (radial basis functions), latticegrad:AxBxC[:linear|smooth] and hermite:AxBxC (values and slopes).\n\n"
      "Examples: rigel report sample:street --rig \"gradient;poly:6\" --out street\n"
      "          rigel report sample:touch --rig \"auto;poly:6\" --near auto --error 0.02 --out touch\n"
      "          rigel report crowd.glb --lights sample:street --rig auto --budget-us 300 --out crowd\n"
      "          rigel report --compare old/report.json new/report.json --max-error-ratio 1.05");
  return {app, [arguments] {
            return arguments->compare.files.empty() ? runReportCommand(*arguments) : compare(*arguments);
          }};
}

}  // namespace rigel::tools
