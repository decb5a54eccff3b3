#include "cli/run_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace rigel::test {
namespace {

std::string quoted(const std::string& argument) {
  std::string out = "'";
  for (char c : argument) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

Outcome runProgram(const std::vector<std::string>& arguments, const std::string& input) {
  const TemporaryFolder folder;
  writeFile(folder.path() / "in", input);
  std::string command = quoted(RIGEL_PROGRAM);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += fmt::format(" <{} >{} 2>{}", quoted(folder / "in"), quoted(folder / "out"), quoted(folder / "err"));
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder / "out"), contentOf(folder / "err")};
  if (outcome.exitCode > 128) outcome.exitCode = -1;  // how a shell tells of a signal
  return outcome;
}

pid_t startProgram(const std::vector<std::string>& arguments, const std::string& out, const std::string& err) {
  std::vector<std::string> words{RIGEL_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const auto& [descriptor, file] : {std::pair{1, out}, {2, err}})
    posix_spawn_file_actions_addopen(&files, descriptor, file.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t id = -1;
  const int failed = posix_spawn(&id, RIGEL_PROGRAM, &files, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) throw std::runtime_error("cannot start " RIGEL_PROGRAM);
  return id;
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments)
    : id_(startProgram(arguments, output_ / "out", output_ / "err")) {}

RunningProgram::~RunningProgram() {
  if (id_ < 0) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

void RunningProgram::signal(int number) const { ::kill(id_, number); }

Outcome RunningProgram::wait() {
  int status = 0;
  ::waitpid(std::exchange(id_, -1), &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(output_ / "out"), contentOf(output_ / "err")};
}

}  // namespace rigel::test
