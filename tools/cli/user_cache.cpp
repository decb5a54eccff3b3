#include "cli/user_cache.h"

#include <cstdlib>

namespace rigel::tools {
namespace {

std::filesystem::path environmentPath(const char* name) {
  const char* value = std::getenv(name);
  const std::filesystem::path path = value != nullptr ? value : "";
  return path.is_absolute() ? path : "";  // as the specification has it, others are ignored
}

}  // namespace

std::filesystem::path userCacheFile(const std::string& name) {
  std::filesystem::path folder = environmentPath("XDG_CACHE_HOME");
  if (folder.empty()) {
    const std::filesystem::path home = environmentPath("HOME");
    if (home.empty()) return {};
    folder = home / ".cache";
  }
  folder /= "rigel";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error)) return {};
  return folder / name;
}

}  // namespace rigel::tools
