#include "report/formats/report_text.h"

#include "report/words/budget_words.h"
#include "report/words/verdict.h"
#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rigel::tools {
namespace {

using Row = std::vector<std::string>;

/// Characters on the terminal, taking every code point as one cell wide.
std::size_t width(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// First column to the left, the others (figures) to the right, two blanks between.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width(row[i]), ' ');
      text += "  ";
      text += i == 0 ? row[i] + padding : padding + row[i];
    }
    text += '\n';
  }
  return text;
}

std::string hundredths(double relative) { return fmt::format("{:.2f}", 100 * relative); }

/// A whole number where all frames have the same.
std::string mean(double count) { return fmt::format("{:.{}f}", count, count == std::floor(count) ? 0 : 1); }

Row figures(const RigReport& rig, bool chosen) {
  return {fmt::format("{} {}", chosen ? '>' : ' ', printable(rig.spec)),
          mean(rig.shVectors),
          mean(rig.nearLights),
          fmt::format("{}", rig.projections),
          hundredths(rig.spatial.rms),
          rig.estimate ? hundredths(*rig.estimate) : "-",
          hundredths(rig.spatial.max),
          hundredths(rig.total.rms),
          hundredths(rig.total.max),
          rig.maxJump ? hundredths(*rig.maxJump) : "-",
          fmt::format("{:.1f}", rig.fitMicroseconds),
          fmt::format("{:.1f}", rig.shadeNanosecondsPerPoint),
          fmt::format("{}", rig.bytes)};
}

std::string objectText(const SceneReport& scene, const ObjectReport& object) {
  std::string text = fmt::format("{} in {}", printable(object.name), printable(scene.scene));
  if (!scene.clip.empty()) text += fmt::format(", clip {}", printable(scene.clip));
  if (!scene.lightsFrom.empty()) text += fmt::format(", lights of {}", printable(scene.lightsFrom));
  text += fmt::format(": {} triangles, {} surface samples, {} frame{}\n", object.triangles, object.samples,
                      scene.frames, scene.frames == 1 ? "" : "s");
  const std::optional<Verdict> verdict = verdictOf(object);
  if (!verdict) return text;
  std::vector<Row> rows = {{"  rig", "SH vectors", "near lights", "projections", "spatial RMS %", "estimate %", "max %",
                            "total RMS %", "max %", "max jump %", "fit us", "shade ns/pt", "bytes"}};
  for (std::size_t i = 0; i < object.rigs.size(); ++i)
    rows.push_back(figures(object.rigs[i], verdict->advised && i == verdict->chosen));
  return fmt::format("{}{}  > {}\n", text, aligned(rows), printable(verdict->sentence));
}

/// What sharing a frame's time cost each object.
std::string budgetText(const SceneReport& scene, const SharedBudget& budget) {
  std::string text = fmt::format("  budget: {}\n", printable(budgetSentence(budget, scene.objects.size())));
  for (const ObjectReport& object : scene.objects) {
    for (const RigReport& rig : object.rigs) {
      if (rig.spec != budget.spec || givenUp(rig).empty()) continue;
      text += fmt::format("    {} gave up {}\n", printable(object.name), givenUp(rig));
    }
  }
  return text;
}

/// What became of the disks near the object: "auto, bust: 3 of 28 disks near at times (sconce 4, ...)".
std::string nearDisks(const DiskReport& disks, const ObjectReport& object, const std::string& rig) {
  constexpr std::size_t kNamed = 6;
  std::size_t all = 0;
  std::vector<std::string> near;
  for (const DiskUse& use : disks.uses) {
    if (use.object != object.name || use.rig != rig) continue;
    ++all;
    if (use.method.starts_with("near")) near.push_back(printable(use.light));
  }
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, near.size()); ++i) names += (i > 0 ? ", " : "") + near[i];
  if (near.size() > kNamed) names += ", ...";
  return fmt::format("    {} on {}: {} of {} disks near at times{}\n", printable(rig), printable(object.name),
                     near.size(), all, names.empty() ? "" : " (" + names + ")");
}

std::string diskText(const SceneReport& scene) {
  const DiskReport& disks = *scene.disks;
  std::string text = fmt::format(
      "  disk lights: {} pairs of a disk and a surface sample; irradiance relative to the peak there, SH to their "
      "norm\n",
      disks.pairs);
  std::vector<Row> rows = {{"  method", "SH RMS %", "max %", "irradiance RMS %", "max %", "ns"}};
  for (const DiskMethodRow& row : disks.methods) {
    rows.push_back({"  " + row.method, row.sh ? smallPercentage(row.sh->rms) : "-",
                    row.sh ? smallPercentage(row.sh->max) : "-", smallPercentage(row.irradiance.rms),
                    smallPercentage(row.irradiance.max), fmt::format("{:.1f}", row.nanoseconds)});
  }
  text += aligned(rows) + "  " + disks.choice + "\n";
  for (const ObjectReport& object : scene.objects)
    for (const RigReport& rig : object.rigs) text += nearDisks(disks, object, rig.spec);
  return text;
}

}  // namespace

std::string reportText(const Report& report) {
  std::string text;
  for (const SceneReport& scene : report.scenes) {
    for (const ObjectReport& object : scene.objects) {
      if (!text.empty()) text += '\n';
      text += objectText(scene, object);
    }
    for (const SharedBudget& budget : scene.budgets) text += budgetText(scene, budget);
    if (scene.disks) text += diskText(scene);
    for (const std::string& note : scene.notes) text += fmt::format("  note: {}\n", printable(note));
  }
  return text;
}

}  // namespace rigel::tools
