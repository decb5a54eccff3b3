// A logarithmic axis of a drawing.
#pragma once

#include <cmath>
#include <vector>

namespace rigel::tools {

struct LogAxis {
  double low = 1, high = 10;  // values at the ends; both positive
  double start = 0, end = 1;  // positions of the ends

  double operator()(double value) const { return start + (end - start) * std::log(value / low) / std::log(high / low); }

  /// 1, 2, 5 times powers of ten within the ends; 1 and 3 over more than 1.6 decades, 1 alone over more than 3.5.
  std::vector<double> ticks() const;
};

/// The axis that holds all positive values with a margin of `factor` on either side; a decade about 1 where none is.
LogAxis logAxis(const std::vector<double>& values, double factor, double start, double end);

}  // namespace rigel::tools
