// The table on the terminal and the verdict under it.
#include "report/formats/report_text.h"

#include "report/words/verdict.h"
#include "report_fixture.h"

#include <gmock/gmock.h>

#include <sstream>

namespace rigel::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::size_t cells(const std::string& utf8) {
  std::size_t count = 0;
  for (const char c : utf8) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80 ? 1u : 0u;
  return count;
}

TEST(ReportText, ColumnsLineUp) {
  tools::Report report = madeUpReport();
  report.scenes[0].objects[0].rigs[1].spec =
      "gr\xC3\xA4"
      "dient";  // two bytes, one cell
  report.scenes[0].objects[0].rigs[2].bytes = 123456789;
  const std::vector<std::string> text = lines(tools::reportText(report));
  ASSERT_GT(text.size(), 9u);
  EXPECT_THAT(text[0], HasSubstr("car in sample:street, clip drive: 18432 triangles, 4096 surface samples, 61 frames"));
  EXPECT_THAT(text[1], HasSubstr("SH vectors"));
  std::size_t rows = 0;
  for (std::size_t i = 2; i < 10; ++i, ++rows) EXPECT_EQ(cells(text[i]), cells(text[1])) << text[i];
  EXPECT_EQ(rows, 8u);
  // Figures end where their header ends.
  const std::size_t end = text[1].find("SH vectors") + std::string("SH vectors").size();
  EXPECT_EQ(text[2].substr(end - 2, 2), " 1") << text[2];
  EXPECT_EQ(text[6].substr(end - 2, 2), "64") << text[6];
}

TEST(ReportText, DisksHaveATableOfMethods) {
  const std::string text = tools::reportText(madeUpReport());
  EXPECT_THAT(text, HasSubstr("  disk lights: 3120 pairs of a disk and a surface sample"));
  EXPECT_THAT(text, HasSubstr("  auto on car: 1 of 3 disks near at times (sconce 4)\n"));
  EXPECT_THAT(text, HasSubstr("  constant on car: 0 of 3 disks near at times\n"));
  const std::vector<std::string> all = lines(text);
  const auto wallace =
      std::ranges::find_if(all, [](const std::string& line) { return line.starts_with("    wallace"); });
  ASSERT_NE(wallace, all.end());
  EXPECT_THAT(*wallace, testing::MatchesRegex("    wallace +- +- +11 +87 +9\\.2"));
  tools::Report none = madeUpReport();
  none.scenes[0].disks.reset();
  EXPECT_THAT(tools::reportText(none), Not(HasSubstr("disk lights")));
}

TEST(ReportText, AJumpThatWasNotMeasuredIsADash) {
  const tools::Report report = madeUpReport();
  ASSERT_FALSE(report.scenes[1].objects[0].rigs[0].maxJump);
  const auto jumpOf = [](const std::string& table) {
    const std::vector<std::string> text = lines(table);
    EXPECT_GT(text.size(), 2u);
    const std::size_t end = text[1].find("max jump %") + std::string("max jump %").size();
    return text[2].substr(end - 6, 6);
  };
  tools::Report one = report;
  one.scenes.erase(one.scenes.begin());
  EXPECT_EQ(jumpOf(tools::reportText(one)), "     -");
  EXPECT_EQ(jumpOf(tools::reportText(report)), " 14.40");
}

TEST(ReportText, MarksTheRigOfTheVerdict) {
  tools::Report report = madeUpReport();
  EXPECT_THAT(tools::reportText(report), HasSubstr("  > auto "));
  EXPECT_THAT(tools::reportText(report),
              HasSubstr("(5.5 SH vectors and 1.3 near lights, 82 ns a point by the cost model)"));
  for (tools::SceneReport& scene : report.scenes) scene.objects[0].rigs.pop_back();
  const std::string text = tools::reportText(report);
  EXPECT_THAT(text, HasSubstr("  > poly:12 "));
  EXPECT_THAT(text,
              HasSubstr("poly:12 is the cheapest rig (12 SH vectors) within 10 % of the least error: total RMS 8.15 %, "
                        "spatial RMS 4.70 %, against 8.01 % and 4.50 % for lattice:8x4x2 (64 SH vectors)."));
  EXPECT_THAT(text, HasSubstr("  note: material paint"));
}

TEST(ReportText, NamesCannotMoveTheCursor) {
  tools::Report report = hostileReport();
  report.scenes[0].objects[0].name =
      "a\x1b[2Jb\rc\nd\te\x7f"
      "f\xC2\x9Bg\xC3\xA9";
  const std::string text = tools::reportText(report);
  EXPECT_THAT(text, HasSubstr("a?[2Jb?c?d?e?f?g\xC3\xA9 in"));
  for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
}

