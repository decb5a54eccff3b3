// Pictures replace those of an earlier report, all of them or none, and nothing that is not ours.
#include "report/files/staged_images.h"

#include "report/files/made_directory.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <unistd.h>

#include <fstream>
#include <map>
#include <sstream>

namespace rigel::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tools::MadeDirectory;
using tools::StagedImages;
using Files = std::map<std::string, std::string>;

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

class Staged : public testing::Test {
 protected:
  /// A report that names `pictures`, which are there.
  void putEarlierReport(const std::vector<std::string>& pictures) {
    std::string list;
    for (const std::string& name : pictures) {
      list += (list.empty() ? "" : ",") + (R"({"image_png":"images/)" + name + "\"}");
      put(root_ / "images" / name, "old");
    }
    put(root_ / "report.json", R"({"objects":[{"pictures":[)" + list + "]}]}");
  }
  /// Path and content of all files, "images/a.png" -> "old".
  Files files() const {
    Files all;
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      std::ostringstream text;
      if (entry.is_regular_file()) text << std::ifstream(entry.path()).rdbuf();
      if (entry.is_regular_file() || fs::is_empty(entry)) all[entry.path().lexically_relative(root_)] = text.str();
    }
    all.erase("report.json");
    return all;
  }
  std::unique_ptr<StagedImages> begin() {
    auto images = StagedImages::begin(root_, true);
    if (!images) throw std::runtime_error(images.error().line());
    return *std::move(images);
  }

  test::TemporaryFolder folder_;
  const fs::path root_ = folder_.path();
};

TEST_F(Staged, TakesThePlaceOfEarlierPicturesOnly) {
  putEarlierReport({"01-car-frame0001-truth.png", "gone.png"});
  put(root_ / "images/holiday.png", "mine");
  put(root_ / "images/sub/gone.png", "mine");
  auto images = begin();
  put(images->directory() / "01-car-frame0001-truth.png", "new");
  put(images->directory() / "other.exr", "new");
  ASSERT_FALSE(images->putInPlace());
  EXPECT_EQ(files().at("images/gone.png"), "old") << "until the rest of the report is written";
  images->keep();
  images.reset();
  EXPECT_EQ(files(), (Files{{"images/01-car-frame0001-truth.png", "new"},
                            {"images/other.exr", "new"},
                            {"images/holiday.png", "mine"},
                            {"images/sub/gone.png", "mine"}}));
}

TEST_F(Staged, WithoutKeepEverythingGoesBack) {
  putEarlierReport({"a.png", "b.png"});
  const Files before = files();
  {
    auto images = begin();
    put(images->directory() / "a.png", "new");
    put(images->directory() / "c.png", "new");
    ASSERT_FALSE(images->putInPlace());
    EXPECT_EQ(files().at("images/a.png"), "new");
  }
  EXPECT_EQ(files(), before);

  fs::remove_all(root_ / "images");
  {
    auto images = begin();
    put(images->directory() / "a.png", "new");
    ASSERT_FALSE(images->putInPlace());
  }
  EXPECT_EQ(files(), Files{}) << "no folder where there was none";
}

TEST_F(Staged, AForeignFileInTheWayStopsAllPictures) {
  putEarlierReport({"a.png"});
  put(root_ / "images/b.png", "mine");
  const Files before = files();
  {
    auto images = begin();
    put(images->directory() / "a.png", "new");
    put(images->directory() / "b.png", "new");
    const auto error = images->putInPlace();
    ASSERT_TRUE(error);
    EXPECT_THAT(error->line(), HasSubstr("images/b.png: is in the way"));
  }
  EXPECT_EQ(files(), before);
}

TEST_F(Staged, WithoutPicturesEarlierOnesGoAndOthersStay) {
  putEarlierReport({"a.png"});
  put(root_ / "images/holiday.png", "mine");
  auto images = begin();
  ASSERT_FALSE(images->putInPlace());
  images->keep();
  images.reset();
  EXPECT_EQ(files(), (Files{{"images/holiday.png", "mine"}}));

  putEarlierReport({"a.png"});
  fs::remove(root_ / "images/holiday.png");
  images = begin();
  ASSERT_FALSE(images->putInPlace());
  images->keep();
  images.reset();
  EXPECT_EQ(files(), Files{}) << "the folder held nothing else";
}

