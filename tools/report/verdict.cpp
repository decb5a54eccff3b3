#include "report/verdict.h"

#include <fmt/format.h>

#include <tuple>

namespace rigel::tools {
namespace {

std::string vectors(const RigReport& rig) {
  return fmt::format("{} SH vector{}", rig.shVectors, rig.shVectors == 1 ? "" : "s");
}

/// Three digits, as the page writes them.
std::string percent(double relative) {
  const double value = 100 * relative;
  return value >= 99.95 || value == 0 ? fmt::format("{:.0f} %", value) : fmt::format("{:#.3g} %", value);
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
        best.spec, vectors(best), figures);
  if (object.rigs.size() == 1)
    return fmt::format("Only {} was measured ({}): {}.", chosen.spec, vectors(chosen), figures);
  if (verdict.chosen == verdict.best)
    return fmt::format("{} has the least error, and no rig within {:.0f} % of it is cheaper ({}): {}.", chosen.spec,
                       100 * kVerdictSlack, vectors(chosen), figures);
  return fmt::format(
      "{} is the cheapest rig ({}) within {:.0f} % of the least error: {}, against {} and {} for {} ({}).", chosen.spec,
      vectors(chosen), 100 * kVerdictSlack, figures, percent(best.total.rms), percent(best.spatial.rms), best.spec,
      vectors(best));
}

}  // namespace

std::optional<Verdict> verdictOf(const ObjectReport& object) {
  if (object.rigs.empty()) return std::nullopt;
  Verdict verdict;
  for (std::size_t i = 1; i < object.rigs.size(); ++i)
    if (object.rigs[i].total.rms < object.rigs[verdict.best].total.rms) verdict.best = i;

  const auto cost = [&](std::size_t i) {
    const RigReport& rig = object.rigs[i];
    return std::tuple(rig.shVectors, rig.projections, rig.total.rms);
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
