#include "report/view3d/view3d_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rigel::tools {
namespace {

// What a view must have to be worth a look.
constexpr std::size_t kLeastVertices = 1000;
constexpr std::size_t kLeastFrames = 4;
constexpr std::size_t kFewestVertices = 64;
// Vertices come before frames up to here.
constexpr std::size_t kGoodVertices = 4500;
// What deflating and base64 make of recorded bytes; a view that turns out larger loses frames (view3d_json).
constexpr double kPacked = 0.8;
constexpr std::size_t kLightsPart = 10;  // of a scene's bytes one in so many is for its lights

std::size_t quotient(double a, double b) { return static_cast<std::size_t>(std::max(0.0, a / b)); }

/// Bytes recorded for a vertex: triangles and a position once; in each frame truth, position and the rigs' errors.
double bytesOfVertex(std::size_t frames, std::size_t rigs) {
  return 18 + static_cast<double>(frames) * (9 + 3 * static_cast<double>(rigs));
}

}  // namespace

std::vector<std::size_t> spread(std::size_t all, std::size_t count) {
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < count; ++k)
    frames.push_back(count == 1 ? 0 : (k * (all - 1) + (count - 1) / 2) / (count - 1));
  return frames;
}

ViewBudget shareOf(const ViewBudget& budget, std::size_t scenes) {
  const std::size_t shares = std::max<std::size_t>(1, scenes);
  return {budget.bytes / shares, budget.evaluations / shares, std::max<std::size_t>(1, budget.objects / shares)};
}

ViewPlan planViews(const ViewDemand& demand, const ViewBudget& budget) {
  ViewPlan plan;
  if (demand.frames == 0) return plan;
  const double bytes = static_cast<double>(budget.bytes - budget.bytes / kLightsPart) / kPacked;
  const double evaluations =
      static_cast<double>(budget.evaluations) / static_cast<double>(std::max<std::size_t>(1, demand.evaluations));
  const auto vertices = [&](std::size_t objects, std::size_t frames) {
    const double views = static_cast<double>(objects);
    return std::min({kViewVertices, quotient(bytes, views * bytesOfVertex(frames, demand.rigs)),
                     quotient(evaluations, views * static_cast<double>(frames))});
  };
  const std::size_t least = std::min(kLeastFrames, demand.frames);
  std::size_t objects = std::min(budget.objects, demand.errors.size());
  while (objects > 1 && vertices(objects, least) < kLeastVertices) --objects;
  std::size_t frames = std::min(kViewFrames, demand.frames);
  while (frames > least && vertices(objects, frames) < kGoodVertices) --frames;
  while (frames > 1 && vertices(objects, frames) < kFewestVertices) --frames;
  if (objects == 0 || vertices(objects, frames) < kFewestVertices) return plan;

  plan.vertices = vertices(objects, frames);
  plan.bytes = (budget.bytes - budget.bytes / kLightsPart) / objects;
  std::vector<std::size_t> worst(demand.errors.size());
  std::iota(worst.begin(), worst.end(), 0u);
  std::ranges::stable_sort(worst, [&](std::size_t a, std::size_t b) { return demand.errors[a] > demand.errors[b]; });
  worst.resize(objects);
  plan.objects = worst;
  std::ranges::sort(plan.objects);

  plan.frames = spread(demand.frames, frames);
  // The frames in which the shown objects are worst take the place of their neighbours, but leave most as they are.
  for (std::size_t i = 0; i < std::min(objects, frames / 4); ++i) {
    const std::size_t wanted = demand.worstFrames[worst[i]];
    const auto away = [&](std::size_t f) { return f > wanted ? f - wanted : wanted - f; };
    *std::ranges::min_element(plan.frames, {}, away) = wanted;
  }
  std::ranges::sort(plan.frames);
  plan.frames.erase(std::unique(plan.frames.begin(), plan.frames.end()), plan.frames.end());
  return plan;
}

}  // namespace rigel::tools