TEST(ReportText, NothingMeasured) {
  tools::Report report = smallestReport();
  report.scenes[0].objects[0].rigs.clear();
  EXPECT_EQ(lines(tools::reportText(report)).size(), 1u);
  EXPECT_EQ(tools::reportText(tools::Report{}), "");
}

tools::ObjectReport objectWith(std::initializer_list<std::tuple<const char*, int, int, double>> rigs) {
  tools::ObjectReport object;
  object.meanIrradiance = 1;
  for (const auto& [spec, shVectors, projections, rms] : rigs) {
    tools::RigReport rig;
    rig.spec = spec;
    rig.shVectors = shVectors;
    rig.projections = projections;
    rig.total.rms = rms;
    object.rigs.push_back(rig);
  }
  return object;
}

TEST(Verdict, CheapestWithinATenthOfTheBest) {
  const auto chosen = [](const tools::ObjectReport& object) {
    return object.rigs[tools::verdictOf(object)->chosen].spec;
  };
  EXPECT_EQ(chosen(objectWith({{"a", 64, 64, 0.100}, {"b", 12, 24, 0.109}, {"c", 4, 4, 0.111}})), "b");
  EXPECT_EQ(chosen(objectWith({{"a", 64, 64, 0.100}, {"b", 12, 24, 0.120}})), "a")
      << "the best where nothing else is near it";
  EXPECT_EQ(chosen(objectWith({{"a", 6, 12, 0.100}, {"b", 6, 6, 0.105}})), "b") << "same size: fewer projections";
  EXPECT_EQ(chosen(objectWith({{"a", 6, 6, 0.105}, {"b", 6, 6, 0.100}})), "b") << "same cost: less error";
  EXPECT_EQ(chosen(objectWith({{"a", 6, 6, 0.0}, {"b", 1, 1, 0.0}})), "b") << "no error at all";
}

TEST(Verdict, WithNearLightsTheModelledTimeCounts) {
  tools::ObjectReport object = objectWith({{"a", 4, 8, 0.100}, {"b", 12, 24, 0.100}});
  object.rigs[0].nearLights = 3;
  object.rigs[0].modelledNanoseconds = 119;
  object.rigs[1].modelledNanoseconds = 72;
  const auto verdict = tools::verdictOf(object);
  EXPECT_EQ(object.rigs[verdict->chosen].spec, "b") << "twelve vectors cost less than four and three near lights";
  EXPECT_THAT(verdict->sentence,
              HasSubstr("b is the cheapest rig (12 SH vectors, 72 ns a point by the cost model) within 10 %"));
  EXPECT_THAT(verdict->sentence, HasSubstr("for a (4 SH vectors and 3 near lights, 119 ns a point by the cost model)"));
}

TEST(Verdict, AdvisesNoRigThatIsPlainlyWrong) {
  const auto object = objectWith({{"a", 1, 1, 3.8}, {"b", 12, 24, 3.7}});
  const auto verdict = tools::verdictOf(object);
  EXPECT_FALSE(verdict->advised);
  EXPECT_EQ(verdict->chosen, verdict->best) << "a is cheaper and within a tenth, but wrong as well";
  EXPECT_THAT(verdict->sentence, HasSubstr("No rig lights this object well"));
  EXPECT_THAT(verdict->sentence, HasSubstr("b (12 SH vectors), total RMS 370 %"));
  EXPECT_TRUE(tools::verdictOf(objectWith({{"a", 1, 1, tools::kUsableError}}))->advised);

  tools::Report report = madeUpReport();
  for (tools::RigReport& rig : report.scenes[0].objects[0].rigs) rig.total.rms += 3;
  report.scenes.resize(1);
  for (const std::string& line : lines(tools::reportText(report)))
    EXPECT_FALSE(line.starts_with("  > ") && line.find("No rig lights") == std::string::npos) << line;
}

TEST(Verdict, SaysWhatItCannotSay) {
  EXPECT_FALSE(tools::verdictOf(tools::ObjectReport{}));
  EXPECT_THAT(tools::verdictOf(objectWith({{"a", 1, 1, 0.2}}))->sentence,
              HasSubstr("Only a was measured (1 SH vector)"));
  tools::ObjectReport dark = objectWith({{"a", 1, 1, 0.0}, {"b", 4, 4, 0.0}});
  dark.meanIrradiance = 0;
  EXPECT_THAT(tools::verdictOf(dark)->sentence, HasSubstr("No light reaches"));
  const auto clear = objectWith({{"a", 1, 1, 0.3}, {"b", 4, 4, 0.1}});
  EXPECT_THAT(tools::verdictOf(clear)->sentence,
              HasSubstr("b has the least error, and no rig within 10 % of it is cheaper"));
}

}  // namespace
}  // namespace rigel::tests
