#include "report/formats/report_summary.h"

#include "report/formats/rig_figures.h"
#include "report/words/wording.h"

#include <fmt/format.h>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& of, const char* field) { return of.value(field, std::string()); }

std::string objectMarkdown(const Json& object) {
  std::string out = fmt::format("## {}\n\n", markdownCell(text(object, "name")));
  out += markdownCell(text(object, "scene"));
  if (const std::string clip = text(object, "clip"); !clip.empty()) out += ", clip " + markdownCell(clip);
  out += fmt::format("; {} triangles, {} samples\n\n| rig |", object.value("triangles", 0), object.value("samples", 0));
  std::string line = "\n|---|";
  for (const RigFigure& figure : rigFigures()) {
    out += fmt::format(" {} |", figure.title);
    line += "---:|";
  }
  out += line;
  const Json verdict = object.value("verdict", Json());
  const std::string advised = verdict.is_object() && verdict.value("advised", false) ? text(verdict, "spec") : "";
  for (const Json& rig : object.at("rigs")) {
    const std::string spec = markdownCell(text(rig, "spec"));
    out += fmt::format("\n| {} |", text(rig, "spec") == advised ? "**" + spec + "**" : spec);
    for (const RigFigure& figure : rigFigures()) out += fmt::format(" {} |", shown(figure, valueOf(figure, rig)));
  }
  out += '\n';
  if (verdict.is_object()) out += "\n" + markdownCell(text(verdict, "sentence")) + "\n";
  return out;
}

}  // namespace

std::string markdownCell(std::string_view of) {
  std::string out;
  for (const char c : printable(of)) {
    if (std::string_view("\\`*_{}[]<>#|").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string csvCell(std::string_view of) {
  if (of.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(of);
  std::string quoted = "\"";
  for (const char c : of) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string reportMarkdown(const Json& document) {
  std::string out = "# Rigel report\n\n    " + printable(text(document, "command")) + "\n";
  for (const Json& object : document.at("objects")) out += "\n" + objectMarkdown(object);
  return out +
         "\nErrors are relative to the mean exact irradiance, RMS over surface samples and frames; spatial: rig "
         "against "
         "SH at every point, total: everything against exact irradiance.\n";
}

std::string reportCsv(const Json& document) {
  std::string out = "scene,clip,object,rig,asked";
  for (const RigFigure& figure : rigFigures()) out += fmt::format(",{}", figure.name);
  out += '\n';
  for (const Json& object : document.at("objects"))
    for (const Json& rig : object.at("rigs")) {
      for (const char* field : {"scene", "clip", "name"}) out += csvCell(text(object, field)) + ",";
      out += csvCell(text(rig, "spec")) + "," + csvCell(text(rig, "asked"));
      for (const RigFigure& figure : rigFigures()) {
        const auto value = valueOf(figure, rig);
        out += value ? fmt::format(",{}", *value) : ",";
      }
      out += '\n';
    }
  return out;
}

}  // namespace rigel::tools
