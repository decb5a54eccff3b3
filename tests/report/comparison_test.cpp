// rigel report --compare: the same rigs in two documents, how they are matched, judged and written; and what is
// refused.
#include "report/formats/comparison.h"
#include "report/formats/report_summary.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

Json rig(const char* spec, double total, double fit) {
  return {{"spec", spec},        {"asked", ""},   {"total", {{"rms", total}, {"max", 2 * total}}},
          {"max_jump", nullptr}, {"fit_us", fit}, {"sh_vectors", 6}};
}

Json document(std::vector<Json> rigs) {
  return {{"command", "rigel report a.glb"},
          {"objects", Json::array({{{"name", "fox|</td>"}, {"scene", "a.glb"}, {"clip", ""}, {"rigs", rigs}}})}};
}

Comparison compared(const Json& a, const Json& b) {
  auto out = compareReports({{"a.json", a}, {"b.json", b}});
  EXPECT_TRUE(out) << (out ? "" : out.error().line());
  return *out;
}

TEST(Comparison, MatchesRigsByName) {
  const Comparison c = compared(document({rig("poly:6", 0.04, 10), rig("constant", 0.3, 1)}),
                                document({rig("constant", 0.3, 1), rig("poly:6", 0.05, 9), rig("auto", 0.02, 200)}));
  ASSERT_EQ(c.rigs.size(), 3u);
  EXPECT_EQ(c.rigs[0].spec, "poly:6");
  EXPECT_NEAR(*c.rigs[0].ratio(0, 1), 1.25, 1e-12);
  EXPECT_NEAR(*c.rigs[1].ratio(0, 1), 1, 1e-12);
  EXPECT_FALSE(c.rigs[2].ratio(0, 1)) << "the first run has no auto";
  EXPECT_FALSE(c.rigs[0].ratio(4, 1)) << "neither has a jump";
}

TEST(Comparison, TwoOfOneNameAreTakenInOrder) {
  const Json two = document({rig("poly:6", 0.04, 10), rig("poly:6", 0.08, 10)});
  const Comparison c = compared(two, two);
  ASSERT_EQ(c.rigs.size(), 2u);
  for (const ComparedRig& r : c.rigs) EXPECT_NEAR(*r.ratio(0, 1), 1, 1e-12);
}

TEST(Comparison, JudgesWhatIsWorse) {
  const Comparison c =
      compared(document({rig("poly:6", 0.04, 10), rig("constant", 0.3, 1)}), document({rig("poly:6", 0.05, 30)}));
  EXPECT_TRUE(worsened(c, {}).empty()) << "nothing is judged where no limit is set";
  EXPECT_THAT(worsened(c, {1.3, 3.5}), ElementsAre(HasSubstr("constant of fox|</td> is missing")));
  EXPECT_THAT(worsened(c, {1.2, {}}),
              ElementsAre(HasSubstr("poly:6 of fox|</td>: total RMS % 5.00 was 4.00: 1.25 times, 1.2 allowed"),
                          HasSubstr("total max %"), HasSubstr("missing")));
  EXPECT_THAT(worsened(c, {{}, 2.0}), ElementsAre(HasSubstr("fit us 30.0 was 10.0: 3 times"), HasSubstr("missing")));
}

TEST(Comparison, ErrorsNobodySeesAreAlike) {
  const Comparison c = compared(document({rig("poly:6", 1e-9, 0.01)}), document({rig("poly:6", 5e-5, 0.4)}));
  EXPECT_TRUE(worsened(c, {1.0, 1.0}).empty());
}

TEST(Comparison, NothingInCommonIsAnError) {
  const auto c = compareReports({{"a", document({rig("a", 1, 1)})}, {"b", document({rig("b", 1, 1)})}});
  ASSERT_FALSE(c);
  EXPECT_THAT(c.error().line(), HasSubstr("no rig of an object is in more than one"));
}

TEST(Comparison, IsWrittenForAllReaders) {
  const Comparison c = compared(document({rig("poly:6", 0.04, 10)}), document({rig("poly:6", 0.05, 10)}));
  EXPECT_THAT(comparisonText(c), HasSubstr("x1.25"));
  EXPECT_THAT(comparisonMarkdown(c), HasSubstr("fox\\|\\<"));
  EXPECT_THAT(comparisonMarkdown(c), HasSubstr("4.00 / 5.00 (x1.25)"));
  EXPECT_THAT(comparisonHtml(c), HasSubstr("fox|&lt;/td&gt;"));
  EXPECT_THAT(comparisonHtml(c), HasSubstr("<td class=\"worse\">4.00 / 5.00<small>x1.25</small></td>"));
  EXPECT_THAT(comparisonCsv(c), HasSubstr("a.glb,,fox|</td>,poly:6,,total_rms,0.04,0.05,1.25"));
  EXPECT_EQ(comparisonJson(c, {"x"})["worsened"], Json::array({"x"}));
}

TEST(ReportSummary, AdvisedRigsStandOut) {
  Json doc = document({rig("poly:6", 0.04, 10), rig("constant", 0.3, 1)});
  doc["objects"][0]["verdict"] = {{"spec", "poly:6"}, {"advised", true}, {"sentence", "poly:6 it is"}};
  EXPECT_THAT(reportMarkdown(doc), HasSubstr("| **poly:6** | 4.00 |"));
  EXPECT_THAT(reportMarkdown(doc), HasSubstr("| constant | 30.00 |"));
  doc["objects"][0]["verdict"]["advised"] = false;
  EXPECT_THAT(reportMarkdown(doc), Not(HasSubstr("**")));
  EXPECT_THAT(reportCsv(doc), HasSubstr("\na.glb,,fox|</td>,poly:6,,0.04,0.08,,,,10,,6,,\n"));
}

class ReportFileTest : public testing::Test {
 protected:
  std::string refusal(const std::string& content) const {
    const auto file = folder_ / "r.json";
    test::writeFile(file, content);
    const auto read = readReportFile(file);
    return read ? "" : read.error().line();
  }
  test::TemporaryFolder folder_;
};

TEST_F(ReportFileTest, IsReadOrRefusedByPlace) {
  EXPECT_EQ(refusal(document({rig("poly:6", 0.04, 10)}).dump()), "");
  EXPECT_EQ(refusal(R"({"objects":[]})"), "");
  EXPECT_THAT(refusal(""), HasSubstr("r.json: it is not JSON"));
  EXPECT_THAT(refusal("[1,2]"), HasSubstr("document: this is no report"));
  EXPECT_THAT(refusal("{}"), HasSubstr("objects: a report has an array of objects"));
  EXPECT_THAT(refusal(R"({"objects":[3]})"), HasSubstr("objects[0]: this is no object"));
  EXPECT_THAT(refusal(R"({"objects":[{"name":"a","rigs":7}]})"), HasSubstr("objects[0].rigs: an array is missing"));
  EXPECT_THAT(refusal(R"({"objects":[{"name":"a","clip":4,"rigs":[]}]})"),
              HasSubstr("objects[0].clip: this is not text"));
  EXPECT_THAT(refusal(R"({"objects":[{"name":"a","rigs":[{"spec":"x"}]}]})"),
              HasSubstr("objects[0].rigs[0].total.rms: a number is missing"));
  EXPECT_THAT(refusal(R"({"objects":[{"name":"a","rigs":[{"spec":"x","total":{"rms":-1}}]}]})"),
              HasSubstr("this is not a figure of a rig"));
  EXPECT_THAT(readReportFile(folder_ / "none.json").error().line(), HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace rigel::tests
