// The pictures of a report while it is being made: aside, so that a failure leaves an older report as it was.
#pragma once

#include <rigel/result.h>

#include <filesystem>
#include <optional>

namespace rigel::tools {

/// Name of the folder of pictures within a report's directory.
inline constexpr const char* kImageFolder = "images";

/// Owns a temporary folder in the report's directory. Without commit() the destructor removes it, and the report's
/// directory too if that did not exist before and is empty.
class StagedImages {
 public:
  explicit StagedImages(std::filesystem::path report);
  ~StagedImages();
  StagedImages(const StagedImages&) = delete;
  StagedImages& operator=(const StagedImages&) = delete;

  /// Where pictures are to be written now; made by who writes the first.
  const std::filesystem::path& directory() const { return aside_; }

  /// Puts the folder (if there is one) in the place of an earlier report's.
  std::optional<Error> commit();

 private:
  std::filesystem::path report_, aside_;
  bool madeReport_ = false;
};

}  // namespace rigel::tools
