#include "report/write_report.h"

#include "report/report_html.h"
#include "report/report_json.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

/// A file that is written beside its final name and takes that name on commit(). Whatever had the name before is kept
/// until keep(); without it the destructor puts everything back.
class StagedFile {
 public:
  explicit StagedFile(fs::path target) : target_(std::move(target)), aside_(beside("new")), previous_(beside("old")) {}
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  ~StagedFile() {
    std::error_code ignored;
    fs::remove(aside_, ignored);
    if (!committed_ || kept_)
      fs::remove(previous_, ignored);
    else if (replaced_)
      fs::rename(previous_, target_, ignored);
    else
      fs::remove(target_, ignored);
  }

  std::optional<Error> write(std::string_view content) {
    std::FILE* file = std::fopen(aside_.c_str(), "wb");
    if (!file) return failure("cannot be written");
    const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
    const int writeError = errno;
    const bool closed = std::fclose(file) == 0;  // a full disk may show only here
    if (written && closed) return std::nullopt;
    if (!written) errno = writeError;
    return failure("cannot be written");
  }

  std::optional<Error> commit() {
    std::error_code error;
    if (fs::is_directory(target_, error))
      return Error{"is a directory, so the report cannot be written", target_.string()};
    replaced_ = fs::exists(target_, error);
    if (replaced_) {
      fs::remove(previous_, error);
      fs::create_hard_link(target_, previous_, error);
      if (error) fs::copy_file(target_, previous_, error);  // file systems without links
      if (error) return Error{"cannot be kept while it is replaced: " + error.message(), target_.string()};
    }
    fs::rename(aside_, target_, error);
    if (error) return Error{"cannot be written: " + error.message(), target_.string()};
    committed_ = true;
    return std::nullopt;
  }

  void keep() { kept_ = true; }

 private:
  fs::path beside(std::string_view kind) const {
    return target_.parent_path() / fmt::format(".{}.{}.{}", target_.filename().string(), ::getpid(), kind);
  }
  Error failure(std::string_view what) const {
    return Error{fmt::format("{}: {}", what, std::strerror(errno)), target_.string()};
  }

  fs::path target_, aside_, previous_;
  bool replaced_ = false, committed_ = false, kept_ = false;
};

}  // namespace

Result<WrittenReport> writeReport(const Report& report, const fs::path& directory) {
  Result<nlohmann::ordered_json> document = reportJson(report);
  if (!document) return document.error();
  const std::string html = reportHtml(report, *document);
  const std::string json = jsonText(*document, 1) + '\n';

  std::error_code error;
  fs::create_directories(directory, error);
  if (error) return Error{"cannot be made: " + error.message(), directory.string()};

  const WrittenReport written{directory / "report.html", directory / "report.json", html.size()};
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
