// The benchmark figures, measured with Google Benchmark in one process.
#pragma once

#include <rigel/result.h>

#include <optional>
#include <string>
#include <vector>

namespace rigel::tools {

struct Figure {
  std::string name;                          // project.sphere.n64
  double value = 0;                          // least CPU time of the repetitions
  std::string unit;                          // "ns/light/point", "us/character", "ns/point"
  std::string baseline;                      // what it is compared with, or ""
  double ratio = 0;                          // baseline time / own time: above 1 is faster
  double median = 0;                         // as value, of the repetitions' median times; 0: none was taken
  std::optional<double> limitFraction = {};  // of the multiply-adds that the machine does at best, from minima
  // Of GPU figures (gpu_costs.h).
  std::optional<int> instructions = {};     // of the specialised shader
  std::optional<double> spatialError = {};  // RMS over the mean light
  std::optional<double> totalError = {};
};

/// All figures whose name matches the regular expression `filter`. Baselines that they need are run whatever the
/// filter. Error: the filter is no regular expression, or matches nothing.
Result<std::vector<Figure>> measureFigures(const std::string& filter, int repetitions);

}  // namespace rigel::tools
