#include "report/files/write_report.h"

#include "report/files/leftovers.h"
#include "report/files/write_together.h"
#include "report/formats/report_html.h"
#include "report/formats/report_json.h"
#include "report/formats/report_summary.h"

namespace rigel::tools {

namespace fs = std::filesystem;

std::optional<Error> reportObstacle(const fs::path& directory) { return obstacleTo(kReportFiles, directory); }

Result<WrittenReport> writeReport(const Report& report, const fs::path& directory) {
  Result<nlohmann::ordered_json> document = reportJson(report);
  if (!document) return document.error();
  const FileContent files[] = {{kReportFiles[0], reportHtml(report, *document)},
                               {kReportFiles[1], reportMarkdown(*document)},
                               {kReportFiles[2], reportCsv(*document)},
                               {kDocument, jsonText(*document, 1) + '\n'}};
  if (auto failed = writeTogether(files, directory)) return *failed;
  return WrittenReport{directory / kReportFiles[0], directory / kDocument, files[0].content.size()};
}

}  // namespace rigel::tools
