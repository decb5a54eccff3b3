// The directory of --out: what is the user's stays, what is ours is whole, and nothing is left behind.
#include "cli/run_program.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <thread>

namespace rigel::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using Names = std::set<std::string>;

Names namesIn(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// Names of all picture files that report.json lists; each must be listed once.
Names listedPictures(const fs::path& out) {
  Names names;
  const auto document = nlohmann::json::parse(std::ifstream(out / "report.json"));
  for (const auto& object : document["objects"])
    for (const auto& picture : object["pictures"])
      for (const char* key : {"image_png", "image_exr", "error_png", "error_exr"})
        if (picture.contains(key)) {
          const std::string path = picture[key];
          EXPECT_EQ(path.rfind("images/", 0), 0u) << path;
          EXPECT_TRUE(names.insert(path.substr(7)).second) << path << " is listed twice";
        }
  return names;
}

class OutputDirectory : public ::testing::Test {
 protected:
  Outcome report(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"report", "--quiet", "--out", out_});
    return runProgram(arguments);
  }
  void expectReport(const std::vector<std::string>& arguments) const {
    const Outcome outcome = report(arguments);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  /// A report on `folder_/NAME`, refused before anything was measured and without a trace.
  void expectRefused(const std::string& out, const std::string& cause) const {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = runProgram({"report", "sample:street", "--out", out, "--quiet"});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(outcome.exitCode, 1) << out;
    EXPECT_THAT(outcome.err, HasSubstr(out)) << "names the place";
    EXPECT_THAT(outcome.err, HasSubstr(cause));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_LT(seconds.count(), 1) << "measuring this scene takes longer";
  }

  TemporaryFolder folder_;
  const std::string out_ = folder_ / "out";
};

const std::vector<std::string> kQuick{"sample:figure1", "--rig", "constant;poly:4"};
const std::vector<std::string> kQuickOther{"sample:figure1", "--rig", "constant;gradient"};

TEST_F(OutputDirectory, HoldsWhatTheReportNamesAndWhatTheUserPutThere) {
  fs::create_directories(out_ + "/images/holiday");
  writeFile(out_ + "/images/me.png", "mine");
  writeFile(out_ + "/images/holiday/beach.png", "mine");
  const Names mine{"me.png", "holiday"};

  Names earlier;
  for (const auto& arguments : {kQuick, kQuickOther, kQuick}) {
    expectReport(arguments);
    Names expected = listedPictures(out_);
    EXPECT_THAT(expected, ::testing::Not(IsEmpty()));
    EXPECT_NE(expected, earlier);
    earlier = expected;
    expected.insert(mine.begin(), mine.end());
    EXPECT_EQ(namesIn(out_ + "/images"), expected);
    EXPECT_EQ(namesIn(out_), (Names{"images", "report.csv", "report.html", "report.json", "report.md"}));
  }
  std::vector<std::string> withoutPictures = kQuick;
  withoutPictures.push_back("--no-images");
  expectReport(withoutPictures);
  EXPECT_EQ(namesIn(out_ + "/images"), mine);
  EXPECT_TRUE(fs::exists(out_ + "/images/holiday/beach.png"));
}

TEST_F(OutputDirectory, PicturesGoBackWhenTheReportCannotBeWritten) {
  expectReport(kQuick);
  const Names before = namesIn(out_ + "/images");
  const auto written = fs::last_write_time(out_ + "/images/" + *before.begin());
  // Found only once it is tried: the document's old state cannot be kept. Root may write anywhere, so a name does it:
  // a directory that is not empty stands where the page is written aside. Its name holds the process id, which exec
  // keeps.
  const std::string script = "d=" + out_ +
                             "; mkdir -p $d/.report.html.$$.new/x; exec " RIGEL_PROGRAM
                             " report sample:figure1 --rig 'constant;gradient' --quiet --out $d 2>" +
                             (folder_ / "err").string();
  const int status = std::system(script.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(namesIn(out_ + "/images"), before);
  EXPECT_EQ(listedPictures(out_), before);
  EXPECT_EQ(fs::last_write_time(out_ + "/images/" + *before.begin()), written);
}

TEST_F(OutputDirectory, EveryPictureHasAFileOfItsOwn) {
  // Names that are alike once made safe, and one longer than a file name may be.
  const std::string name(300, 'n');
  nlohmann::json scene = {
      {"asset", {{"version", "2.0"}}},
      {"extensionsUsed", {"KHR_lights_punctual"}},
      {"scene", 0},
      {"extensions", {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}, {"intensity", 5}}}}}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {1, 0, 1}}},
        {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}, {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 6}}}},
      {"buffers",
       {{{"byteLength", 42},
         {"uri", "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAABAAIA"}}}}};
  const std::vector<std::string> names{"a/b", "a_b", name, name + "2"};
  for (const std::string& object : names) scene["nodes"].push_back({{"name", object}, {"mesh", 0}});
  scene["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 2, 0}}});
  scene["scenes"] = {{{"nodes", {0, 1, 2, 3, 4}}}};
  writeFile(folder_.path() / "tiny.gltf", scene.dump());

  expectReport({folder_ / "tiny.gltf", folder_ / "tiny.gltf", "--rig", "constant"});
  const Names listed = listedPictures(out_);  // fails where two pictures share a file
  // Two scenes, four objects, one frame: the truth, a rig and its error, as .png and .exr.
  EXPECT_EQ(listed.size(), 2u * 4 * 3 * 2);
  EXPECT_EQ(namesIn(out_ + "/images"), listed);
  EXPECT_THAT(listed,
              IsSupersetOf({"s1-tiny-o01-a_b-frame0000-truth.png", "s2-tiny-o02-a_b-frame0000-constant-error.exr"}));
}

