// Files that make sense together: all of them appear, or none.
#pragma once

#include <rigel/result.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace rigel::tools {

struct FileContent {
  std::string name;
  std::string content;
};

/// What would keep writeTogether from putting files of these names into `directory`, as far as one can see without
/// writing them.
std::optional<Error> obstacleTo(std::span<const char* const> names, const std::filesystem::path& directory);

/// Writes the files into `directory` (made where it does not exist): aside first, renamed once all are complete. After
/// an Error the directory holds what it held before.
std::optional<Error> writeTogether(std::span<const FileContent> files, const std::filesystem::path& directory);

}  // namespace rigel::tools
