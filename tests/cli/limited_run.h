// The program under limits, and what it took: for files that may ask for any amount of memory or time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rigel::test {

struct LimitedOutcome {
  int exitCode = -1;  // -1: ended by a signal, the time limit's SIGKILL included
  std::string err;
  double peakMebibytes = 0;  // resident
  double seconds = 0;
};

/// Arguments are passed as they are; the program is killed after `seconds`.
LimitedOutcome runLimited(const std::vector<std::string>& arguments, double seconds);

}  // namespace rigel::test
