// report.html as text: self-contained, closed against names from files. What it does in a browser: report_page_test.sh.
#include "report/formats/report_html.h"

#include "picture/heat_map.h"
#include "report/formats/base64.h"
#include "report/formats/page_files.h"
#include "report/formats/report_json.h"
#include "report/view3d/view3d_json.h"
#include "report_fixture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <regex>

namespace rigel::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page(const tools::Report& report) {
  const auto document = tools::reportJson(report);
  EXPECT_TRUE(document);
  return tools::reportHtml(report, *document);
}

std::size_t occurrences(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// What stands between `<script ... id="ID">` and its end tag.
std::string scriptBlock(const std::string& html, const std::string& id) {
  const std::size_t tag = html.find("id=\"" + id + "\">");
  EXPECT_NE(tag, std::string::npos);
  const std::size_t begin = html.find('>', tag) + 1;
  return html.substr(begin, html.find("</script", begin) - begin);
}

TEST(Base64, TestVectorsOfRfc4648) {
  const std::pair<std::string, std::string> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors)
    EXPECT_EQ(tools::base64(std::vector<std::uint8_t>(plain.begin(), plain.end())), coded);
  EXPECT_EQ(tools::base64(std::vector<std::uint8_t>{0xFB, 0xEF, 0xFF}), "++//") << "the high bit is no sign";
}

TEST(ReportHtml, EveryPageFileIsPutIn) {
  const std::string html = page(madeUpReport());
  ASSERT_GE(tools::pageFiles().size(), 10u);
  for (const tools::PageFile& file : tools::pageFiles()) {
    EXPECT_FALSE(file.content.empty()) << file.name;
    if (file.name.ends_with(".html")) continue;
    EXPECT_THAT(html, HasSubstr(std::string(file.content))) << file.name;
  }
  EXPECT_EQ(occurrences(html, "{{"), 0u) << "a part of the template is not filled";
}

/// All scripts share one closure: a name that two of them declare breaks the page.
TEST(ReportHtml, NoTwoScriptsDeclareOneName) {
  const std::regex declaration(R"((?:^|\n)(?:const|let|class|(?:async )?function\*?) (\w+))");
  std::map<std::string, std::string_view> declaredIn;
  for (const tools::PageFile& file : tools::pageFiles()) {
    if (!file.name.ends_with(".js") || file.name == "charts.js") continue;
    const std::string text(file.content);
    for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
      const auto [known, isNew] = declaredIn.try_emplace((*at)[1], file.name);
      EXPECT_TRUE(isNew) << known->first << " in " << known->second << " and " << file.name;
    }
  }
  EXPECT_GT(declaredIn.size(), 100u);
}

