#include "report/write_report.h"

#include "report/report_html.h"
#include "report/report_json.h"
#include "report/write_together.h"

namespace rigel::tools {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPage = "report.html";
constexpr const char* kDocument = "report.json";

}  // namespace

std::optional<Error> reportObstacle(const fs::path& directory) {
  const char* const names[] = {kPage, kDocument};
  return obstacleTo(names, directory);
}

Result<WrittenReport> writeReport(const Report& report, const fs::path& directory) {
  Result<nlohmann::ordered_json> document = reportJson(report);
  if (!document) return document.error();
  const FileContent files[] = {{kPage, reportHtml(report, *document)}, {kDocument, jsonText(*document, 1) + '\n'}};
  if (auto failed = writeTogether(files, directory)) return *failed;
  return WrittenReport{directory / kPage, directory / kDocument, files[0].content.size()};
}

}  // namespace rigel::tools
