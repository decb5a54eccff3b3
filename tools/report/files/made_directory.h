// A directory to write into, tried before the work whose result goes there.
#pragma once

#include <rigel/result.h>

#include <filesystem>
#include <utility>
#include <vector>

namespace rigel::tools {

/// Makes a directory, with its parents, where it does not exist. The destructor removes what was made and is empty by
/// then, so that work that came to nothing leaves nothing.
class MadeDirectory {
 public:
  /// The Error says why no file could be written there.
  static Result<MadeDirectory> make(const std::filesystem::path& directory);

  MadeDirectory(MadeDirectory&& other) noexcept : made_(std::exchange(other.made_, {})) {}
  MadeDirectory& operator=(MadeDirectory&&) = delete;
  ~MadeDirectory();

 private:
  MadeDirectory() = default;

  std::vector<std::filesystem::path> made_;  // outermost first
};

}  // namespace rigel::tools
