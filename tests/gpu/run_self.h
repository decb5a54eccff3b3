// A test in a process of its own, for what must happen before, or may not happen to, the process of the other tests.
#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace rigel::test {

inline bool isChild() { return std::getenv("RIGEL_TEST_CHILD") != nullptr; }

struct ChildOutcome {
  int exitCode = -1;
  std::string output;
};

/// Runs the current test again in another process, where isChild(), with `environment` ("A=b C=d") on top of this
/// one's.
inline ChildOutcome runSelf(const std::string& environment = "") {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string command = "env RIGEL_TEST_CHILD=1 " + environment + " '" +
                              std::filesystem::read_symlink("/proc/self/exe").string() +
                              "' --gtest_filter=" + test->test_suite_name() + "." + test->name() + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  ChildOutcome outcome;
  char text[4096];
  while (const std::size_t n = std::fread(text, 1, sizeof(text), pipe)) outcome.output.append(text, n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
  return outcome;
}

}  // namespace rigel::test
