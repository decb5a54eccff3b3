#include "report/words/verdict.h"

#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace rigel::tools {
namespace {

/// SH vectors alone do not say what a point costs where some rigs leave lights to exact evaluation.
bool modelledTimeCounts(const ObjectReport& object) {
  return std::ranges::any_of(object.rigs, [](const RigReport& rig) { return rig.nearLights > 0; });
}

/// "12 SH vectors"; where near lights are about "3.4 SH vectors and 1.2 near lights, 72 ns a point by the cost model".
std::string costOf(const ObjectReport& object, std::size_t index) {
  const RigReport& rig = object.rigs[index];
  std::string text = counted(rig.shVectors, "SH vector");
  if (rig.nearLights > 0) text += " and " + counted(rig.nearLights, "near light");
  if (modelledTimeCounts(object)) text += fmt::format(", {:.0f} ns a point by the cost model", rig.modelledNanoseconds);
  return text;
}

std::string sentenceFor(const ObjectReport& object, const Verdict& verdict) {
  const RigReport& chosen = object.rigs[verdict.chosen];
  const RigReport& best = object.rigs[verdict.best];
  const std::string figures =
      fmt::format("total RMS {}, spatial RMS {}", percent(chosen.total.rms), percent(chosen.spatial.rms));
  if (object.meanIrradiance <= 0) return "No light reaches this object, so no rig is better than another.";
  if (!verdict.advised)
    return fmt::format(
        "No rig lights this object well, most likely because a light comes very close: the least error is "
        "that of {} ({}), {}.",
        best.spec, costOf(object, verdict.best), figures);
  if (object.rigs.size() == 1)
    return fmt::format("Only {} was measured ({}): {}.", chosen.spec, costOf(object, verdict.chosen), figures);
  if (verdict.chosen == verdict.best)
    return fmt::format("{} has the least error, and no rig within {:.0f} % of it is cheaper ({}): {}.", chosen.spec,
                       100 * kVerdictSlack, costOf(object, verdict.chosen), figures);
  return fmt::format(
      "{} is the cheapest rig ({}) within {:.0f} % of the least error: {}, against {} and {} for {} ({}).", chosen.spec,
      costOf(object, verdict.chosen), 100 * kVerdictSlack, figures, percent(best.total.rms), percent(best.spatial.rms),
      best.spec, costOf(object, verdict.best));
}

}  // namespace

std::optional<Verdict> verdictOf(const ObjectReport& object) {
  if (object.rigs.empty()) return std::nullopt;
  Verdict verdict;
  for (std::size_t i = 1; i < object.rigs.size(); ++i)
    if (object.rigs[i].total.rms < object.rigs[verdict.best].total.rms) verdict.best = i;

  const bool near = modelledTimeCounts(object);
  const auto cost = [&](std::size_t i) {
    const RigReport& rig = object.rigs[i];
    return std::tuple(near ? rig.modelledNanoseconds : rig.shVectors, rig.projections, rig.total.rms);
  };
  const double limit = (1 + kVerdictSlack) * object.rigs[verdict.best].total.rms;
  verdict.chosen = verdict.best;
  for (std::size_t i = 0; i < object.rigs.size(); ++i)
    if (object.rigs[i].total.rms <= limit && cost(i) < cost(verdict.chosen)) verdict.chosen = i;
  verdict.advised = object.meanIrradiance > 0 && object.rigs[verdict.best].total.rms <= kUsableError;
  if (!verdict.advised) verdict.chosen = verdict.best;
  verdict.sentence = sentenceFor(object, verdict);
  return verdict;
}

}  // namespace rigel::tools
