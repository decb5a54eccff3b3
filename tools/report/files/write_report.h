// Puts the finished report into its directory, all of it or nothing.
#pragma once

#include "report/report_data.h"

#include <rigel/result.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace rigel::tools {

struct WrittenReport {
  std::filesystem::path html;
  std::filesystem::path json;
  std::uintmax_t htmlBytes = 0;
};

/// What would keep writeReport from putting its files into `directory`, as far as one can see without writing them.
std::optional<Error> reportObstacle(const std::filesystem::path& directory);

/// Writes the report's files (kReportFiles) into `directory` (made where it does not exist): aside first, renamed once
/// all are complete. After an Error the directory holds what it held before. Pictures are the business of StagedImages.
Result<WrittenReport> writeReport(const Report& report, const std::filesystem::path& directory);

}  // namespace rigel::tools
