// rigel bench: the benchmark figures (Google Benchmark), each with its baseline, compared within one run.
#include "bench/figures.h"
#include "cli/command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace rigel::tools {
namespace {

struct Arguments {
  std::string filter = ".*";
  int repetitions = 5;
  bool json = false;
};

int runBench(const Arguments& arguments) {
  const auto figures = measureFigures(arguments.filter, arguments.repetitions);
  if (!figures) return fail(kExitBadUse, figures.error().line());
  if (arguments.json) {
    nlohmann::ordered_json document;
    document["figures"] = nlohmann::ordered_json::array();
    for (const Figure& f : *figures) {
      nlohmann::ordered_json row{{"name", f.name}, {"value", f.value}, {"unit", f.unit}};
      if (!f.baseline.empty()) row.update({{"baseline", f.baseline}, {"ratio", f.ratio}});
      document["figures"].push_back(std::move(row));
    }
    fmt::print("{}\n", document.dump(2));
    return kExitOk;
  }
  fmt::print("{:<28} {:>10}  {:<22} {:>8}  {}\n", "figure", "median", "unit", "ratio", "baseline");
  for (const Figure& f : *figures)
    fmt::print("{:<28} {:>10.4g}  {:<22} {:>8}  {}\n", f.name, f.value, f.unit,
               f.baseline.empty() ? "" : fmt::format("{:.2f}x", f.ratio), f.baseline);
  return kExitOk;
}

}  // namespace

Command addBench(CLI::App& root) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* app = root.add_subcommand("bench", "Time projection, fitting and shading, each against its baseline");
  app->add_option("--filter", arguments->filter, "Regular expression on figure names")->capture_default_str();
  app->add_option("--repetitions", arguments->repetitions, "Repetitions; the median counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app->add_flag("--json", arguments->json, "Figures as JSON");
  app->footer(
      "CPU time on one thread. Compare ratios: baseline and figure run in the same process, times of different\n"
      "runs or machines say little.");
  return {app, [arguments] { return runBench(*arguments); }};
}

}  // namespace rigel::tools
