#include <rigel/light_budget.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel {
namespace {

constexpr int kBisections = 20;
constexpr float kLeastVisibility = 1e-6f;

/// Grants every object what it wants, or the error that shows as much as `visibleError`. Returns the microseconds.
float grant(std::span<BudgetShare> shares, TargetCost cost, float visibleError) {
  float sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    BudgetShare& share = shares[i];
    const float error = visibleError / std::max(share.visibility, kLeastVisibility);
    share.granted = std::max(share.wanted, std::min(error, kGiveUpError));
    share.microseconds = cost.at(cost.context, i, share.granted) * share.points / 1000;
    sum += share.microseconds;
  }
  return sum;
}

}  // namespace

BudgetOutcome spreadBudget(std::span<BudgetShare> shares, TargetCost cost, float microseconds) {
  float late = 0;
  for (const BudgetShare& share : shares) late += share.late;
  const float free = std::clamp(microseconds - late, (1 - kMostLate) * microseconds, microseconds);
  BudgetOutcome outcome;
  outcome.microseconds = grant(shares, cost, 0);
  if (outcome.microseconds > free) {
    float most = 0;
    for (const BudgetShare& share : shares)
      most = std::max(most, kGiveUpError * std::max(share.visibility, kLeastVisibility));
    // The logarithm is bisected: errors of 2 % and 200 % are to be found equally well.
    float low = std::log(std::min(kLeastError, most)), high = std::log(most);
    for (int i = 0; i < kBisections; ++i) {
      const float middle = 0.5f * (low + high);
      (grant(shares, cost, std::exp(middle)) > free ? low : high) = middle;
    }
    outcome.largestError = std::exp(high);
    outcome.microseconds = grant(shares, cost, outcome.largestError);
  }
  outcome.met = outcome.microseconds <= microseconds;
  return outcome;
}

template <int B>
BudgetOutcome lightWithinBudget(std::span<ObjectLighting<B>* const> objects, std::span<const float> visibility,
                                const LightSet& lights, float microseconds, float seconds,
                                std::span<BudgetShare> shares) {
  assert(shares.size() == objects.size() && (visibility.empty() || visibility.size() == objects.size()));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i]->weigh(lights, seconds);
    const LightingOptions& options = objects[i]->options();
    shares[i].wanted = options.target.value;
    shares[i].visibility = visibility.empty() ? 1 : visibility[i];
    shares[i].points = static_cast<float>(options.points);
    shares[i].late = objects[i]->lateNanoseconds() * shares[i].points / 1000;
  }
  const auto costAt = [](void* all, std::size_t i, float target) {
    return (*static_cast<std::span<ObjectLighting<B>* const>*>(all))[i]->costAt(target);
  };
  const BudgetOutcome outcome = spreadBudget(shares, {costAt, &objects}, microseconds);
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i]->settle(lights, shares[i].granted, seconds);
  return outcome;
}

#define RIGEL_INSTANTIATE(B)                                                                               \
  template BudgetOutcome lightWithinBudget<B>(std::span<ObjectLighting<B>* const>, std::span<const float>, \
                                              const LightSet&, float, float, std::span<BudgetShare>);
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
