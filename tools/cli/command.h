// What every subcommand is: options on a CLI11 sub-application and a function to run when it was chosen.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace rigel::tools {

inline constexpr int kExitOk = 0;
inline constexpr int kExitBadInput = 1;       // a file, scene or measurement that cannot be used
inline constexpr int kExitBadUse = 2;         // a command line that makes no sense
inline constexpr int kExitInterrupted = 130;  // Ctrl-C, by the custom of shells

struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;  // returns the exit code; prints one line "rigel: ..." on stderr where it is not 0
};

Command addReport(CLI::App& root);
Command addPareto(CLI::App& root);
Command addRender(CLI::App& root);
Command addProbe(CLI::App& root);
Command addSample(CLI::App& root);
Command addInfo(CLI::App& root);
Command addTables(CLI::App& root);
Command addBench(CLI::App& root);

/// Prints "rigel: message" on stderr and returns `code`.
int fail(int code, const std::string& message);

}  // namespace rigel::tools
