#include <rigel/light_budget.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel {
namespace {

constexpr int kBisections = 20;
constexpr float kFinestError = 1e-3f;  // where the search for the common error begins

}  // namespace

template <int B>
BudgetOutcome lightWithinBudget(std::span<ObjectLighting<B>* const> objects, std::span<const float> visibility,
                                const LightSet& lights, float microseconds, float seconds,
                                std::span<BudgetShare> shares) {
  assert(shares.size() == objects.size() && (visibility.empty() || visibility.size() == objects.size()));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i]->weigh(lights);
    shares[i].wanted = objects[i]->options().target.value;
  }
  const auto seen = [&](std::size_t i) { return visibility.empty() ? 1.0f : std::max(visibility[i], 1e-6f); };
  const auto grant = [&](float visibleError) {
    float sum = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      shares[i].granted = std::max(shares[i].wanted, std::min(visibleError / seen(i), kGiveUpError));
      const auto points = static_cast<float>(objects[i]->options().points);
      shares[i].microseconds = objects[i]->costAt(shares[i].granted) * points / 1000;
      sum += shares[i].microseconds;
    }
    return sum;
  };

  BudgetOutcome outcome;
  outcome.microseconds = grant(0);
  if (outcome.microseconds > microseconds) {
    float most = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) most = std::max(most, kGiveUpError * seen(i));
    // The logarithm is bisected: errors of 2 % and 200 % are to be found equally well.
    float low = std::log(kFinestError), high = std::log(most);
    for (int i = 0; i < kBisections; ++i) {
      const float middle = 0.5f * (low + high);
      (grant(std::exp(middle)) > microseconds ? low : high) = middle;
    }
    outcome.largestError = std::exp(high);
    outcome.microseconds = grant(outcome.largestError);
  }
  outcome.met = outcome.microseconds <= microseconds;
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
