// What every subcommand has: help, version, exit codes.
#include "cli/run_program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace rigel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Program, TellsItsVersionAndHelp) {
  const Outcome version = runProgram({"--version"});
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_THAT(version.out, StartsWith("rigel 0."));
  for (const std::string command : {"", "report", "probe", "sample", "info", "tables", "bench"}) {
    std::vector<std::string> arguments;
    if (!command.empty()) arguments.push_back(command);
    arguments.push_back("--help");
    const Outcome help = runProgram(arguments);
    EXPECT_EQ(help.exitCode, 0) << command;
    EXPECT_THAT(help.out, HasSubstr("Usage:")) << command;
  }
}

TEST(Program, BadUseExitsWithTwo) {
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"repport"},
                                             {"report"},
                                             {"report", "sample:touch"},
                                             {"report", "sample:touch", "--out", ""},
                                             {"report", "sample:touch", "--out", "x", "--bands", "6"},
                                             {"report", "sample:touch", "--out", "x", "--wrap", "2"},
                                             {"report", "sample:touch", "--out", "x", "--exposure", "0"},
                                             {"report", "sample:touch", "--out", "x", "--nope"},
                                             {"sample", "nope", "--out", "x.glb"},
                                             {"bench", "--filter", "("},
                                             {"bench", "--filter", "matches nothing"}}) {
    const Outcome outcome = runProgram(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << ::testing::PrintToString(arguments) << outcome.err;
    EXPECT_FALSE(outcome.err.empty()) << ::testing::PrintToString(arguments);
  }
}

TEST(Program, ListsItsSamplesAndWritesThemAsGltf) {
  const TemporaryFolder folder;
  const Outcome list = runProgram({"sample", "--list"});
  EXPECT_EQ(list.exitCode, 0);
  for (const std::string name : {"street", "stage", "dragon", "touch", "figure1", "corridor", "gallery"}) {
    EXPECT_THAT(list.out, HasSubstr(name));
    const std::string file = folder / (name + ".glb");
    EXPECT_EQ(runProgram({"sample", name, "--out", file}).exitCode, 0) << name;
    const Outcome info = runProgram({"info", file, "--json"});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_FALSE(nlohmann::json::parse(info.out, nullptr, false).is_discarded()) << name;
  }
}

TEST(Program, ProbeAnswersEveryLine) {
  const Outcome outcome =
      runProgram({"probe"},
                 "{\"light\":{\"type\":\"sphere\",\"position\":[0,3,0],\"radius\":1,\"radiance\":[1,1,1]},"
                 "\"point\":[0,0,0],\"normal\":[0,1,0]}\n"
                 "not json\n"
                 "{\"light\":{\"type\":\"sphere\",\"position\":[0,3,0],\"radius\":-1,\"radiance\":[1,1,1]},"
                 "\"point\":[0,0,0],\"normal\":[0,1,0]}\n");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  std::vector<nlohmann::json> answers;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) answers.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(answers[0]["sh"].size(), 9u);
  EXPECT_EQ(answers[0]["gradient"].size(), 3u);
  // A sphere straight above: E = pi (r/d)^2.
  EXPECT_NEAR(answers[0]["irradiance_exact"][0].get<double>(), 3.14159265358979 / 9, 1e-12);
  EXPECT_TRUE(answers[1].contains("error"));
  EXPECT_TRUE(answers[2].contains("error"));
}

TEST(Program, BenchComparesWithinOneRun) {
  const Outcome outcome = runProgram({"bench", "--filter", "project.sphere.n8", "--repetitions", "1", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const auto figures = nlohmann::json::parse(outcome.out)["figures"];
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0]["name"], "project.sphere.n8");
  EXPECT_EQ(figures[0]["baseline"], "project.textbook.n8");
  EXPECT_GT(figures[0]["value"].get<double>(), 0);
  EXPECT_GT(figures[0]["ratio"].get<double>(), 0);
}

}  // namespace
}  // namespace rigel::test
