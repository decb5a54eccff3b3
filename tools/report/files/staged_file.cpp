#include "report/files/staged_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace rigel::tools {

namespace fs = std::filesystem;

namespace {

fs::path beside(const fs::path& target, std::string_view kind) {
  return target.parent_path() / fmt::format(".{}.{}.{}", target.filename().string(), ::getpid(), kind);
}

}  // namespace

StagedFile::StagedFile(fs::path target) : StagedFile(target, beside(target, "new"), beside(target, "old")) {}

StagedFile::StagedFile(fs::path target, fs::path aside, fs::path previous)
    : target_(std::move(target)), aside_(std::move(aside)), previous_(std::move(previous)) {}

StagedFile::~StagedFile() {
  std::error_code ignored;
  fs::remove(aside_, ignored);
  if (!committed_ || kept_)
    fs::remove(previous_, ignored);
  else if (replaced_)
    fs::rename(previous_, target_, ignored);
  else
    fs::remove(target_, ignored);
}

std::optional<Error> StagedFile::write(std::string_view content) {
  std::FILE* file = std::fopen(aside_.c_str(), "wb");
  if (!file) return failure("cannot be written");
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int writeError = errno;
  const bool closed = std::fclose(file) == 0;  // a full disk may show only here
  if (written && closed) return std::nullopt;
  if (!written) errno = writeError;
  return failure("cannot be written");
}

std::optional<Error> StagedFile::commit() {
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

Error StagedFile::failure(std::string_view what) const {
  return Error{fmt::format("{}: {}", what, std::strerror(errno)), target_.string()};
}

}  // namespace rigel::tools
