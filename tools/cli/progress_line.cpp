#include "cli/progress_line.h"

#include <fmt/format.h>

#include <unistd.h>
#include <cstdio>

namespace rigel::tools {

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::operator()(double share, const std::string& what) {
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (quiet_ || elapsed < 1) return;
  const int percent = static_cast<int>(100 * share);
  if (terminal_) {
    if (now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    fmt::print(stderr, "\r\033[K{:3d} %  {:4.0f} s  {}", percent, elapsed, what);
    std::fflush(stderr);
  } else {
    if (percent / 10 == tenth_) return;
    tenth_ = percent / 10;
    fmt::print(stderr, "{:3d} %  {:4.0f} s  {}\n", percent, elapsed, what);
  }
  shown_ = true;
}

}  // namespace rigel::tools
