#include "report/measure/parts_tally.h"

#include <algorithm>

namespace rigel::tools {
namespace {

double lit(double irradiance) { return std::max(0.0, irradiance); }

}  // namespace

void PartsTally::add(const ErrorSteps& steps) {
  for (std::size_t i = 0; i < steps.shaded.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double high = steps.highBand.empty() ? 0 : static_cast<double>(steps.highBand[i][c]);
      const auto shown = static_cast<double>(steps.shaded[i].rig[c]);
      const auto near = static_cast<double>(steps.shaded[i].near[c]);
      // Far light as it is seen after each step.
      const double exact = steps.exact[i][c] - steps.nearExact[i][c];
      const double bands = lit(steps.farBands[i][c] + high);
      const double sh = lit(static_cast<double>(steps.farSh[i][c]) + high);
      const double rig = lit(steps.rig[i][c] + high);
      const std::array<double, kErrorCauses> d = {near - steps.nearExact[i][c], bands - exact, sh - bands, rig - sh,
                                                  lit(shown) - rig};
      for (std::size_t j = 0; j < kErrorCauses; ++j)
        for (std::size_t k = j; k < kErrorCauses; ++k) products_[j][k] += d[j] * d[k];
      const double error = lit(shown) + near - steps.exact[i][c];
      const double unclamped = shown + near - steps.exact[i][c];
      total_ += error * error;
      unclamped_ += unclamped * unclamped;
    }
  }
  count_ += 3 * steps.shaded.size();
}

ErrorParts PartsTally::report(double meanIrradiance) const {
  const double scale = 1 / (meanIrradiance * meanIrradiance * static_cast<double>(count_));
  ErrorParts out;
  out.total = scale * total_;
  out.unclamped = scale * unclamped_;
  for (std::size_t j = 0; j < kErrorCauses; ++j) {
    out.parts[j].square = scale * products_[j][j];
    double along = 0;  // with every other cause
    for (std::size_t k = 0; k < kErrorCauses; ++k)
      if (k != j) along += products_[std::min(j, k)][std::max(j, k)];
    out.interaction += scale * along;
    out.parts[j].without = scale * std::max(0.0, total_ - products_[j][j] - 2 * along);
  }
  return out;
}

}  // namespace rigel::tools
