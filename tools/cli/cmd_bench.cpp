// rigel bench: the benchmark figures (Google Benchmark), each with its baseline, compared within one run.
#include "bench/figures.h"
#include "bench/gpu_costs.h"
#include "cli/command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <regex>

namespace rigel::tools {
namespace {

struct BenchArguments {
  std::string filter = ".*";
  int repetitions = 5;
  bool json = false;
};

/// CPU figures, then those of the GPU, whose names match; what is wrong with the filter, or a device that is asked for
/// by name and not there.
Result<std::vector<Figure>> measure(const BenchArguments& arguments) {
  std::vector<std::string> gpu;
  try {
    const std::regex wanted(arguments.filter);
    for (const std::string& name : gpuFigureNames())
      if (std::regex_search(name, wanted)) gpu.push_back(name);
  } catch (const std::regex_error&) {
    return Error{"not a regular expression", "--filter " + arguments.filter};
  }
  auto figures = measureFigures(arguments.filter, arguments.repetitions);
  if (!figures && gpu.empty()) return figures.error();
  std::vector<Figure> all = figures ? *std::move(figures) : std::vector<Figure>{};
  if (gpu.empty()) return all;
  auto more = measureGpuFigures(gpu, arguments.repetitions);
  if (!more && all.empty()) return more.error();
  if (more) {
    std::ranges::move(*more, std::back_inserter(all));
  } else {
    fmt::print(stderr, "rigel: GPU figures left out: {}\n", more.error().line());
  }
  return all;
}

nlohmann::ordered_json json(const Figure& f) {
  nlohmann::ordered_json row{{"name", f.name}, {"value", f.value}, {"unit", f.unit}};
  if (!f.baseline.empty()) row.update({{"baseline", f.baseline}, {"ratio", f.ratio}});
  if (f.median > 0) row["median"] = f.median;
  if (f.limitFraction) row["limit_fraction"] = *f.limitFraction;
  if (f.instructions) row["instructions"] = *f.instructions;
  if (f.spatialError) row["spatial_error"] = *f.spatialError;
  if (f.totalError) row["total_error"] = *f.totalError;
  return row;
}

int runBench(const BenchArguments& arguments) {
  const auto figures = measure(arguments);
  if (!figures) return fail(kExitBadUse, figures.error().line());
  if (arguments.json) {
    nlohmann::ordered_json document;
    document["figures"] = nlohmann::ordered_json::array();
    for (const Figure& f : *figures) document["figures"].push_back(json(f));
    fmt::print("{}\n", document.dump(2));
    return kExitOk;
  }
  const auto percent = [](std::optional<double> e) { return e ? fmt::format("{:.2f} %", 100 * *e) : ""; };
  const bool gpu = std::ranges::any_of(*figures, [](const Figure& f) { return f.instructions.has_value(); });
  fmt::print(
      "{:<28} {:>10} {:>10}  {:<22} {:>8} {:>8}  {}\n", "figure", "time", "median", "unit", "ratio", "limit",
      gpu ? fmt::format("{:<28} {:>13} {:>9} {:>9}", "baseline", "instructions", "spatial", "total") : "baseline");
  for (const Figure& f : *figures) {
    std::string line = fmt::format("{:<28} {:>10.4g} {:>10}  {:<22} {:>8} {:>8}  {:<28}", f.name, f.value,
                                   f.median > 0 ? fmt::format("{:.4g}", f.median) : "", f.unit,
                                   f.baseline.empty() ? "" : fmt::format("{:.2f}x", f.ratio),
                                   f.limitFraction ? fmt::format("{:.1f} %", 100 * *f.limitFraction) : "", f.baseline);
    if (f.instructions)
      line += fmt::format(" {:>13} {:>9} {:>9}", *f.instructions, percent(f.spatialError), percent(f.totalError));
    fmt::print("{}\n", line);
  }
  return kExitOk;
}

}  // namespace

Command addBench(CLI::App& root) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* app = root.add_subcommand("bench", "Time projection, fitting and shading, each against its baseline");
  app->add_option("--filter", arguments->filter, "Regular expression on figure names")->capture_default_str();
  app->add_option("--repetitions", arguments->repetitions, "Repetitions, of which the least time counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app->add_flag("--json", arguments->json, "Figures as JSON");
  app->footer(
      "CPU time on one thread. Compare ratios: baseline and figure run in the same process, times of different\n"
      "runs or machines say little. Limit: the share of the multiply-adds that the machine does at best, measured\n"
      "beside the figure in vectors as wide (limit.fma). gpu.* time the shaders on the Vulkan device (minima, net of a "
      "shader without\n"
      "light), with the instructions of their SPIR-V and the errors of their rigs: what accuracy costs.");
  return {app, [arguments] { return runBench(*arguments); }};
}

}  // namespace rigel::tools