TEST_F(OutputDirectory, IsTriedBeforeAnythingIsMeasured) {
  writeFile(folder_.path() / "file", "kept");
  expectRefused(folder_ / "file", "not a directory");
  expectRefused(folder_ / "file/below", "cannot be made");
  expectRefused("/proc/rigel/out", "cannot be made");
  expectRefused("/proc", "no file can be written");
  fs::create_directories(folder_ / "page/report.html");
  expectRefused(folder_ / "page", "report.html: is a directory");
  fs::create_directory(folder_ / "pictures");
  writeFile(folder_.path() / "pictures/images", "mine");
  expectRefused(folder_ / "pictures", "images: is not a directory");
  EXPECT_EQ(namesIn(folder_.path()), (Names{"file", "page", "pictures"}));
  EXPECT_EQ(namesIn(folder_ / "page"), Names{"report.html"});
  EXPECT_EQ(namesIn(folder_ / "pictures"), Names{"images"});
  if (::geteuid() != 0) {  // nothing is read-only to root
    fs::create_directory(folder_ / "locked");
    fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    expectRefused(folder_ / "locked", "no file can be written");
    expectRefused(folder_ / "locked/below", "cannot be made");
  }
}

/// Starts a long report and waits until it is at work.
std::unique_ptr<RunningProgram> longReport(const std::string& out) {
  auto program = std::make_unique<RunningProgram>(std::vector<std::string>{
      "report", "sample:street", "sample:stage", "sample:dragon", "--no-images", "--quiet", "--out", out});
  const fs::path aside = fs::path(out) / (".images." + std::to_string(program->id()));
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!fs::exists(aside)) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("the program made no " + aside.string());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return program;
}

TEST_F(OutputDirectory, IsCleanAfterAnInterrupt) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto program = longReport(folder_ / "new/out");
    program->signal(signal);
    const Outcome outcome = program->wait();
    EXPECT_EQ(outcome.exitCode, 130);
    EXPECT_EQ(outcome.err, "rigel: interrupted\n");
    EXPECT_THAT(namesIn(folder_.path()), IsEmpty()) << "directories that were made for nothing";
  }
  expectReport(kQuick);
  const Names before = namesIn(out_ + "/images");
  const auto program = longReport(out_);
  program->signal(SIGINT);
  EXPECT_EQ(program->wait().exitCode, 130);
  EXPECT_EQ(namesIn(out_), (Names{"images", "report.csv", "report.html", "report.json", "report.md"}));
  EXPECT_EQ(namesIn(out_ + "/images"), before);
}

TEST_F(OutputDirectory, LosesWhatAKilledProgramLeft) {
  const auto program = longReport(out_);
  program->signal(SIGKILL);
  EXPECT_EQ(program->wait().exitCode, -1);
  EXPECT_EQ(namesIn(out_).size(), 1u) << "nothing can be done about this signal";
  expectReport(kQuick);
  EXPECT_EQ(namesIn(out_), (Names{"images", "report.csv", "report.html", "report.json", "report.md"}));
}

/// The rigs of the report in `out` and the bytes of its pictures; nothing where there is no report.json.
std::map<std::string, std::string> heldReport(const fs::path& out) {
  const auto bytes = [](const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  };
  std::map<std::string, std::string> held;
  if (!fs::exists(out / "report.json")) return held;
  const std::string command = nlohmann::json::parse(bytes(out / "report.json"))["command"];
  held["rigs"] = command.substr(command.find("--rig"), 25);
  if (fs::exists(out / "report.html")) {
    EXPECT_THAT(bytes(out / "report.html"), HasSubstr(nlohmann::json(command).dump())) << "a page of another report";
  }
  for (const std::string& name : listedPictures(out)) held[name] = bytes(out / "images" / name);
  return held;
}

TEST_F(OutputDirectory, HoldsOneReportWheneverTheProgramIsKilled) {
  expectReport(kQuick);
  const auto start = std::chrono::steady_clock::now();
  expectReport(kQuick);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  auto before = heldReport(out_);
  std::vector<std::string> arguments{"report", "--quiet", "--out", out_};
  arguments.insert(arguments.end(), kQuickOther.begin(), kQuickOther.end());
  std::mt19937 random(1);
  const int times = std::getenv("RIGEL_FULL") ? 200 : 6;
  for (int i = 0; i < times; ++i) {
    RunningProgram program(arguments);
    std::this_thread::sleep_for(whole * std::uniform_real_distribution(0.0, 1.1)(random));
    program.signal(SIGKILL);
    program.wait();
    const auto after = heldReport(out_);
    if (after.empty()) continue;  // withdrawn while its place was being taken
    if (after.at("rigs") == before.at("rigs")) {
      EXPECT_EQ(after, before) << "the report as it was";
    }
    for (const auto& [name, content] : after) EXPECT_FALSE(content.empty()) << name << " is not whole";
    before = after;
  }
  expectReport(kQuickOther);
  EXPECT_EQ(namesIn(out_), (Names{"images", "report.csv", "report.html", "report.json", "report.md"}));
  EXPECT_EQ(namesIn(out_ + "/images"), listedPictures(out_));
}

}  // namespace
}  // namespace rigel::test
