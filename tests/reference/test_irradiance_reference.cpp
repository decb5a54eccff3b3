#include <gtest/gtest.h>

#include <cmath>

#include "reference/irradiance_reference.h"
#include "reference/wrap_reference.h"

namespace rigel::reference {
namespace {

constexpr double kTolerance = 1e-9;          // of pi; measured 2e-11
constexpr double kMidpointTolerance = 1e-6;  // of the cap's projected solid angle: what 1600 x 800 midpoints give

double fullSphere(double a) { return M_PI * 2 * (1 + a) / (2 + a); }

TEST(IrradianceReference, WhiteFurnaceGivesTheWholeKernel) {
  for (const double a : {-0.25, 0.0, 0.5, 1.0}) {
    for (const double angle : {0.0, 0.4, 1.5, 2.9, M_PI}) {
      EXPECT_NEAR(capIrradianceReference(M_PI, angle, a), fullSphere(a), kTolerance)
          << "a " << a << ", angle " << angle;
    }
  }
}

TEST(IrradianceReference, CapAndItsComplementMakeTheWhole) {
  for (const double a : {-0.25, 0.0, 0.5, 1.0}) {
    for (const double angle : {0.0, 0.3, 1.2, 1.9, 3.0}) {
      for (const double alpha : {0.01, 0.4, 1.1, 1.57}) {
        const double sum =
            capIrradianceReference(alpha, angle, a) + capIrradianceReference(M_PI - alpha, M_PI - angle, a);
        EXPECT_NEAR(sum, fullSphere(a), kTolerance) << "a " << a << ", angle " << angle << ", alpha " << alpha;
      }
    }
  }
}

TEST(IrradianceReference, LambertAboveTheHorizon) {
  for (const double alpha : {1e-6, 0.01, 0.4, 1.0}) {
    for (const double angle : {0.0, 0.2, 0.5}) {
      const double expected = M_PI * std::pow(std::sin(alpha), 2) * std::cos(angle);
      EXPECT_NEAR(capIrradianceReference(alpha, angle, 0), expected, kTolerance * M_PI * alpha * alpha)
          << "alpha " << alpha << ", angle " << angle;
    }
  }
}

// The plainest sum there is, on caps that cross the kernel's horizon.
TEST(IrradianceReference, MatchesAMidpointSum) {
  constexpr int kRings = 1600;
  constexpr int kSpokes = 800;
  for (const double a : {-0.25, 0.0, 0.5}) {
    for (const double alpha : {0.2, 0.9, 2.0}) {
      const double angle = std::acos(-a) - 0.3 * alpha;
      double sum = 0;
      for (int i = 0; i < kRings; ++i) {
        const double psi = alpha * (i + 0.5) / kRings;
        for (int j = 0; j < kSpokes; ++j) {
          const double phi = M_PI * (j + 0.5) / kSpokes;
          const double x = std::cos(psi) * std::cos(angle) + std::sin(psi) * std::sin(angle) * std::cos(phi);
          sum += wrapKernelReference(x, a) * std::sin(psi);
        }
      }
      sum *= alpha / kRings * 2 * M_PI / kSpokes;
      const double size = M_PI * std::pow(std::sin(std::fmin(alpha, M_PI / 2)), 2);
      EXPECT_NEAR(capIrradianceReference(alpha, angle, a), sum, kMidpointTolerance * size)
          << "a " << a << ", alpha " << alpha;
    }
  }
}

}  // namespace
}  // namespace rigel::reference
