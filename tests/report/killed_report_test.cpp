// A program that is killed while its report takes the place of an earlier one, before each change that it makes to the
// directory: what is there then is the earlier report, or none, or the new one, never some of each; and the next
// program puts in order what was left.
#include "report/files/earlier_pictures.h"
#include "report/files/staged_images.h"
#include "report/files/write_together.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace {

int changesLeft = std::numeric_limits<int>::max();

void beforeChange() {
  if (changesLeft-- == 0) ::kill(::getpid(), SIGKILL);
}

}  // namespace

// The standard library's changes to directories come through here: a program's own functions go before the C library's.
extern "C" {
int rename(const char* from, const char* to) noexcept {
  beforeChange();
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0u));
}
int link(const char* from, const char* to) noexcept {
  beforeChange();
  return ::linkat(AT_FDCWD, from, AT_FDCWD, to, 0);
}
int remove(const char* path) noexcept {
  beforeChange();
  if (::unlinkat(AT_FDCWD, path, 0) == 0) return 0;
  return ::unlinkat(AT_FDCWD, path, AT_REMOVEDIR);
}
int mkdir(const char* path, mode_t mode) noexcept {
  beforeChange();
  return ::mkdirat(AT_FDCWD, path, mode);
}
}

namespace rigel::tests {
namespace {

namespace fs = std::filesystem;
using tools::StagedImages;
using Files = std::map<std::string, std::string>;

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::string pictureNamed(char letter) { return std::string("01-car-frame0001-") + letter + ".png"; }

/// Writes a report with a picture for each letter, as the program does; every file says `report`.
bool write(const fs::path& out, const std::string& letters, const std::string& report) {
  auto images = StagedImages::begin(out, true);
  if (!images) return false;
  std::string pictures;
  for (const char letter : letters) {
    test::writeFile((*images)->directory() / pictureNamed(letter), report);
    pictures += (pictures.empty() ? "" : ",") + (R"({"image_png":"images/)" + pictureNamed(letter) + "\"}");
  }
  if ((*images)->putInPlace()) return false;
  const tools::FileContent files[] = {
      {"report.html", report},
      {"report.json", "{\"report\":\"" + report + "\",\"objects\":[{\"pictures\":[" + pictures + "]}]}"}};
  if (tools::writeTogether(files, out)) return false;
  (*images)->keep();
  return true;
}

/// Whether the program came to its end before the change numbered `changes`.
bool writeUntilKilled(const fs::path& out, const std::string& letters, const std::string& report, int changes) {
  const pid_t child = ::fork();
  if (child == 0) {
    changesLeft = changes;
    ::_exit(write(out, letters, report) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << "before change " << changes;
  return !WIFSIGNALED(status);
}

class KilledReport : public testing::Test {
 protected:
  /// Which report the directory holds, by report.json: "" where there is none. Its page and its pictures must be its
  /// own.
  std::string held() const {
    const std::string document = textOf(out_ / "report.json");
    if (document.empty()) return "";
    const std::string report = document.find("\"old\"") != std::string::npos ? "old" : "new";
    if (fs::exists(out_ / "report.html")) {
      EXPECT_EQ(textOf(out_ / "report.html"), report);
    }
    const std::set<std::string> pictures = tools::earlierPictures(out_);
    EXPECT_EQ(pictures.size(), 3u) << "a picture is missing";
    for (const std::string& name : pictures) EXPECT_EQ(textOf(out_ / "images" / name), report) << name;
    return report;
  }
  /// Path and content of every file.
  Files files() const {
    Files all;
    for (const auto& entry : fs::recursive_directory_iterator(out_))
      if (entry.is_regular_file()) all[entry.path().lexically_relative(out_)] = textOf(entry.path());
    return all;
  }

  test::TemporaryFolder folder_;
  const fs::path out_ = folder_ / "out";
};

TEST_F(KilledReport, LeavesTheEarlierOneOrNoneOrTheNewOne) {
  std::map<std::string, int> outcomes;
  bool finished = false;
  for (int changes = 0; !finished; ++changes) {
    SCOPED_TRACE(testing::Message() << "killed before change " << changes);
    fs::remove_all(out_);
    fs::create_directories(out_ / "images");
    test::writeFile(out_ / "images/holiday.png", "mine");
    ASSERT_TRUE(write(out_, "abc", "old"));
    const Files before = files();
    finished = writeUntilKilled(out_, "bcd", "new", changes);
    const std::string after = held();
    ++outcomes[after];
    if (finished) {
      EXPECT_EQ(after, "new");
    }

    // The next program begins, and gives up.
    ASSERT_TRUE(StagedImages::begin(out_, true)) << "what was left is in the way";
    const std::string restored = held();
    EXPECT_EQ(restored, after.empty() ? "old" : after) << "a report that was withdrawn comes back";
    EXPECT_EQ(textOf(out_ / "images/holiday.png"), "mine");
    if (restored == "old") {
      EXPECT_EQ(files(), before);
    }
    EXPECT_EQ(files().size(), before.size()) << "something is left over";

    ASSERT_TRUE(write(out_, "bcd", "new")) << "another program";
    EXPECT_EQ(held(), "new");
    EXPECT_EQ(files().size(), before.size());
    ASSERT_LT(changes, 200);
  }
  EXPECT_GT(outcomes["old"], 3);
  EXPECT_GT(outcomes[""], 8);
  EXPECT_GT(outcomes["new"], 3);
}

TEST_F(KilledReport, LeavesNothingInTheWayOfTheFirstReport) {
  bool finished = false;
  int killed = 0;
  for (int changes = 0; !finished; ++changes) {
    SCOPED_TRACE(testing::Message() << "killed before change " << changes);
    fs::remove_all(out_);
    fs::create_directories(out_);
    finished = writeUntilKilled(out_, "bcd", "new", changes);
    killed += !finished;
    const std::string after = held();
    ASSERT_TRUE(StagedImages::begin(out_, true)) << "what was left is in the way";
    EXPECT_EQ(held(), after);
    if (after.empty()) {
      EXPECT_FALSE(fs::exists(out_ / "images")) << "pictures of a report that never was";
    }
    ASSERT_LT(changes, 200);
  }
  EXPECT_GT(killed, 10);
}

}  // namespace
}  // namespace rigel::tests
