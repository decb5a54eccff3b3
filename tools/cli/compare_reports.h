// rigel report --compare: runs side by side, and whether the later ones are worse.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rigel::tools {

struct CompareArguments {
  std::vector<std::string> files;           // report.json of each run, the one to judge by first
  std::optional<double> maxError, maxTime;  // ratios
  std::string out;                          // directory for compare.html, .md, .csv and .json; "" for none
  bool json = false;
};

/// The exit code: 1 where a figure is worse than allowed, or a file cannot be used.
int compareReportFiles(const CompareArguments& arguments);

}  // namespace rigel::tools
