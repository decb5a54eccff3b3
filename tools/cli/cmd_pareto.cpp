// rigel pareto: what accuracy costs in time. Every rig, near light and band of a scene, one chart.
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "cli/run_arguments.h"
#include "pareto/pareto_json.h"
#include "pareto/pareto_run.h"
#include "pareto/pareto_text.h"
#include "pareto/write_pareto.h"
#include "report/files/made_directory.h"
#include "report/formats/report_json.h"

#include <fmt/format.h>

#include <memory>

namespace rigel::tools {
namespace {

const std::vector<int> kAllBands{2, 3, 4, 5};

struct ParetoArguments {
  std::string scene;
  RunArguments run;
  std::string rigs;
  std::vector<int> bands = kAllBands;
  std::string device = "auto";
  bool json = false;
  bool quiet = false;
  std::string out;
};

std::string commandLine(const ParetoArguments& a) {
  std::string line = "rigel pareto " + a.scene;
  if (!a.rigs.empty()) line += " --rig \"" + a.rigs + "\"";
  line += a.run.text();
  if (a.bands != kAllBands) line += fmt::format(" --bands {}", fmt::join(a.bands, ","));
  if (a.device != "auto") line += " --device " + a.device;
  return line + " --out " + a.out;
}

Result<ParetoOptions> parse(const ParetoArguments& arguments) {
  if (arguments.out.empty()) return Error{"the name of a directory is missing", "--out"};
  auto run = arguments.run.options();
  if (!run) return run.error();
  ParetoOptions options;
  options.run = *std::move(run);
  options.run.scenes = {arguments.scene};
  options.allFrames = arguments.run.framesGiven();
  if (!arguments.rigs.empty()) {
    auto rigs = parseRigSpecs(arguments.rigs);
    if (!rigs) return rigs.error();
    options.rigs = *std::move(rigs);
  }
  options.bands = arguments.bands;
  std::ranges::sort(options.bands);
  options.bands.erase(std::unique(options.bands.begin(), options.bands.end()), options.bands.end());
  options.run.rigs = paretoRigs();  // for the check alone
  if (const auto error = checkOptions(options.run)) return *error;
  return options;
}

int runParetoCommand(const ParetoArguments& arguments) {
  auto options = parse(arguments);
  if (!options) return fail(kExitBadUse, options.error().line());
  std::optional<GpuContext> device;
  std::string withoutDevice = "GPU times are left out: --device none";
  if (arguments.device != "none") {
    auto context = GpuContext::create();
    if (context) {
      device = *std::move(context);
      options->device = &*device;
    } else if (arguments.device == "gpu") {
      return fail(kExitBadInput, context.error().line());
    } else {
      withoutDevice = "GPU times are left out: " + context.error().line();
    }
  }

  rememberInterrupts();
  const std::filesystem::path out(arguments.out);
  const auto made = MadeDirectory::make(out);
  if (!made) return fail(kExitBadInput, made.error().line());
  if (const auto error = paretoObstacle(out)) return fail(kExitBadInput, error->line());
  auto pareto = [&] {
    ProgressLine progress(arguments.quiet);
    return runPareto(*options, [&](double share, const std::string& what) {
      stopIfInterrupted();
      progress(share, what);
    });
  }();
  if (!pareto) return fail(kExitBadInput, pareto.error().line());
  pareto->version = RIGEL_VERSION;
  pareto->commandLine = commandLine(arguments);
  if (!device) pareto->notes.push_back(withoutDevice);
  if (const auto error = writePareto(*pareto, out)) return fail(kExitBadInput, error->line());
  if (arguments.json) {
    fmt::print("{}\n", jsonText(*paretoJson(*pareto), -1));  // written above, so it is sound
  } else {
    fmt::print("{}{}\n", frontText(*pareto), (out / "pareto.html").string());
  }
  return kExitOk;
}

}  // namespace

Command addPareto(CLI::App& root) {
  auto arguments = std::make_shared<ParetoArguments>();
  CLI::App* app = root.add_subcommand("pareto", "Chart what accuracy costs in time, for every rig and near light");
  app->add_option("SCENE", arguments->scene, "A glTF file (.gltf, .glb) or sample:NAME (see: rigel sample --list)")
      ->required();
  app->add_option("--rig", arguments->rigs, "Rig specs, separated by ';' [every family over its sizes]");
  app->add_option("--bands", arguments->bands, "SH bands, separated by ','")
      ->delimiter(',')
      ->check(CLI::Range(kMinBands, kMaxBands))
      ->capture_default_str();
  arguments->run.addScene(*app);
  app->add_option("--device", arguments->device,
                  "Time shaders, too, on a Vulkan device: auto (where there is one), gpu, or none")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "gpu", "none"}));
  app->add_flag("--json", arguments->json, "Print pareto.json on standard output instead of the fronts");
  app->add_flag("--quiet", arguments->quiet, "No progress on standard error");
  app->add_option("--out", arguments->out, "Directory for pareto.html, pareto.json, pareto.csv and pareto.svg")
      ->required();
  app->footer(
      "Each rig is measured with 0, 1, 2 and 4 near lights and with as many as it chooses (--near auto), in all "
      "bands.\n"
      "Errors are over 4096 points of the surface in 24 frames spread over the clip, or in those of --frames; each\n"
      "point of the chart says how far off that may be. Times are of one thread, the least of interleaved "
      "repetitions.\n\n"
      "Examples: rigel pareto sample:street --out street\n"
      "          rigel pareto Fox.glb --clip Run --lights sample:street --rig \"poly:6;poly:12;auto\" --out fox");
  return {app, [arguments] { return runParetoCommand(*arguments); }};
}

}  // namespace rigel::tools
