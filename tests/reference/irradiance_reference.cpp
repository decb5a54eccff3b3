#include "reference/irradiance_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/smoothed_quadrature.h"
#include "reference/wrap_reference.h"

namespace rigel::reference {
namespace {

/// int_0^{2pi} f dphi over the circle at the angle psi from the light, in two symmetric halves cut where the circle
/// crosses the kernel's horizon.
double circle(double psi, double normalAngle, double a) {
  const double level = std::cos(psi) * std::cos(normalAngle);
  const double swing = std::sin(psi) * std::sin(normalAngle);
  const auto kernel = [&](double phi) { return wrapKernelReference(level + swing * std::cos(phi), a); };
  if (level + swing <= -a) return 0;
  // The kernel falls from phi = 0 (towards the normal) to phi = pi.
  const double end = level - swing >= -a ? M_PI : std::acos(std::clamp((-a - level) / swing, -1.0, 1.0));
  return end > 0 ? 2 * integrateSmoothed(kernel, 0.0, end) : 0.0;
}

}  // namespace

double capIrradianceReference(double alpha, double normalAngle, double a) {
  const auto ring = [&](double psi) { return std::sin(psi) * circle(psi, normalAngle, a); };
  // The circles that touch the horizon: there the integrand of psi has a kink.
  const double horizon = std::acos(-a);
  std::array<double, 5> cut = {0.0, std::min(alpha, std::abs(horizon - normalAngle)),
                               std::min(alpha, horizon + normalAngle),
                               std::min(alpha, 2 * M_PI - horizon - normalAngle), alpha};
  std::sort(cut.begin(), cut.end());
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    if (cut[i + 1] > cut[i]) sum += integrateSmoothed(ring, cut[i], cut[i + 1]);
  }
  return sum;
}

}  // namespace rigel::reference
