// The figures of one rig that summaries list and comparisons judge, read from report.json's own fields.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <span>
#include <string>

namespace rigel::tools {

struct RigFigure {
  enum class Kind { error, time, size };

  const char* name;     // "total_rms", in CSV files
  const char* title;    // "total RMS %", in tables
  const char* pointer;  // of the number within a rig of report.json
  Kind kind;
  double scale;  // from the number to what tables show
  int decimals;  // there
  double least;  // values below it are as good as it: what no picture shows, or no clock tells
};

std::span<const RigFigure> rigFigures();

/// Empty where the report has none (max_jump of frames that do not follow on each other).
std::optional<double> valueOf(const RigFigure& figure, const nlohmann::ordered_json& rig);

/// As tables show it; "-" for none.
std::string shown(const RigFigure& figure, const std::optional<double>& value);

}  // namespace rigel::tools
