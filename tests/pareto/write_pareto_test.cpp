#include "pareto/write_pareto.h"

#include "made_up_pareto.h"
#include "pareto/pareto_html.h"
#include "pareto/pareto_svg.h"
#include "pareto/pareto_text.h"
#include "report/formats/page_files.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <limits>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

std::vector<std::string> filesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  return names;
}

TEST(WritePareto, WritesFourFilesOrNone) {
  const test::TemporaryFolder folder;
  ASSERT_FALSE(writePareto(madeUpPareto(true), folder.path()));
  EXPECT_THAT(filesIn(folder.path()),
              testing::UnorderedElementsAre("pareto.html", "pareto.json", "pareto.csv", "pareto.svg"));
  const auto time = fs::last_write_time(folder / "pareto.json");

  Pareto unsound = madeUpPareto(true);
  unsound.objects[0].points[0].total.rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(writePareto(unsound, folder.path()));
  EXPECT_EQ(fs::last_write_time(folder / "pareto.json"), time) << "the old study stays";

  const test::TemporaryFolder blocked;
  fs::create_directory(blocked / "pareto.svg");
  ASSERT_TRUE(paretoObstacle(blocked.path()));
  EXPECT_TRUE(writePareto(madeUpPareto(true), blocked.path()));
  EXPECT_THAT(filesIn(blocked.path()), testing::ElementsAre("pareto.svg"));
}

TEST(ParetoHtml, HoldsAllItNeedsAndNothingThatEndsIt) {
  const test::TemporaryFolder folder;
  ASSERT_FALSE(writePareto(madeUpPareto(true), folder.path()));
  const std::string html = test::contentOf(folder / "pareto.html");
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, Not(HasSubstr("{{")));
  EXPECT_THAT(html, Not(HasSubstr("</script><script>document.title")));
  EXPECT_THAT(html, HasSubstr("Copyright 2020-2025 Observable, Inc.")) << "licences go with the bundle";
  ASSERT_GE(paretoPageFiles().size(), 8u);
  std::size_t scripts = 0;
  for (std::size_t at = 0; (at = html.find("</script>", at)) != std::string::npos; ++at) ++scripts;
  EXPECT_EQ(scripts, 2u) << "data and script";
}

TEST(ParetoSvg, DrawsPointsAndEscapesNames) {
  Pareto pareto = madeUpPareto(true);
  pareto.objects[0].name = "<car> & co";
  const std::string svg = paretoSvg(pareto);
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("&lt;car&gt; &amp; co"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, HasSubstr("class=\"poly front\""));
  EXPECT_THAT(svg, HasSubstr("poly:12"));
}

TEST(ParetoSvg, StandsWhatHasNoError) {
  Pareto pareto = madeUpPareto(false);
  pareto.objects = {pareto.objects[1]};
  EXPECT_THAT(paretoSvg(pareto), Not(HasSubstr("nan")));
  pareto.objects.clear();
  EXPECT_THAT(paretoSvg(pareto), HasSubstr("</svg>"));
}

TEST(ParetoText, ShowsTheFrontAndWhereAutoIs) {
  const std::string text = frontText(madeUpPareto(false));
  EXPECT_THAT(text, HasSubstr("--rig poly:4 --near 0 --bands 3"));
  EXPECT_THAT(text, Not(HasSubstr("--rig lattice:4x1x1 --near 0 ")));
  EXPECT_THAT(text, HasSubstr("by the cost model"));
  EXPECT_THAT(text, Not(HasSubstr("\x1b"))) << "names are for terminals, too";
}

}  // namespace
}  // namespace rigel::tests