TEST(ReportHtml, NeedsNothingButItself) {
  const std::string html = page(madeUpReport());
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(html, Not(HasSubstr("href=\"http")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  for (const tools::PageFile& file : tools::pageFiles()) {
    if (file.name == "charts.js") continue;  // Plot's own, for markup that is handed to it as such
    EXPECT_EQ(file.content.find("innerHTML"), std::string_view::npos) << file.name << ": names are written as text";
  }
}

TEST(ReportHtml, EmbedsTheNumbersOfEveryPicture) {
  const tools::Report report = madeUpReport();
  const std::string html = page(report);
  EXPECT_EQ(occurrences(html, "data:image"), 0u) << "the page draws its pictures itself";
  const auto json = nlohmann::json::parse(scriptBlock(html, "picture-data"))["objects"];
  std::size_t objects = 0, frames = 0, rigs = 0, bytes = 0;
  for (const tools::SceneReport& scene : report.scenes) {
    for (const tools::ObjectReport& object : scene.objects) {
      const auto& written = json.at(objects++);
      ASSERT_EQ(written.size(), object.pixels.size());
      for (std::size_t f = 0; f < object.pixels.size(); ++f) {
        const tools::PixelFrame& frame = object.pixels[f];
        EXPECT_EQ(written[f]["frame"], frame.frame);
        EXPECT_EQ(written[f]["exact"], frame.exact);
        EXPECT_EQ(written[f]["coverage"], tools::base64(frame.coverage));
        EXPECT_EQ(written[f]["reflectance"], tools::base64(frame.reflectance));
        EXPECT_EQ(written[f]["surroundings"], tools::base64(frame.surroundings));
        EXPECT_EQ(written[f]["truth"], tools::base64(frame.truth));
        for (std::size_t r = 0; r < frame.rigs.size(); ++r, ++rigs)
          EXPECT_EQ(written[f]["rigs"].at(r)["irradiance"], tools::base64(frame.rigs[r].irradiance));
        ++frames;
        bytes += frame.bytes();
      }
    }
  }
  EXPECT_EQ(frames, 8u);
  EXPECT_EQ(rigs, 8u * 8u);
  std::size_t own = tools::view3dJson(report).size();
  for (const auto& files : {tools::pageFiles(), tools::threeFiles()})
    for (const tools::PageFile& file : files) own += file.content.size();
  // Base64 is 4/3 of the bytes; the figures took 290 kB when this was written.
  EXPECT_LT(html.size(), bytes * 4 / 3 + own + 350'000);
}

TEST(ReportHtml, NamesCannotLeaveTheDataBlock) {
  const std::string plain = page(madeUpReport()), hostile = page(hostileReport());
  EXPECT_EQ(occurrences(hostile, "<script"), occurrences(plain, "<script"));
  EXPECT_EQ(occurrences(hostile, "</script"), occurrences(plain, "</script"));
  EXPECT_EQ(occurrences(hostile, "<!--"), occurrences(plain, "<!--"));
  EXPECT_EQ(occurrences(hostile, "onerror="), occurrences(hostile, "onerror=\\\"")) << "only inside JSON strings";
  const std::string block = scriptBlock(hostile, "report-data");
  EXPECT_EQ(occurrences(block, "<"), 0u);
  EXPECT_EQ(occurrences(block, "{{DATA}}"), 2u) << "what looks like a part of the template stays as it is";
  const auto json = nlohmann::ordered_json::parse(block);
  EXPECT_EQ(json["objects"][0]["name"], kHostileMarkup);
  EXPECT_EQ(json["scenes"][0]["scene"], kHostileQuotes);
}

TEST(ReportHtml, ScaleHasTheColoursOfTheHeatMaps) {
  const auto colors = nlohmann::json::parse(scriptBlock(page(madeUpReport()), "picture-data"))["colors"];
  ASSERT_GE(colors.size(), 9u);
  const auto written = [](tools::Rgb8 color) { return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b); };
  EXPECT_EQ(colors.front(), written(tools::heatColour(0)));
  EXPECT_EQ(colors[(colors.size() - 1) / 2], written(tools::heatColour(0.5f)));
  EXPECT_EQ(colors.back(), written(tools::heatColour(1)));

  // A browser blends between stops; the heat map does not.
  constexpr int kTolerance = 6;  // of 255; worst measured 5, where blue leaves the edge of sRGB
  int worst = 0;
  const auto channel = [&](std::size_t stop, std::size_t c) {
    return std::stoi(colors[stop].get<std::string>().substr(1 + 2 * c, 2), nullptr, 16);
  };
  for (int i = 0; i < 1000; ++i) {
    const double at = i / 1000.0 * static_cast<double>(colors.size() - 1);
    const std::size_t stop = static_cast<std::size_t>(at);
    const tools::Rgb8 exact = tools::heatColour(static_cast<float>(i) / 1000);
    for (std::size_t c = 0; c < 3; ++c) {
      const double blend =
          channel(stop, c) + (at - static_cast<double>(stop)) * (channel(stop + 1, c) - channel(stop, c));
      const int wanted = c == 0 ? exact.r : c == 1 ? exact.g : exact.b;
      worst = std::max(worst, std::abs(static_cast<int>(std::lround(blend)) - wanted));
    }
  }
  EXPECT_LE(worst, kTolerance);
}

TEST(ReportHtml, EmptyReportIsStillAPage) {
  const std::string html = page(tools::Report{});
  EXPECT_THAT(html, testing::EndsWith("</html>\n"));
  EXPECT_EQ(nlohmann::json::parse(scriptBlock(html, "picture-data"))["objects"].size(), 0u);
}

}  // namespace
}  // namespace rigel::tests
