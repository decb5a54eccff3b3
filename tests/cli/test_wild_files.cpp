// Files from elsewhere, through the program itself: the glTF validator's test files, the one that aborts tinygltf, and
// those of Debian's assimp-testmodels where the package is installed. Where they are missing each test says so and
// passes.
#include "cli/limited_run.h"
#include "support/temporary_folder.h"
#include "support/validator_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace rigel::test {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 60;      // no file takes a second on a quiet machine
constexpr double kMebibytes = 2048;  // none takes a twentieth, sanitizers aside
const fs::path kAssimp = "/usr/share/assimp/models";

bool isThere(const fs::path& path) {
  if (fs::exists(path)) return true;
  std::printf("[ no data  ] %s is not there: nothing tested\n", path.c_str());
  return false;
}

std::vector<fs::path> filesBelow(const fs::path& root) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// What the programs took, and how they ended.
struct Tally {
  int described = 0, reported = 0, refused = 0;
  double peak = 0, longest = 0;

  void print(const char* what) const {
    std::printf("[ measured ] %s: %d described, %d of them reported on, %d refused; at most %.0f MiB and %.1f s\n",
                what, described, reported, refused, peak, longest);
  }
};

/// Ends within the limits, with exit code 0, or 1 and one line that begins with the file's name.
bool endsWell(const std::vector<std::string>& arguments, const fs::path& file, Tally& tally, std::string& line) {
  const LimitedOutcome outcome = runLimited(arguments, kSeconds);
  EXPECT_TRUE(outcome.exitCode == 0 || outcome.exitCode == 1) << outcome.exitCode << " " << outcome.err;
  EXPECT_LT(outcome.peakMebibytes, kMebibytes);
  EXPECT_LT(outcome.seconds, kSeconds);
  tally.peak = std::max(tally.peak, outcome.peakMebibytes);
  tally.longest = std::max(tally.longest, outcome.seconds);
  line = outcome.err;
  if (outcome.exitCode == 1) {
    EXPECT_EQ(std::ranges::count(line, '\n'), 1) << line;
    EXPECT_EQ(line.rfind("rigel: " + file.string() + ": ", 0), 0u) << line;
  }
  return outcome.exitCode == 0;
}

bool describes(const fs::path& file, Tally& tally, std::string& line) {
  const bool good = endsWell({"info", file}, file, tally, line);
  ++(good ? tally.described : tally.refused);
  return good;
}

/// A file that `info` describes must make a report too, but for the reasons that a scene itself may give.
void expectReport(const fs::path& file, Tally& tally) {
  const TemporaryFolder folder;
  std::string line;
  if (endsWell({"report", file, "--lights", "sample:street", "--rig", "constant", "--frames", "0:2", "--no-images",
                "--quiet", "--out", folder / "out"},
               file, tally, line)) {
    ++tally.reported;
    return;
  }
  EXPECT_NE(line.find("there is nothing to light"), std::string::npos) << line;
}

bool isFull() { return std::getenv("RIGEL_FULL") != nullptr && *std::getenv("RIGEL_FULL") != '\0'; }

TEST(WildFiles, TheValidatorsFiles) {
  const fs::path root = fs::path(RIGEL_SHARED_DATA) / "malformed";
  if (!isThere(root)) return;
  Tally tally;
  for (const fs::path& file : filesBelow(root)) {
    if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
    SCOPED_TRACE(file);
    std::string line;
    const bool good = describes(file, tally, line);
    if (const ValidatorReport report = validatorReport(file); report.found) {
      EXPECT_EQ(good, !report.concernsRigel() && !isBeyondRigel(file)) << line << report.codes();
    }
    if (good && isFull()) expectReport(file, tally);
  }
  EXPECT_GE(tally.described, 60);
  EXPECT_GE(tally.refused, 60);
  tally.print("validator");
}

// glTF 2.0 that the package itself calls broken, or that needs what Rigel does not read.
const std::set<std::string> kBrokenModels = {"BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf",
                                             "BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
                                             "IncorrectVertexArrays/Cube.gltf",
                                             "IndexOutOfRange/AllIndicesOutOfRange.gltf",
                                             "IndexOutOfRange/IndexOutOfRange.gltf",
                                             "MissingBin/BoxTextured.gltf",
                                             "RecursiveNodes/RecursiveNodes.gltf",
                                             "SchemaFailures/sceneWrongType.gltf",
                                             "TestNoRootNode/NoScene.gltf",
                                             "draco/2CylinderEngine.gltf",
                                             "wrongTypes/badArray.gltf",
                                             "wrongTypes/badObject.gltf"};

TEST(WildFiles, AssimpsModels) {
  if (!isFull() || !isThere(kAssimp)) return;
  Tally tally;
  for (const fs::path& file : filesBelow(kAssimp)) {
    SCOPED_TRACE(file);
    std::string line;
    const bool good = describes(file, tally, line);
    const bool gltf = file.extension() == ".gltf" || file.extension() == ".glb";
    if (!gltf) {
      EXPECT_NE(line.find("is not glTF: "), std::string::npos) << line;
    } else if (file.string().starts_with((kAssimp / "glTF/").string())) {
      EXPECT_NE(line.find("is glTF 1"), std::string::npos) << line;
    } else {
      EXPECT_EQ(good, !kBrokenModels.contains(fs::relative(file, kAssimp / "glTF2").string())) << line;
    }
    if (good) expectReport(file, tally);
  }
  EXPECT_GE(tally.described, 30);
  EXPECT_GE(tally.reported, 20);
  tally.print("assimp-testmodels");
}

}  // namespace
}  // namespace rigel::test
