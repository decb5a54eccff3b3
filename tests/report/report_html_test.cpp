// report.html as text: self-contained, closed against names from files. What it does in a browser: report_page_test.sh.
#include "report/report_html.h"

#include "report/base64.h"
#include "report/page_files.h"
#include "report/report_json.h"
#include "report_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>

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

TEST(ReportHtml, NeedsNothingButItself) {
  const std::string html = page(madeUpReport());
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(html, Not(HasSubstr("href=\"http")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("innerHTML"))) << "names from files are written as text";
}

TEST(ReportHtml, EmbedsEveryPictureOnce) {
  const tools::Report report = madeUpReport();
  const std::string html = page(report);
  std::size_t pictures = 0, bytes = 0;
  for (const tools::SceneReport& scene : report.scenes) {
    for (const tools::ObjectReport& object : scene.objects) {
      for (const tools::Picture& picture : object.pictures) {
        for (const auto* png : {&picture.imageBytes, &picture.errorBytes}) {
          pictures += png->empty() ? 0u : 1u;
          bytes += png->size();
          EXPECT_THAT(html, HasSubstr(tools::base64(*png)));
        }
      }
    }
  }
  ASSERT_EQ(pictures, 3u * 15u);  // truth, seven rigs and their differences: two frames and a still
  EXPECT_EQ(occurrences(html, "data:image/png;base64,"), pictures);
  // Base64 is 4/3 of the bytes; style, script and figures took 172 kB when this was written.
  EXPECT_LT(html.size(), bytes * 4 / 3 + 250'000);
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

TEST(ReportHtml, EmptyReportIsStillAPage) {
  const std::string html = page(tools::Report{});
  EXPECT_THAT(html, testing::EndsWith("</html>\n"));
  EXPECT_EQ(scriptBlock(html, "picture-data"), "[]");
}

}  // namespace
}  // namespace rigel::tests
