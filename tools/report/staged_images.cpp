#include "report/staged_images.h"

#include <unistd.h>

#include <string>
#include <system_error>

namespace rigel::tools {

namespace fs = std::filesystem;

StagedImages::StagedImages(fs::path report)
    : report_(std::move(report)), aside_(report_ / ("." + std::string(kImageFolder) + "." + std::to_string(getpid()))) {
  std::error_code ignored;
  madeReport_ = !fs::exists(report_, ignored);
}

StagedImages::~StagedImages() {
  std::error_code ignored;
  fs::remove_all(aside_, ignored);
  if (madeReport_) fs::remove(report_, ignored);  // removes empty directories only
}

std::optional<Error> StagedImages::commit() {
  const fs::path target = report_ / kImageFolder;
  std::error_code code;
  fs::remove_all(target, code);
  if (!code && fs::exists(aside_)) fs::rename(aside_, target, code);
  if (code) return Error{"the pictures cannot be put in place: " + code.message(), target.string()};
  return std::nullopt;
}

}  // namespace rigel::tools
