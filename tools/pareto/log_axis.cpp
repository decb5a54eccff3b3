#include "pareto/log_axis.h"

#include <algorithm>
#include <limits>

namespace rigel::tools {

std::vector<double> LogAxis::ticks() const {
  constexpr double kRounding = 1 + 1e-9;
  const double decades = std::log10(high / low);
  const std::vector<double> factors = decades > 3.5   ? std::vector<double>{1}
                                      : decades > 1.6 ? std::vector<double>{1, 3}
                                                      : std::vector<double>{1, 2, 5};
  std::vector<double> all;
  for (int exponent = static_cast<int>(std::floor(std::log10(low))); std::pow(10, exponent) <= high; ++exponent)
    for (const double factor : factors) {
      const double tick = factor * std::pow(10, exponent);
      if (tick * kRounding >= low && tick <= high * kRounding) all.push_back(tick);
    }
  return all;
}

LogAxis logAxis(const std::vector<double>& values, double factor, double start, double end) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(high > 0)) low = high = 1, factor = std::sqrt(10.0);
  return {low / factor, high * factor, start, end};
}

}  // namespace rigel::tools
