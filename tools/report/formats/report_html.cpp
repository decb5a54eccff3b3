#include "report/formats/report_html.h"

#include "picture/heat_map.h"
#include "report/formats/base64.h"
#include "report/formats/page_template.h"
#include "report/formats/report_json.h"
#include "report/view3d/view3d_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

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

Json pixelFrame(const PixelFrame& frame) {
  Json rigs = Json::array();
  for (const PixelFrame::Rig& rig : frame.rigs)
    rigs.push_back({{"rms", rig.rms}, {"irradiance", base64(rig.irradiance)}});
  return {{"frame", frame.frame},
          {"time", frame.time},
          {"width", frame.width},
          {"height", frame.height},
          {"exact", frame.exact},
          {"dropped", frame.dropped},
          {"surroundings_dropped", std::max(frame.dropped, kSurroundingsDropped)},
          {"scale", frame.scale},
          {"exposure", frame.exposure},
          {"heat_scale", frame.heatScale},
          {"coverage", base64(frame.coverage)},
          {"reflectance", base64(frame.reflectance)},
          {"surroundings", base64(frame.surroundings)},
          {"truth", base64(frame.truth)},
          {"rigs", std::move(rigs)}};
}

/// The frames of each object, in the order of the document's objects and of their rigs.
Json embeddedPictures(const Report& report) {
  Json objects = Json::array();
  for (const SceneReport& scene : report.scenes) {
    for (const ObjectReport& object : scene.objects) {
      Json frames = Json::array();
      for (const PixelFrame& frame : object.pixels) frames.push_back(pixelFrame(frame));
      objects.push_back(std::move(frames));
    }
  }
  return objects;
}

/// three.js and what it shows, where there is anything.
std::string view3dScripts(const Report& report) {
  const std::string data = view3dJson(report);
  if (data.empty()) return "";
  return fmt::format("<script type=\"application/json\" id=\"view3d-data\">{}</script>\n<script>\n{}</script>\n", data,
                     concatenated(threeFiles(), ".js"));
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
  const auto all = [](std::string_view extension) { return concatenated(pageFiles(), extension); };
  return fillTemplate(
      all(".html"), {{"STYLE", all(".css")},
                     {"SCRIPT", all(".js")},
                     {"DATA", scriptSafeJson(document)},
                     {"PICTURES", scriptSafeJson({{"colors", heatMapColors()}, {"objects", embeddedPictures(report)}})},
                     {"VIEW3D", view3dScripts(report)}});
}

}  // namespace rigel::tools
