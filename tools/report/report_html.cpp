#include "report/report_html.h"

#include "picture/heat_map.h"
#include "report/base64.h"
#include "report/page_files.h"
#include "report/report_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

/// All page files of one kind, one after another.
std::string concatenated(std::string_view extension) {
  std::string text;
  for (const PageFile& file : pageFiles())
    if (file.name.ends_with(extension)) text += file.content;
  return text;
}

std::string dataUri(const std::vector<std::uint8_t>& png) { return "data:image/png;base64," + base64(png); }

/// The heat map's colours from no error to the top of its scale, as a style sheet writes them.
Json heatMapColors() {
  constexpr int kStops = 65;  // blended by the browser: at most 5 of 255 off (tested)
  Json colors = Json::array();
  for (int i = 0; i < kStops; ++i) {
    const Rgb8 color = heatColour(static_cast<float>(i) / (kStops - 1));
    colors.push_back(fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b));
  }
  return colors;
}

/// The pictures as data URIs, in the order of the document's objects and their pictures.
Json embeddedPictures(const Report& report) {
  Json objects = Json::array();
  for (const SceneReport& scene : report.scenes) {
    for (const ObjectReport& object : scene.objects) {
      Json pictures = Json::array();
      for (const Picture& picture : object.pictures) {
        Json entry = Json::object();
        if (!picture.imageBytes.empty()) entry["image"] = dataUri(picture.imageBytes);
        if (!picture.errorBytes.empty()) entry["error"] = dataUri(picture.errorBytes);
        pictures.push_back(std::move(entry));
      }
      objects.push_back(std::move(pictures));
    }
  }
  return objects;
}

/// Copies `text`, with each {{NAME}} replaced. What is put in is not searched again: it may hold braces of its own.
std::string fill(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string result;
  for (;;) {
    const std::size_t open = text.find("{{");
    result += text.substr(0, open);
    if (open == std::string_view::npos) return result;
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    assert(value != values.end() && "page/template.html names a part that does not exist");
    result += value->second;
    text.remove_prefix(close + 2);
  }
}

}  // namespace

std::string scriptSafeJson(const nlohmann::ordered_json& document) {
  // In JSON a '<' occurs in strings only, where it may be written as an escape: then neither "</script>" nor "<!--"
  // exists.
  const std::string text = jsonText(document, -1);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string reportHtml(const Report& report, const nlohmann::ordered_json& document) {
  return fill(concatenated(".html"),
              {{"STYLE", concatenated(".css")},
               {"SCRIPT", concatenated(".js")},
               {"DATA", scriptSafeJson(document)},
               {"PICTURES", scriptSafeJson({{"colors", heatMapColors()}, {"objects", embeddedPictures(report)}})}});
}

}  // namespace rigel::tools
