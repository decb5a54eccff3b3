// rigel tables: its files hold the table, its refusals leave nothing behind.
#include "cli/run_program.h"
#include "picture/image_io.h"

#include <rigel/disk_table.h>
#include <rigel/make_disk_table.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace rigel::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tools::Image;

float channel(const Image& image, std::size_t i, std::size_t c) {
  return c < 3 ? image.rgb[3 * i + c] : image.coverage[i];
}

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t filesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(TablesCommand, WritesTheEmbeddedTexelsInBothDepths) {
  const TemporaryFolder folder;
  const Outcome outcome = runProgram({"tables", "--out", folder / "new/tables", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const auto description = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(description["size"], kDiskTableSize);
  EXPECT_EQ(description["hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(std::stoull(description["hash"].get<std::string>(), nullptr, 16), DiskTable::provenance().hash);
  const fs::path out = folder / "new/tables";
  EXPECT_EQ(nlohmann::json::parse(textOf(out / "disk_tables.json")), description);
  ASSERT_EQ(description["files"].size(), 4u);
  EXPECT_EQ(filesIn(out), 5u);

  for (const auto& file : description["files"]) {
    const auto name = file["name"].get<std::string>();
    const auto image = tools::readExr(out / name);
    ASSERT_TRUE(image) << image.error().line();
    ASSERT_EQ(image->width, kDiskTableSize);
    ASSERT_EQ(image->height, kDiskTableSize);
    EXPECT_EQ(file["bytes"], fs::file_size(out / name));
    const auto texels = DiskTable::data(file["texture"].get<int>());
    const float relative = file["format"] == "half" ? 0x1p-11f : 0.0f;
    const float smallest = file["format"] == "half" ? 0x1p-25f : 0.0f;
    float rounding = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const float read = channel(*image, i / 4, i % 4);
      ASSERT_NEAR(read, texels[i], std::max(std::abs(texels[i]) * relative, smallest)) << name << ", " << i;
      rounding = std::max(rounding, std::abs(read - texels[i]));
    }
    EXPECT_EQ(rounding > 0, file["format"] == "half") << name << " is of another depth than it says";
  }
}

TEST(TablesCommand, WritesOtherSizes) {
  const TemporaryFolder folder;
  const Outcome outcome = runProgram({"tables", "--out", folder / "t", "--size", "8"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("8x8"));
  const auto image = tools::readExr(fs::path(folder / "t") / "disk_table_1_float.exr");
  ASSERT_TRUE(image) << image.error().line();
  const DiskTableTexels expected = makeDiskTable(8);
  ASSERT_EQ(4 * image->pixelCount(), expected.texels[1].size());
  for (std::size_t i = 0; i < expected.texels[1].size(); ++i)
    EXPECT_NEAR(channel(*image, i / 4, i % 4), expected.texels[1][i], 1e-8f) << i;
}

// What the library was compiled from is what the command writes. Its numbers may differ in the last digit on a machine
// that rounds another way (GivesTheEmbeddedTexels); here only the form is compared where they do.
TEST(TablesCommand, WritesTheEmbeddedSource) {
  const TemporaryFolder folder;
  const Outcome outcome = runProgram({"tables", "--embed", folder / "data.inc"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string written = textOf(folder / "data.inc"), embedded = textOf(RIGEL_EMBEDDED_TABLE);
  ASSERT_GT(embedded.size(), 10'000u);
  std::istringstream a(written), b(embedded);
  std::string lineA, lineB;
  int lines = 0, different = 0;
  while (std::getline(a, lineA) && std::getline(b, lineB)) {
    ++lines;
    different += lineA != lineB;
  }
  EXPECT_GT(lines, 100);
  EXPECT_LE(different, 20) << "of " << lines;
}

TEST(TablesCommand, RefusesWhatItCannotDoAndLeavesNothing) {
  const TemporaryFolder folder;
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{"tables"},
                                             {"tables", "--out", ""},
                                             {"tables", "--out", folder / "x", "--size", "1"},
                                             {"tables", "--out", folder / "x", "--size", "4096"},
                                             {"tables", "--out", folder / "x", "--nope"},
                                             {"tables", "--embed", folder / "y", "--size", "8"}}) {
    const Outcome outcome = runProgram(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << ::testing::PrintToString(arguments) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("rigel: "));
  }
  std::ofstream(folder / "file") << "not a directory";
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"tables", "--out", folder / "file"},
                                                                     {"tables", "--out", "/proc/rigel"},
                                                                     {"tables", "--embed", folder / "no/such/y"}}) {
    const Outcome outcome = runProgram(arguments);
    EXPECT_EQ(outcome.exitCode, 1) << ::testing::PrintToString(arguments) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("rigel: "));
  }
  EXPECT_EQ(textOf(folder / "file"), "not a directory");
  EXPECT_EQ(filesIn(folder.path()), 1u);
}

}  // namespace
}  // namespace rigel::test
