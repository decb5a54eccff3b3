// A comparison as text, Markdown, CSV, JSON and a page.
#include "report/formats/comparison.h"
#include "report/formats/page_template.h"
#include "report/formats/report_summary.h"
#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Changes smaller than this are not shown as such.
constexpr double kSame = 0.005;

std::string ratioText(const std::optional<double>& ratio) {
  if (!ratio) return "";
  return std::abs(*ratio - 1) < kSame ? "=" : fmt::format("x{:.3g}", *ratio);
}

std::string placeOf(const ComparedRig& rig) {
  std::string place = rig.object;
  if (!rig.scene.empty()) place += " in " + rig.scene;
  if (!rig.clip.empty()) place += ", clip " + rig.clip;
  return place;
}

std::string rigName(const ComparedRig& rig) { return rig.asked.empty() ? rig.spec : rig.spec + " " + rig.asked; }

/// Calls begin(place) for each object and row(rig) for each of its rigs.
template <class Begin, class Row>
void byObject(const Comparison& comparison, Begin begin, Row row) {
  std::vector<std::string> places;
  for (const ComparedRig& rig : comparison.rigs)
    if (std::ranges::find(places, placeOf(rig)) == places.end()) places.push_back(placeOf(rig));
  for (const std::string& place : places) {
    begin(place);
    for (const ComparedRig& rig : comparison.rigs)
      if (placeOf(rig) == place) row(rig);
  }
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char* tone(const RigFigure& figure, const std::optional<double>& ratio) {
  if (!ratio || figure.kind == RigFigure::Kind::size || std::abs(*ratio - 1) < kSame) return "";
  return *ratio > 1 ? " class=\"worse\"" : " class=\"better\"";
}

constexpr std::string_view kPage = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'">
<title>Rigel: runs side by side</title>
<style>
:root { color-scheme: light dark; --line: #8884; --worse: #b3261e; --better: #16703c; }
@media (prefers-color-scheme: dark) { :root { --worse: #ff8a80; --better: #69d08f; } }
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 90rem; padding: 1rem; }
h1 { font-size: 1.4rem; } h2 { font-size: 1.1rem; margin: 1.6rem 0 .4rem; overflow-wrap: anywhere; }
ol { padding-left: 1.4rem; } code { overflow-wrap: anywhere; }
.box { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: .25rem .6rem; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: Canvas; }
thead th { vertical-align: bottom; font-weight: 600; }
small { display: block; opacity: .75; }
.worse small { color: var(--worse); opacity: 1; } .better small { color: var(--better); opacity: 1; }
</style>
</head>
<body>
<main>
<h1>Runs side by side</h1>
<ol>
{{RUNS}}</ol>
<p>Each cell has the runs in this order, and how many times the first the others are. Errors are relative to the mean exact irradiance.</p>
{{TABLES}}</main>
</body>
</html>
)";

}  // namespace

std::string comparisonText(const Comparison& comparison) {
  std::string out;
  for (std::size_t run = 0; run < comparison.runs.size(); ++run)
    out += fmt::format("{} = {}\n", run + 1, printable(comparison.runs[run]));
  byObject(
      comparison, [&](const std::string& place) { out += fmt::format("\n{}\n", printable(place)); },
      [&](const ComparedRig& rig) {
        out += fmt::format("  {}\n", printable(rigName(rig)));
        for (std::size_t f = 0; f < rigFigures().size(); ++f) {
          const RigFigure& figure = rigFigures()[f];
          out += fmt::format("    {:<14}", figure.title);
          for (std::size_t run = 0; run < comparison.runs.size(); ++run) {
            out += fmt::format(" {:>10}", shown(figure, rig.values[f][run]));
            if (run > 0) out += fmt::format(" {:<6}", ratioText(rig.ratio(f, run)));
          }
          out.erase(out.find_last_not_of(' ') + 1);
          out += '\n';
        }
      });
  return out;
}

std::string comparisonMarkdown(const Comparison& comparison) {
  std::string out = "# Rigel runs side by side\n\n";
  for (std::size_t run = 0; run < comparison.runs.size(); ++run)
    out += fmt::format("{}. {}: {}\n", run + 1, markdownCell(comparison.runs[run]),
                       markdownCell(comparison.commands[run]));
  const auto begin = [&](const std::string& place) {
    out += fmt::format("\n## {}\n\n| rig |", markdownCell(place));
    std::string line = "\n|---|";
    for (const RigFigure& figure : rigFigures()) {
      out += fmt::format(" {} |", figure.title);
      line += "---:|";
    }
    out += line + "\n";
  };
  byObject(comparison, begin, [&](const ComparedRig& rig) {
    out += fmt::format("| {} |", markdownCell(rigName(rig)));
    for (std::size_t f = 0; f < rigFigures().size(); ++f) {
      const RigFigure& figure = rigFigures()[f];
      for (std::size_t run = 0; run < comparison.runs.size(); ++run) {
        out += fmt::format("{}{}", run > 0 ? " / " : " ", shown(figure, rig.values[f][run]));
        if (run > 0 && rig.ratio(f, run)) out += fmt::format(" ({})", ratioText(rig.ratio(f, run)));
      }
      out += " |";
    }
    out += '\n';
  });
  return out;
}

std::string comparisonCsv(const Comparison& comparison) {
  std::string out = "scene,clip,object,rig,asked,figure";
  for (const std::string& run : comparison.runs) out += "," + csvCell(run);
  for (std::size_t run = 1; run < comparison.runs.size(); ++run) out += "," + csvCell(comparison.runs[run] + " ratio");
  out += '\n';
  for (const ComparedRig& rig : comparison.rigs)
    for (std::size_t f = 0; f < rigFigures().size(); ++f) {
      for (const std::string* cell : {&rig.scene, &rig.clip, &rig.object, &rig.spec, &rig.asked})
        out += csvCell(*cell) + ",";
      out += rigFigures()[f].name;
      for (const auto& value : rig.values[f]) out += value ? fmt::format(",{}", *value) : ",";
      for (std::size_t run = 1; run < comparison.runs.size(); ++run) {
        const auto ratio = rig.ratio(f, run);
        out += ratio ? fmt::format(",{}", *ratio) : ",";
      }
      out += '\n';
    }
  return out;
}

std::string comparisonHtml(const Comparison& comparison) {
  std::string runs, tables;
  for (std::size_t run = 0; run < comparison.runs.size(); ++run)
    runs += fmt::format("<li>{}<br><code>{}</code></li>\n", escaped(comparison.runs[run]),
                        escaped(comparison.commands[run]));
  bool open = false;
  const auto begin = [&](const std::string& place) {
    if (open) tables += "</tbody></table></div>\n";
    open = true;
    tables +=
        fmt::format("<h2>{}</h2>\n<div class=\"box\" tabindex=\"0\"><table><thead><tr><th>rig</th>", escaped(place));
    for (const RigFigure& figure : rigFigures()) tables += fmt::format("<th>{}</th>", figure.title);
    tables += "</tr></thead><tbody>\n";
  };
  byObject(comparison, begin, [&](const ComparedRig& rig) {
    tables += fmt::format("<tr><td>{}<small>{}</small></td>", escaped(rig.spec), escaped(rig.asked));
    for (std::size_t f = 0; f < rigFigures().size(); ++f) {
      const RigFigure& figure = rigFigures()[f];
      const std::size_t last = comparison.runs.size() - 1;
      tables += fmt::format("<td{}>", tone(figure, rig.ratio(f, last)));
      std::string ratios;
      for (std::size_t run = 0; run <= last; ++run) {
        tables += fmt::format("{}{}", run > 0 ? " / " : "", shown(figure, rig.values[f][run]));
        if (run > 0) ratios += fmt::format("{}{}", run > 1 ? " / " : "", ratioText(rig.ratio(f, run)));
      }
      tables += fmt::format("<small>{}</small></td>", ratios);
    }
    tables += "</tr>\n";
  });
  if (open) tables += "</tbody></table></div>\n";
  return fillTemplate(kPage, {{"RUNS", runs}, {"TABLES", tables}});
}

Json comparisonJson(const Comparison& comparison, const std::vector<std::string>& worse) {
  Json rigs = Json::array();
  for (const ComparedRig& rig : comparison.rigs) {
    Json figures = Json::object();
    for (std::size_t f = 0; f < rigFigures().size(); ++f) {
      Json values = Json::array(), ratios = Json::array();
      for (std::size_t run = 0; run < comparison.runs.size(); ++run) {
        const auto &value = rig.values[f][run], ratio = rig.ratio(f, run);
        values.push_back(value ? Json(*value) : Json(nullptr));
        ratios.push_back(ratio ? Json(*ratio) : Json(nullptr));
      }
      figures[rigFigures()[f].name] = {{"values", values}, {"ratios", ratios}};
    }
    rigs.push_back({{"scene", rig.scene},
                    {"clip", rig.clip},
                    {"object", rig.object},
                    {"spec", rig.spec},
                    {"asked", rig.asked},
                    {"figures", figures}});
  }
  return {{"runs", comparison.runs}, {"rigs", rigs}, {"worsened", worse}};
}

}  // namespace rigel::tools