TEST_F(Staged, AReportIsNotBelievedWhenItPointsElsewhere) {
  put(root_ / "outside.png", "mine");
  put(root_ / "images/notes.txt", "mine");
  put(root_ / "images/sub/a.png", "mine");
  fs::create_symlink(root_ / "outside.png", root_ / "images/link.png");
  for (const char* document :
       {R"({"objects":[{"pictures":[{"image_png":"images/../outside.png"},{"image_png":"images/notes.txt"},
           {"image_png":"images/sub/a.png"},{"image_png":"outside.png"},{"image_png":"images/link.png"},
           {"image_png":"images/"},{"image_png":7},{"error_exr":"images/.."},5]},{"pictures":3},4]})",
        R"({"objects":{"pictures":[]}})", "[1,2]", "not json", "", "null"}) {
    put(root_ / "report.json", document);
    EXPECT_TRUE(tools::earlierPictures(root_).empty()) << document;
    auto images = begin();
    ASSERT_FALSE(images->putInPlace());
    images->keep();
  }
  EXPECT_TRUE(fs::is_symlink(root_ / "images/link.png"));
  EXPECT_EQ(files().size(), 4u);
}

TEST_F(Staged, WhatStandsInTheWayIsFoundAtTheStart) {
  put(root_ / "images", "a file");
  auto images = StagedImages::begin(root_, true);
  ASSERT_FALSE(images);
  EXPECT_THAT(images.error().line(), HasSubstr("images: is not a directory"));
  EXPECT_TRUE(StagedImages::begin(root_, false)) << "no pictures, no matter";
  EXPECT_EQ(files(), (Files{{"images", "a file"}}));

  fs::remove(root_ / "images");
  put(root_ / "images/s1-a-c2-b-o03-car-frame0025-poly_6-error.exr", "of a report whose report.json was deleted");
  images = StagedImages::begin(root_, true);
  ASSERT_FALSE(images);
  EXPECT_THAT(images.error().line(), HasSubstr("move it away"));
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(Staged, LeftoversOfTheDeadAreRemovedNotThoseOfTheLiving) {
  const std::string dead = "999999999";  // above the highest process id of Linux
  const std::string living = std::to_string(::getppid());
  for (const std::string& process : {dead, living}) {
    put(root_ / (".images." + process) / "a.png", "aside");
    put(root_ / (".report.html." + process + ".old"), "aside");
  }
  put(root_ / ".images.old/a.png", "mine");
  put(root_ / (".images." + dead + "1/a.png"), "mine");
  fs::create_directory(root_ / "elsewhere");
  fs::create_directory_symlink(root_ / "elsewhere", root_ / ".images.999999998");
  begin().reset();
  EXPECT_EQ(files(), (Files{{".images." + living + "/a.png", "aside"},
                            {".report.html." + living + ".old", "aside"},
                            {".images.old/a.png", "mine"},
                            {".images." + dead + "1/a.png", "mine"},
                            {".images.999999998", ""},
                            {"elsewhere", ""}}));
}

TEST_F(Staged, ADirectoryIsMadeAndUnmade) {
  {
    const auto made = MadeDirectory::make(root_ / "a/b/");
    ASSERT_TRUE(made) << made.error().line();
    EXPECT_TRUE(fs::is_directory(root_ / "a/b"));
  }
  EXPECT_FALSE(fs::exists(root_ / "a"));
  {
    const auto made = MadeDirectory::make(root_ / "a/b");
    ASSERT_TRUE(made) << made.error().line();
    put(root_ / "a/kept", "something");
  }
  EXPECT_EQ(files(), (Files{{"a/kept", "something"}}));
}

TEST_F(Staged, ADirectoryThatCannotBeUsedIsNamed) {
  put(root_ / "file", "kept");
  for (const fs::path& path : {root_ / "file", root_ / "file/below", fs::path("/proc/rigel")}) {
    const auto made = MadeDirectory::make(path);
    ASSERT_FALSE(made) << path;
    EXPECT_THAT(made.error().line(), HasSubstr(path.string() + ": "));
  }
  EXPECT_FALSE(MadeDirectory::make("/proc")) << "exists, and takes no file";
  if (::geteuid() != 0) {  // no directory is read-only to root
    fs::permissions(root_, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_FALSE(MadeDirectory::make(root_));
    EXPECT_FALSE(MadeDirectory::make(root_ / "below"));
    fs::permissions(root_, fs::perms::owner_all);
  }
  EXPECT_EQ(files(), (Files{{"file", "kept"}}));
}

}  // namespace
}  // namespace rigel::tests
