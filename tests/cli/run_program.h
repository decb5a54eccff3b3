// Runs the rigel program as a user's shell does.
#pragma once

#include "support/temporary_folder.h"

#include <sys/types.h>

#include <string>
#include <vector>

namespace rigel::test {

struct Outcome {
  int exitCode = -1;  // -1: ended by a signal
  std::string out, err;
};

/// Arguments are passed as they are (no shell); `input` is standard input.
Outcome runProgram(const std::vector<std::string>& arguments, const std::string& input = "");

/// The program in the background, its output into two files; the caller waits for it.
pid_t startProgram(const std::vector<std::string>& arguments, const std::string& out, const std::string& err);

/// The same for signals. The destructor kills it.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  pid_t id() const { return id_; }
  void signal(int number) const;
  /// Waits for the end. Exit code -1: ended by a signal.
  Outcome wait();

 private:
  TemporaryFolder output_;
  pid_t id_ = -1;
};

}  // namespace rigel::test
