// report.html and report.json appear together or not at all.
#include "report/files/write_report.h"

#include "report_fixture.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <fstream>
#include <limits>

namespace rigel::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WriteReport : public testing::Test {
 protected:
  std::vector<std::string> listing() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(root_)) names.push_back(entry.path().filename());
    return names;
  }
  static void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

  test::TemporaryFolder folder_;
  fs::path root_ = folder_ / "report";  // not there yet
};

TEST_F(WriteReport, MakesTheDirectoryAndLeavesItsFiles) {
  const fs::path deep = root_ / "a" / "b";
  const auto written = tools::writeReport(smallestReport(), deep);
  ASSERT_TRUE(written) << written.error().line();
  EXPECT_EQ(written->html, deep / "report.html");
  EXPECT_EQ(written->htmlBytes, fs::file_size(written->html));
  EXPECT_EQ(nlohmann::json::parse(test::contentOf(written->json))["objects"].size(), 1u);
  root_ = deep;
  EXPECT_THAT(listing(), testing::UnorderedElementsAre("report.csv", "report.html", "report.json", "report.md"));
  root_ = deep.parent_path().parent_path();
}

TEST_F(WriteReport, ReplacesAnEarlierReport) {
  fs::create_directories(root_);
  put(root_ / "report.html", "old page");
  put(root_ / "report.json", "old figures");
  put(root_ / "kept.txt", "not ours");
  ASSERT_TRUE(tools::writeReport(smallestReport(), root_));
  EXPECT_THAT(test::contentOf(root_ / "report.html"), HasSubstr("<!doctype html>"));
  EXPECT_THAT(test::contentOf(root_ / "report.json"), HasSubstr("soldier"));
  EXPECT_THAT(listing(),
              testing::UnorderedElementsAre("report.csv", "report.html", "report.json", "report.md", "kept.txt"));
}

TEST_F(WriteReport, FailureOfTheLastFileUndoesTheOthers) {
  fs::create_directories(root_ / "report.json");  // a directory stands where the last file should
  put(root_ / "report.html", "old page");
  const auto written = tools::writeReport(smallestReport(), root_);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().line(), HasSubstr("report.json: is a directory"));
  EXPECT_EQ(test::contentOf(root_ / "report.html"), "old page");
  EXPECT_THAT(listing(), testing::UnorderedElementsAre("report.html", "report.json"));

  fs::remove(root_ / "report.html");
  ASSERT_FALSE(tools::writeReport(smallestReport(), root_));
  EXPECT_THAT(listing(), testing::ElementsAre("report.json")) << "no page where there was none";
}

TEST_F(WriteReport, NothingIsWrittenOfAReportThatIsNotFinite) {
  tools::Report report = smallestReport();
  report.scenes[0].objects[0].rigs[0].total.rms = std::numeric_limits<double>::infinity();
  const auto written = tools::writeReport(report, root_);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().line(), HasSubstr("total rms is inf"));
  EXPECT_FALSE(fs::exists(root_));
}

TEST_F(WriteReport, AFileInPlaceOfTheDirectoryIsNamed) {
  put(root_, "a file");
  const auto written = tools::writeReport(smallestReport(), root_ / "out");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().line(), HasSubstr((root_ / "out").string()));
  EXPECT_EQ(test::contentOf(root_), "a file");
}

TEST_F(WriteReport, AFullDiskIsNoticed) {
  // The file that is written aside is a link to the device that is always full.
  fs::create_directories(root_);
  const std::string aside = ".report.html." + std::to_string(::getpid()) + ".new";
  fs::create_symlink("/dev/full", root_ / aside);
  const auto written = tools::writeReport(smallestReport(), root_);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().line(), HasSubstr("No space left"));
  EXPECT_TRUE(listing().empty());
}

}  // namespace
}  // namespace rigel::tests
