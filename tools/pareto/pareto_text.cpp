#include "pareto/pareto_text.h"

#include "pareto/pareto_axes.h"
#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigel::tools {
namespace {

std::string frontOf(const ParetoObject& object) {
  std::string text = fmt::format("{:<58} {:>9} {:>9} {:>9} {:>10} {:>8}\n", "front: total error, fit and 10,000 points",
                                 "total", "spatial", "fit us", "shade ns", "bytes");
  for (const std::size_t i : paretoFront(compared(object.points, axisNamed("frame_us"), axisNamed("total_rms")))) {
    const ParetoPoint& p = object.points[i];
    text += fmt::format("{:<58} {:>9} {:>9} {:>9.1f} {:>10.0f} {:>8}\n", p.arguments, percent(p.total.rms),
                        percent(p.spatial.rms), p.fitMicroseconds.value_or(0), p.shadeNanoseconds.value_or(0), p.bytes);
  }
  return text;
}

std::string autoOf(const ParetoObject& object) {
  const int bands = comparedBands(object.points);
  double worst = 1;
  std::string which;
  for (const char* error : {"total_rms", "spatial_rms"}) {
    const auto all = compared(object.points, axisNamed("modelled_ns_per_point"), axisNamed(error));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const ParetoPoint& p = object.points[i];
      if (p.family != "auto" || p.near != "auto" || !isCompared(p, bands)) continue;
      // What it aims at is what it is judged by.
      if (p.target.starts_with("--total") != (std::string_view(error) == "total_rms")) continue;
      if (const double distance = distanceToFront(all[i], all).nearest(); distance > worst)
        worst = distance, which = p.arguments;
    }
  }
  if (which.empty()) return "auto is on the front of what it aims at, by the cost model\n";
  return fmt::format("auto is within {:.0f} % of the front of what it aims at, by the cost model (farthest: {})\n",
                     100 * (worst - 1), which);
}

}  // namespace

std::string frontText(const Pareto& pareto) {
  std::string text;
  for (const ParetoObject& object : pareto.objects) {
    text +=
        fmt::format("{}: {} points, {} frames\n", printable(object.name), object.points.size(), pareto.frames.size());
    text += frontOf(object);
    if (std::ranges::any_of(object.points, [](const ParetoPoint& p) { return p.family == "auto"; }))
      text += autoOf(object);
    text += '\n';
  }
  for (const std::string& note : pareto.notes) text += "note: " + printable(note) + '\n';
  return text;
}

}  // namespace rigel::tools
