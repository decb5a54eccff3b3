#include <gtest/gtest.h>

#include <cmath>

#include "reference/worst.h"
#include "reference/wrap_reference.h"

namespace rigel::reference {
namespace {

constexpr double kTolerance = 1e-12;  // smoothed 60-point quadrature

TEST(WrapReference, MatchesThePublishedCoefficients) {
  Worst worst("wrap coefficients by quadrature against the published ones, absolute");
  for (const double a : {-0.75, -0.25, 0.0, 0.3, 0.5, 1.0}) {
    const double f0 = 2 * (1 + a) / (2 + a);
    const double f1 = 2 * f0 / (3 + a);
    const double f2 = ((1 + a) * f0 - 3 * a * f1) / (4 + a);
    const double f3 = -2 * a * (1 - a) * (1 + a) * (7 - 5 * a) / ((2 + a) * (3 + a) * (4 + a) * (5 + a));
    const double published[] = {f0, f1, f2, f3};
    for (int l = 0; l < 4; ++l) {
      const double actual = wrapCoefficientReference(l, a);
      worst.add(std::abs(actual - published[l]), [&] {
        return "a " + std::to_string(a) + ", l " + std::to_string(l) + ": " + std::to_string(actual) + ", expected " +
               std::to_string(published[l]);
      });
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(WrapReference, KernelIsLambertAtZeroAndHalfLambertAtOne) {
  for (const double x : {-1.0, -0.3, 0.0, 0.4, 1.0}) {
    EXPECT_DOUBLE_EQ(wrapKernelReference(x, 0), std::fmax(0, x));
    EXPECT_DOUBLE_EQ(wrapKernelReference(x, 1), (x + 1) * (x + 1) / 4);
  }
}

}  // namespace
}  // namespace rigel::reference
