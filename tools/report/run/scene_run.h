// Runs scenes through the measurement: the work behind `rigel report`.
#pragma once

#include "report/report_data.h"
#include "report/run/run_options.h"

#include <rigel/result.h>

#include <filesystem>

namespace rigel::tools {

/// Loads, measures and (with options.images) pictures every scene and clip. Pictures go to `imageDirectory`, which is
/// made when the first is written. Version and command line of the result are left for the caller.
Result<Report> runReport(const RunOptions& options, const std::filesystem::path& imageDirectory,
                         const Progress& progress);

}  // namespace rigel::tools
