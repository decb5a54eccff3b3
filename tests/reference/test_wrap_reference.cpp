#include <gtest/gtest.h>

#include <cmath>

#include "reference/wrap_reference.h"

namespace rigel::reference {
namespace {

constexpr double kTolerance = 1e-12;  // smoothed 60-point quadrature; measured 3e-15

TEST(WrapReference, MatchesThePublishedCoefficients) {
  for (const double a : {-0.75, -0.25, 0.0, 0.3, 0.5, 1.0}) {
    const double f0 = 2 * (1 + a) / (2 + a);
    EXPECT_NEAR(wrapCoefficientReference(0, a), f0, kTolerance) << "a " << a;
    EXPECT_NEAR(wrapCoefficientReference(1, a), 2 * f0 / (3 + a), kTolerance) << "a " << a;
    const double f3 = -2 * a * (1 - a) * (1 + a) * (7 - 5 * a) / ((2 + a) * (3 + a) * (4 + a) * (5 + a));
    EXPECT_NEAR(wrapCoefficientReference(3, a), f3, kTolerance) << "a " << a;
  }
}

TEST(WrapReference, KernelIsLambertAtZeroAndHalfLambertAtOne) {
  for (const double x : {-1.0, -0.3, 0.0, 0.4, 1.0}) {
    EXPECT_DOUBLE_EQ(wrapKernelReference(x, 0), std::fmax(0, x));
    EXPECT_DOUBLE_EQ(wrapKernelReference(x, 1), (x + 1) * (x + 1) / 4);
  }
}

}  // namespace
}  // namespace rigel::reference
