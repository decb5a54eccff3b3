// A progress line on stderr for work over a second: rewritten in place on a terminal, a line every ten per cent
// elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace rigel::tools {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet = false);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `share` in [0, 1].
  void operator()(double share, const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  int tenth_ = -1;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace rigel::tools
