#include "cli/limited_run.h"

#include "support/temporary_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace rigel::test {

LimitedOutcome runLimited(const std::vector<std::string>& arguments, double seconds) {
  using Clock = std::chrono::steady_clock;
  const TemporaryFolder folder;
  const std::string err = folder / "err";
  std::vector<std::string> words{RIGEL_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t id = -1;
  const auto start = Clock::now();
  const int failed = posix_spawn(&id, RIGEL_PROGRAM, &files, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) throw std::runtime_error("cannot start " RIGEL_PROGRAM);

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
