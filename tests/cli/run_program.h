// Runs the rigel program as a user's shell does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rigel::test {

struct Outcome {
  int exitCode = -1;  // -1: ended by a signal
  std::string out, err;
};

/// Arguments are passed as they are (no shell); `input` is standard input.
Outcome runProgram(const std::vector<std::string>& arguments, const std::string& input = "");

/// A fresh folder, removed with all it holds at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void writeFile(const std::filesystem::path& file, const std::string& content);

}  // namespace rigel::test
