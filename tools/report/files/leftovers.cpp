#include "report/files/leftovers.h"

#include "report/files/earlier_pictures.h"
#include "report/pictures/picture_names.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

namespace rigel::tools {

namespace fs = std::filesystem;

namespace {

bool isDead(const std::string& process) {
  constexpr std::size_t kLongestId = 9;  // beyond it is no process id, and so no folder of ours
  return process.size() <= kLongestId && ::kill(std::stoi(process), 0) != 0 && errno == ESRCH;
}

/// The new report was not yet there: what had its names before comes back, the report last.
void putBack(const fs::path& aside, const fs::path& report) {
  std::error_code code;
  const fs::path images = report / kImageFolder;
  std::ifstream placing(aside / kPlacing);
  for (std::string name; std::getline(placing, name);)
    if (isPictureName(name)) fs::remove(images / name, code);
  for (fs::directory_iterator entry(aside / kPrevious, code), end; !code && entry != end; entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (std::ranges::find(kReportFiles, name) == std::end(kReportFiles))
      fs::rename(entry->path(), images / name, ignored);
  }
  fs::remove(images, code);  // if nothing is left in it
  for (const char* name : kReportFiles) fs::rename(aside / kPrevious / name, report / name, code);
}

void finish(const fs::path& aside, const fs::path& report) {
  std::error_code code;
  const std::set<std::string> named = earlierPictures(report);
  for (const std::string& name : picturesNamed(aside / kPrevious / kDocument, report))
    if (!named.contains(name)) fs::remove(report / kImageFolder / name, code);
  fs::remove(report / kImageFolder, code);  // if nothing is left in it
}

}  // namespace

void putInOrder(const fs::path& report) {
  const std::regex folder(fmt::format(R"(\.{}\.(\d+))", kImageFolder));
  const std::regex file(R"(\.(?:rigel|report\.(?:html|md|csv|json))\.(\d+)\.(?:new|old))");
  std::error_code code;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator entry(report, code), end; !code && entry != end; entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    const bool real = !entry->is_symlink(code);
    std::smatch match;
    const bool ours = real && std::regex_match(name, match, entry->is_directory(code) ? folder : file);
    if (ours && isDead(match[1])) leftovers.push_back(entry->path());
  }
  for (const fs::path& path : leftovers) {
    if (fs::exists(path / kPlacing, code)) {
      if (fs::exists(report / kDocument, code))
        finish(path, report);
      else
        putBack(path, report);
    }
    fs::remove_all(path, code);
  }
}

}  // namespace rigel::tools
