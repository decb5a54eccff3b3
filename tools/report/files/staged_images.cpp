#include "report/files/staged_images.h"

#include "report/files/leftovers.h"
#include "report/pictures/picture_names.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <ranges>
#include <system_error>

namespace rigel::tools {

namespace fs = std::filesystem;

namespace {

bool isTaken(const fs::path& path) {
  std::error_code code;
  return fs::symlink_status(path, code).type() != fs::file_type::not_found;
}

}  // namespace

StagedImages::StagedImages(const fs::path& report)
    : report_(report),
      target_(report / kImageFolder),
      aside_(report / fmt::format(".{}.{}", kImageFolder, ::getpid())),
      earlier_(earlierPictures(report)) {}

Result<std::unique_ptr<StagedImages>> StagedImages::begin(const fs::path& report, bool pictures) {
  putInOrder(report);
  std::unique_ptr<StagedImages> images(new StagedImages(report));
  std::error_code code;
  fs::remove_all(images->aside_, code);  // of a program that was killed and had our process id
  fs::create_directory(images->aside_, code);
  if (code) return Error{"cannot be made: " + code.message(), images->aside_.string()};
  if (!pictures) return images;
  if (auto error = images->check()) return *error;
  return images;
}

std::optional<Error> StagedImages::check() const {
  if (!exists(target_)) return std::nullopt;
  std::error_code code;
  if (!fs::is_directory(target_, code))
    return Error{"is not a directory, so pictures cannot be put there", target_.string()};

  // The way every picture will go, which tells of permissions and of links to other file systems.
  const fs::path probe = target_ / aside_.filename();
  fs::create_directory(aside_ / kPrevious, code);
  if (!code) fs::rename(aside_ / kPrevious, probe, code);
  if (code) return Error{"pictures cannot be put there: " + code.message(), target_.string()};
  fs::remove(probe, code);

  // Pictures by our names that no report names: better refused now than when they turn out to be in the way.
  for (fs::directory_iterator entry(target_, code), end; !code && entry != end; entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    if (isPictureName(name) && !earlier_.contains(name))
      return Error{"looks like a picture of a report that is gone; move it away first", entry->path().string()};
  }
  if (code) return Error{"cannot be read: " + code.message(), target_.string()};
  return std::nullopt;
}

std::optional<Error> StagedImages::putInPlace() {
  std::error_code code;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(aside_, code), end; !code && entry != end; entry.increment(code))
    if (entry->is_regular_file(code)) names.push_back(entry->path().filename().string());
  if (code) return Error{"cannot be read: " + code.message(), aside_.string()};
  std::ranges::sort(names);

  fs::create_directory(aside_ / kPrevious, code);
  if (code) return Error{"cannot be written: " + code.message(), aside_.string()};
  earlier_ = earlierPictures(report_);  // another program may have been quicker
  if (auto error = withdraw(names)) return error;
  if (names.empty()) return std::nullopt;
  madeTarget_ = fs::create_directory(target_, code);
  if (code) return Error{"the pictures cannot be put in place: " + code.message(), target_.string()};
  for (const std::string& name : names) {
    if (isTaken(target_ / name) && !earlier_.contains(name))
      return Error{"is in the way of a picture and no report names it; move it away first", (target_ / name).string()};
    files_.push_back(std::make_unique<StagedFile>(target_ / name, aside_ / name, aside_ / kPrevious / name));
    if (auto error = files_.back()->commit()) return error;
    placed_.insert(name);
  }
  return std::nullopt;
}

std::optional<Error> StagedImages::withdraw(const std::vector<std::string>& names) {
  std::ofstream list(aside_ / kPlacing);
  for (const std::string& name : names)
    if (!isTaken(target_ / name)) list << name << '\n';
  list.close();
  if (!list) return Error{"cannot be written", (aside_ / kPlacing).string()};
  for (const char* name : std::views::reverse(kReportFiles)) {
    std::error_code code;
    if (!fs::is_regular_file(fs::symlink_status(report_ / name, code))) continue;
    fs::rename(report_ / name, aside_ / kPrevious / name, code);
    if (code) return Error{"cannot be replaced: " + code.message(), (report_ / name).string()};
  }
  return std::nullopt;
}

void StagedImages::keep() {
  kept_ = true;
  for (const auto& file : files_) file->keep();
  std::error_code ignored;
  bool removed = false;
  for (const std::string& name : earlier_)
    if (!placed_.contains(name)) removed |= fs::remove(target_ / name, ignored);
  if (removed) fs::remove(target_, ignored);  // if nothing is left in it
}

StagedImages::~StagedImages() {
  files_.clear();  // what was not kept goes back, so before the folder that holds it is removed
  std::error_code ignored;
  if (madeTarget_ && !kept_) fs::remove(target_, ignored);
  if (!kept_)
    for (const char* name : kReportFiles) fs::rename(aside_ / kPrevious / name, report_ / name, ignored);
  fs::remove_all(aside_, ignored);
}

}  // namespace rigel::tools
