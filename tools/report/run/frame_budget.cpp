#include "report/run/frame_budget.h"

#include <algorithm>
#include <numeric>

namespace rigel::tools {

void FrameBudget::measure(std::span<ObjectRun> runs, const LightSet& lights) {
  std::vector<RigRunner*> rigs;
  for (ObjectRun& run : runs) rigs.push_back(&run.rig(rig_));
  std::vector<BudgetShare> shares(rigs.size());
  const auto light = [&](float seconds) {
    for (ObjectRun& run : runs) run.pose(rig_);
    lightWithin(budget_, rigs, lights, seconds, shares);
  };
  light(runs.front().secondsAFrame());
  double used = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].compareShared(rig_, lights, shares[i].granted);
    used += static_cast<double>(rigs[i]->modelledMicroseconds());
  }
  used_.push_back(used);
  for (int i = 0; i < runs.front().timings(); ++i) {
    light(ObjectRun::kNoTime);
    for (ObjectRun& run : runs) run.time(rig_);
  }
}

SharedBudget FrameBudget::report(const RunOptions& options) const {
  SharedBudget out;
  out.spec = options.rigs[rig_].text;
  if (options.target) out.goal = static_cast<double>(options.target->value);
  out.budget = static_cast<double>(budget_);
  out.mean = std::accumulate(used_.begin(), used_.end(), 0.0) / static_cast<double>(used_.size());
  out.most = *std::ranges::max_element(used_);
  out.framesOver = static_cast<int>(
      std::ranges::count_if(used_, [&](double used) { return used > (1 + kBudgetSlack) * out.budget; }));
  return out;
}

}  // namespace rigel::tools
