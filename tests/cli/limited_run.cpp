#include "cli/limited_run.h"

#include "cli/run_program.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

namespace rigel::test {

LimitedOutcome runLimited(const std::vector<std::string>& arguments, double seconds) {
  using Clock = std::chrono::steady_clock;
  const TemporaryFolder folder;
  const std::string err = folder / "err";
  const auto start = Clock::now();
  const pid_t id = startProgram(arguments, "/dev/null", err);

  const auto since = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  int status = 0;
  rusage usage{};
  while (::wait4(id, &status, WNOHANG, &usage) == 0) {
    if (since() > seconds) ::kill(id, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(err), static_cast<double>(usage.ru_maxrss) / 1024,
          since()};
}

}  // namespace rigel::test
