#include "report/files/earlier_pictures.h"
#include "report/formats/comparison.h"

#include "expect.h"
#include "targets.h"

namespace rigel::fuzz {
namespace {

/// What the program writes of a report that it accepts, beside another.
void compareWithItself(std::string_view text) {
  const auto report = tools::parseReport("a.json", text);
  if (!report) return expect(report.error().line().find('\n') == std::string::npos, "errors are one line");
  const auto comparison = tools::compareReports({*report, *report});
  if (!comparison) return;
  expect(tools::worsened(*comparison, {1.0, 1.0}).empty(), "nothing is worse than itself");
  (void)tools::comparisonText(*comparison);
  (void)tools::comparisonMarkdown(*comparison);
  (void)tools::comparisonCsv(*comparison);
  (void)tools::comparisonJson(*comparison, {}).dump();
  const std::string page = tools::comparisonHtml(*comparison);
  expect(page.find("<script") == std::string::npos, "names stay text");
}

}  // namespace

void reportJson(std::string_view text) {
  for (const std::string& name : tools::picturesNamedIn(text))
    expect(!name.empty() && name.find('/') == std::string::npos && name.find('\0') == std::string::npos,
           "names stay in the folder: " + name);
  compareWithItself(text);
}

}  // namespace rigel::fuzz
