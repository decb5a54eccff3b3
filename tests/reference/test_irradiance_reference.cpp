#include <gtest/gtest.h>

#include <cmath>

#include "reference/irradiance_reference.h"
#include "reference/worst.h"
#include "reference/wrap_reference.h"

namespace rigel::reference {
namespace {

constexpr double kTolerance = 1e-9;          // absolute, of values up to 4pi/3
constexpr double kMidpointTolerance = 1e-6;  // of the cap's projected solid angle: what 1600 x 800 midpoints give

double fullSphere(double a) { return M_PI * 2 * (1 + a) / (2 + a); }

TEST(IrradianceReference, WhiteFurnaceGivesTheWholeKernel) {
  Worst worst("white furnace, absolute");
  for (const double a : {-0.25, 0.0, 0.5, 1.0}) {
    for (const double angle : {0.0, 0.4, 1.5, 2.9, M_PI}) {
      worst.add(std::abs(capIrradianceReference(M_PI, angle, a) - fullSphere(a)),
                [&] { return "a " + std::to_string(a) + ", angle " + std::to_string(angle); });
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(IrradianceReference, CapAndItsComplementMakeTheWhole) {
  Worst worst("cap and complement against the whole, absolute");
  for (const double a : {-0.25, 0.0, 0.5, 1.0}) {
    for (const double angle : {0.0, 0.3, 1.2, 1.9, 3.0}) {
      for (const double alpha : {0.01, 0.4, 1.1, 1.57}) {
        const double sum =
            capIrradianceReference(alpha, angle, a) + capIrradianceReference(M_PI - alpha, M_PI - angle, a);
        worst.add(std::abs(sum - fullSphere(a)), [&] {
          return "a " + std::to_string(a) + ", angle " + std::to_string(angle) + ", alpha " + std::to_string(alpha);
        });
      }
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(IrradianceReference, LambertAboveTheHorizon) {
  Worst worst("Lambert above the horizon, relative to its peak");
  for (const double alpha : {1e-6, 0.01, 0.4, 1.0}) {
    for (const double angle : {0.0, 0.2, 0.5}) {
      const double expected = M_PI * std::pow(std::sin(alpha), 2) * std::cos(angle);
      worst.add(std::abs(capIrradianceReference(alpha, angle, 0) - expected) / (M_PI * std::pow(std::sin(alpha), 2)),
                [&] { return "alpha " + std::to_string(alpha) + ", angle " + std::to_string(angle); });
    }
  }
  worst.expectWithin(kTolerance);
}

// The plainest sum there is, on caps that cross the kernel's horizon.
TEST(IrradianceReference, MatchesAMidpointSum) {
  Worst worst("midpoint sum, relative to the solid angle");
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
      worst.add(std::abs(capIrradianceReference(alpha, angle, a) - sum) / size,
                [&] { return "a " + std::to_string(a) + ", alpha " + std::to_string(alpha); });
    }
  }
  worst.expectWithin(kMidpointTolerance);
}

}  // namespace
}  // namespace rigel::reference
