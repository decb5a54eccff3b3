#include "report/files/made_directory.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <ranges>
#include <string>
#include <system_error>

namespace rigel::tools {

namespace fs = std::filesystem;

namespace {

/// What writing a file says: permissions alone do not tell of read-only or full file systems. Killed between two calls
/// it leaves a name that putInOrder knows.
std::error_code tryToWrite(const fs::path& directory) {
  const std::string file = (directory / (".rigel." + std::to_string(::getpid()) + ".new")).string();
  ::unlink(file.c_str());  // of a dead process that had our number
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return {errno, std::generic_category()};
  ::unlink(file.c_str());
  std::error_code code;
  if (::write(descriptor, "x", 1) != 1) code = {errno, std::generic_category()};
  if (::close(descriptor) != 0 && !code) code = {errno, std::generic_category()};
  return code;
}

}  // namespace

Result<MadeDirectory> MadeDirectory::make(const fs::path& directory) {
  std::error_code code;
  std::vector<fs::path> missing;  // innermost first
  for (fs::path path = directory; !path.empty() && !fs::exists(path, code); path = path.parent_path())
    missing.push_back(path);

  MadeDirectory result;
  for (const fs::path& path : missing | std::views::reverse) {
    if (fs::create_directory(path, code)) result.made_.push_back(path);
    if (code) return Error{"the directory cannot be made: " + code.message(), directory.string()};
  }
  if (!fs::is_directory(directory, code)) return Error{"is not a directory", directory.string()};
  if (const std::error_code failure = tryToWrite(directory))
    return Error{"no file can be written in this directory: " + failure.message(), directory.string()};
  return result;
}

MadeDirectory::~MadeDirectory() {
  std::error_code ignored;
  for (const fs::path& path : made_ | std::views::reverse) fs::remove(path, ignored);  // empty ones only
}

}  // namespace rigel::tools
