#include "report/files/write_together.h"

#include "report/files/staged_file.h"

#include <memory>
#include <system_error>
#include <vector>

namespace rigel::tools {

namespace fs = std::filesystem;

std::optional<Error> obstacleTo(std::span<const char* const> names, const fs::path& directory) {
  std::error_code ignored;
  for (const char* name : names)
    if (fs::is_directory(directory / name, ignored))
      return Error{"is a directory, so the report cannot be written", (directory / name).string()};
  return std::nullopt;
}

std::optional<Error> writeTogether(std::span<const FileContent> files, const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) return Error{"cannot be made: " + error.message(), directory.string()};
  std::vector<std::unique_ptr<StagedFile>> staged;
  for (const FileContent& file : files) staged.push_back(std::make_unique<StagedFile>(directory / file.name));
  for (std::size_t i = 0; i < files.size(); ++i)
    if (auto failed = staged[i]->write(files[i].content)) return failed;
  for (const auto& file : staged)
    if (auto failed = file->commit()) return failed;
  for (const auto& file : staged) file->keep();
  return std::nullopt;
}

}  // namespace rigel::tools
