#include "report/write_report.h"

#include "report/report_html.h"
#include "report/report_json.h"
#include "report/staged_file.h"

#include <system_error>

namespace rigel::tools {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPage = "report.html";
constexpr const char* kDocument = "report.json";

}  // namespace

std::optional<Error> reportObstacle(const fs::path& directory) {
  std::error_code ignored;
  for (const char* name : {kPage, kDocument})
    if (fs::is_directory(directory / name, ignored))
      return Error{"is a directory, so the report cannot be written", (directory / name).string()};
  return std::nullopt;
}

Result<WrittenReport> writeReport(const Report& report, const fs::path& directory) {
  Result<nlohmann::ordered_json> document = reportJson(report);
  if (!document) return document.error();
  const std::string html = reportHtml(report, *document);
  const std::string json = jsonText(*document, 1) + '\n';

  std::error_code error;
  fs::create_directories(directory, error);
  if (error) return Error{"cannot be made: " + error.message(), directory.string()};

  const WrittenReport written{directory / kPage, directory / kDocument, html.size()};
  StagedFile htmlFile(written.html);
  StagedFile jsonFile(written.json);
  if (auto failed = htmlFile.write(html)) return *failed;
  if (auto failed = jsonFile.write(json)) return *failed;
  if (auto failed = htmlFile.commit()) return *failed;
  if (auto failed = jsonFile.commit()) return *failed;
  htmlFile.keep();
  jsonFile.keep();
  return written;
}

}  // namespace rigel::tools
