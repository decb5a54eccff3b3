#include "report/words/budget_words.h"

#include "report/words/wording.h"

#include <fmt/format.h>

#include <cmath>

namespace rigel::tools {
namespace {

/// Errors that differ by less are the same to the eye, and to the choice that led to them.
constexpr double kSame = 1.02;

std::string insteadOf(double number, double alone, std::string_view one) {
  constexpr double kSameCount = 0.05;
  if (std::abs(number - alone) < kSameCount) return "the same " + counted(number, one);
  return fmt::format("{} instead of {:.{}f}", counted(number, one), alone, alone == std::floor(alone) ? 0 : 1);
}

}  // namespace

bool gaveUp(const RigReport& rig) {
  return rig.budget && rig.budget->alone && rig.total.rms > kSame * rig.budget->alone->totalRms;
}

std::string givenUp(const RigReport& rig) {
  if (!rig.budget || !rig.budget->alone) return "";
  if (!gaveUp(rig)) return "nothing";
  const BudgetUse::Alone& alone = *rig.budget->alone;
  return fmt::format("total RMS {} instead of {} with the frame to itself; {}, {}", percent(rig.total.rms),
                     percent(alone.totalRms), insteadOf(rig.shVectors, alone.shVectors, "SH vector"),
                     insteadOf(rig.nearLights, alone.nearLights, "near light"));
}

std::string budgetSentence(const SharedBudget& budget, std::size_t objects) {
  std::string text =
      fmt::format("{:.0f} us a frame for {} lit by {}: {:.0f} us on average, {:.0f} us at most", budget.budget,
                  counted(static_cast<double>(objects), "object"), budget.spec, budget.mean, budget.most);
  if (budget.framesOver > 0)
    text += fmt::format("; too long in {}", counted(static_cast<double>(budget.framesOver), "frame"));
  return text +
         (budget.goal ? fmt::format("; no object takes more than an error of {} needs.", percent(*budget.goal)) : ".");
}

}  // namespace rigel::tools
