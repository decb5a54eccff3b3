#include "pareto/pareto_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

bool measured(CostAndError p) { return std::isfinite(p.cost) && std::isfinite(p.error); }

/// 1 where there is nothing better; infinite where the best is 0 and this is not.
double excess(double value, double best) {
  if (!(best < value)) return 1;
  return best > 0 ? value / best : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<std::size_t> paretoFront(std::span<const CostAndError> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (measured(points[i])) order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (!front.empty()) {
      const CostAndError& last = points[front.back()];
      const bool twin = points[i].cost == last.cost && points[i].error == last.error;
      if (!twin && !(points[i].error < last.error)) continue;
    }
    front.push_back(i);
  }
  return front;
}

FrontDistance distanceToFront(CostAndError point, std::span<const CostAndError> others) {
  double leastCost = point.cost, leastError = point.error;
  for (const CostAndError& other : others) {
    if (!measured(other)) continue;
    if (other.error <= point.error) leastCost = std::min(leastCost, other.cost);
    if (other.cost <= point.cost) leastError = std::min(leastError, other.error);
  }
  return {excess(point.cost, leastCost), excess(point.error, leastError)};
}

}  // namespace rigel::tools
