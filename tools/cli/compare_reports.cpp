#include "cli/compare_reports.h"

#include "cli/command.h"
#include "report/files/write_together.h"
#include "report/formats/comparison.h"
#include "report/formats/report_json.h"
#include "report/words/wording.h"

#include <fmt/format.h>

namespace rigel::tools {
namespace {

std::optional<Error> checkRatio(const std::optional<double>& ratio, const char* option) {
  if (ratio && !(*ratio >= 1)) return Error{"a ratio is 1 or more", fmt::format("{} {:g}", option, *ratio)};
  return std::nullopt;
}

}  // namespace

int compareReportFiles(const CompareArguments& arguments) {
  if (arguments.files.size() < 2) return fail(kExitBadUse, "--compare: it takes two reports or more to compare");
  for (const auto& error :
       {checkRatio(arguments.maxError, "--max-error-ratio"), checkRatio(arguments.maxTime, "--max-time-ratio")})
    if (error) return fail(kExitBadUse, error->line());

  std::vector<ReportFile> runs;
  for (const std::string& file : arguments.files) {
    auto run = readReportFile(file);
    if (!run) return fail(kExitBadInput, printable(run.error().line()));
    runs.push_back(*std::move(run));
  }
  const auto comparison = compareReports(runs);
  if (!comparison) return fail(kExitBadInput, comparison.error().line());
  const std::vector<std::string> worse = worsened(*comparison, {arguments.maxError, arguments.maxTime});

  const std::string json = jsonText(comparisonJson(*comparison, worse), arguments.json ? -1 : 1);
  if (!arguments.out.empty()) {
    const FileContent files[] = {{"compare.html", comparisonHtml(*comparison)},
                                 {"compare.md", comparisonMarkdown(*comparison)},
                                 {"compare.csv", comparisonCsv(*comparison)},
                                 {"compare.json", json + '\n'}};
    if (const auto error = writeTogether(files, arguments.out)) return fail(kExitBadInput, error->line());
  }
  fmt::print("{}", arguments.json ? json + '\n' : comparisonText(*comparison));
  for (const std::string& line : worse) fmt::print(stderr, "rigel: {}\n", printable(line));
  return worse.empty() ? kExitOk : kExitBadInput;
}

}  // namespace rigel::tools
