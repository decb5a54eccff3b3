// rigel pareto as a user runs it: bad use, bad input, what it prints and leaves.
#include "cli/run_program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <signal.h>
#include <chrono>
#include <thread>

namespace rigel::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

Outcome pareto(const std::filesystem::path& out, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "pareto");
  arguments.insert(arguments.end(), {"--device", "none", "--out", out.string()});
  return runProgram(arguments);
}

const std::vector<std::string> kFewRigs{"sample:figure1", "--rig", "constant;gradient;auto", "--bands", "3"};

TEST(ParetoCommand, PrintsTheFrontAndWritesItsFiles) {
  const TemporaryFolder folder;
  const Outcome outcome = pareto(folder / "out", kFewRigs);
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  // Which rigs are on the front is a matter of times.
  EXPECT_THAT(outcome.out, ContainsRegex("\n--rig [^\n]* --bands 3 "));
  EXPECT_THAT(outcome.out, HasSubstr("auto is"));
  EXPECT_THAT(outcome.out, HasSubstr("GPU times are left out: --device none"));
  for (const char* name : {"pareto.html", "pareto.json", "pareto.csv", "pareto.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
}

TEST(ParetoCommand, PrintsJson) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = kFewRigs;
  arguments.insert(arguments.end(), {"--json", "--wrap", "0.3"});
  const Outcome outcome = pareto(folder / "out", arguments);
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const auto document = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(document["scene"], "sample:figure1");
  EXPECT_THAT(document["command"].get<std::string>(),
              StartsWith("rigel pareto sample:figure1 --rig \"constant;gradient;auto\" --wrap 0.3 --bands 3"));
  EXPECT_GT(document["objects"][0]["points"].size(), 20u);
  const auto written = nlohmann::json::parse(contentOf(folder / "out" / "pareto.json"), nullptr, false);
  EXPECT_EQ(written, document);
}

TEST(ParetoCommand, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& word) {
    const Outcome outcome = pareto(folder / "out", std::move(arguments));
    EXPECT_EQ(outcome.exitCode, 2) << word;
    EXPECT_THAT(outcome.err, HasSubstr(word));
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << word;
  };
  refused({}, "SCENE");
  refused({"sample:figure1", "--bands", "6"}, "bands");
  refused({"sample:figure1", "--rig", "poly:0"}, "poly:0");
  refused({"sample:figure1", "--frames", "9:3"}, "--frames");
  refused({"sample:figure1", "--near", "2"}, "--near");  // every number of near lights is measured
  refused({"sample:figure1", "--wrap", "7"}, "wrap");
  EXPECT_EQ(runProgram({"pareto", "sample:figure1"}).exitCode, 2) << "without --out";
}

TEST(ParetoCommand, LeavesNothingWhereInputCannotBeUsed) {
  const TemporaryFolder folder;
  const Outcome outcome = pareto(folder / "out", {"sample:no-such-scene"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.err, StartsWith("rigel: "));
  EXPECT_THAT(outcome.err, HasSubstr("no-such-scene"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));

  const Outcome clips = pareto(folder / "out", {"sample:street", "--clip", "no-such-clip"});
  EXPECT_EQ(clips.exitCode, 1);
  EXPECT_THAT(clips.err, HasSubstr("no-such-clip"));
}

TEST(ParetoCommand, LeavesTheOldFilesWhereItIsStopped) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  writeFile(folder / "out" / "pareto.json", "old");
  for (const int number : {SIGINT, SIGKILL}) {
    RunningProgram program(
        {"pareto", "sample:street", "--bands", "3", "--device", "none", "--out", (folder / "out").string()});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    program.signal(number);
    EXPECT_EQ(program.wait().exitCode, number == SIGINT ? 130 : -1);
    EXPECT_EQ(contentOf(folder / "out" / "pareto.json"), "old");
    EXPECT_FALSE(std::filesystem::exists(folder / "out" / "pareto.html"));
  }
}

}  // namespace
}  // namespace rigel::test
