// A file that takes its place beside others, or not at all.
#pragma once

#include <rigel/result.h>

#include <filesystem>
#include <optional>
#include <string_view>

namespace rigel::tools {

/// A file written aside that takes its name on commit(). Whatever had the name before is kept until keep(); without it
/// the destructor puts everything back. Aside and previous are on the target's file system.
class StagedFile {
 public:
  /// Aside and previous beside the target: ".NAME.PID.new" and ".NAME.PID.old".
  explicit StagedFile(std::filesystem::path target);
  StagedFile(std::filesystem::path target, std::filesystem::path aside, std::filesystem::path previous);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  std::optional<Error> write(std::string_view content);
  std::optional<Error> commit();
  void keep() { kept_ = true; }

 private:
  Error failure(std::string_view what) const;

  std::filesystem::path target_, aside_, previous_;
  bool replaced_ = false, committed_ = false, kept_ = false;
};

}  // namespace rigel::tools
