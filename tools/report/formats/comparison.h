// Several runs side by side: the same objects and rigs in two or more report.json files.
#pragma once

#include "report/formats/rig_figures.h"

#include <rigel/result.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rigel::tools {

/// What of a report.json is compared; all of it checked.
struct ReportFile {
  std::string name;  // of the file, as given
  nlohmann::ordered_json document;
};

/// Errors name the file, the place in it and the cause.
Result<ReportFile> parseReport(const std::string& name, std::string_view text);
Result<ReportFile> readReportFile(const std::filesystem::path& file);

/// One rig of one object in every run; a run that lacks it has no values.
struct ComparedRig {
  std::string scene, clip, object, spec, asked;
  std::vector<std::vector<std::optional<double>>> values;  // [figure][run], in the order of rigFigures()

  /// Of a run over the first, each held to RigFigure::least; empty where one of them has no value.
  std::optional<double> ratio(std::size_t figure, std::size_t run) const;
};

struct Comparison {
  std::vector<std::string> runs;
  std::vector<std::string> commands;
  std::vector<ComparedRig> rigs;
};

/// Rigs are the same where scene, clip, object, spec and what was asked of them are (a name that occurs again: in the
/// order of the files). Error where nothing is in more than one run.
Result<Comparison> compareReports(const std::vector<ReportFile>& runs);

/// How much worse than the first run another may be.
struct Limits {
  std::optional<double> error, time;  // ratios; empty: not judged
};

/// A line for each figure that is beyond them, and for each rig of the first run that another lacks.
std::vector<std::string> worsened(const Comparison& comparison, const Limits& limits);

std::string comparisonText(const Comparison& comparison);
std::string comparisonMarkdown(const Comparison& comparison);
std::string comparisonCsv(const Comparison& comparison);
std::string comparisonHtml(const Comparison& comparison);
nlohmann::ordered_json comparisonJson(const Comparison& comparison, const std::vector<std::string>& worse);

}  // namespace rigel::tools
