// Quadrature in double without allocation: adaptive Gauss-Kronrod, and the trapezoidal rule for what is periodic.
//
// Gauss-Kronrod rule (7, 15) and error estimate after R. Piessens et al., "QUADPACK", Springer 1983 (routine QK15).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rigel::detail {

struct Integral {
  double value = 0;
  double error = 0;
};

/// One 15-point panel over [lo, hi].
template <class Function>
Integral gaussKronrod15(const Function& f, double lo, double hi) noexcept {
  // Positive Kronrod nodes, outermost first; the odd entries are the Gauss nodes, the last one is the centre.
  constexpr std::array<double, 8> kNode = {0.991455371120812639206854697526, 0.949107912342758524526189684048,
                                           0.864864423359769072789712788641, 0.741531185599394439863864773281,
                                           0.586087235467691130294144691694, 0.405845151377397166906606412077,
                                           0.207784955007898467600689403773, 0.0};
  constexpr std::array<double, 8> kKronrod = {0.022935322010529224963732008059, 0.063092092629978553290700663189,
                                              0.104790010322250183839876322542, 0.140653259715525918745189590510,
                                              0.169004726639267902826583426599, 0.190350578064785409913256402421,
                                              0.204432940075298892414161999235, 0.209482141084727828012999174892};
  constexpr std::array<double, 4> kGauss = {0.129484966168869693270611432679, 0.279705391489276667901467771424,
                                            0.381830050505118944950369775489, 0.417959183673469387755102040816};
  const double centre = 0.5 * (lo + hi);
  const double half = 0.5 * (hi - lo);

  std::array<double, 15> value;
  double kronrod = 0;
  double gauss = 0;
  for (int i = 0; i < 7; ++i) {
    value[2 * i] = f(centre - half * kNode[i]);
    value[2 * i + 1] = f(centre + half * kNode[i]);
    const double pair = value[2 * i] + value[2 * i + 1];
    kronrod += kKronrod[i] * pair;
    if (i % 2 == 1) gauss += kGauss[i / 2] * pair;
  }
  value[14] = f(centre);
  kronrod += kKronrod[7] * value[14];
  gauss += kGauss[3] * value[14];

  // The difference of the two rules is the error of the weaker one; QUADPACK's power law, scaled by how much the
  // integrand varies, turns it into an estimate for the stronger.
  double variation = kKronrod[7] * std::abs(value[14] - 0.5 * kronrod);
  for (int i = 0; i < 7; ++i) {
    variation += kKronrod[i] * (std::abs(value[2 * i] - 0.5 * kronrod) + std::abs(value[2 * i + 1] - 0.5 * kronrod));
  }
  variation *= std::abs(half);
  double error = std::abs((kronrod - gauss) * half);
  if (variation > 0) {
    const double ratio = 200 * error / variation;
    error = variation * std::min(1.0, ratio * std::sqrt(ratio));
  }
  return {kronrod * half, error};
}

/// Integral of `f` over [lo, hi], bisected until the estimate of every panel is within the absolute `tolerance`, at
/// most `maxDepth` times. The estimates are cautious: the error of the sum stays below the tolerance of one panel.
template <class Function>
double integrateAdaptive(const Function& f, double lo, double hi, double tolerance, int maxDepth = 14) noexcept {
  const Integral panel = gaussKronrod15(f, lo, hi);
  if (!(panel.error > tolerance) || maxDepth == 0) return panel.value;
  const double middle = 0.5 * (lo + hi);
  return integrateAdaptive(f, lo, middle, tolerance, maxDepth - 1) +
         integrateAdaptive(f, middle, hi, tolerance, maxDepth - 1);
}

/// Integral over [lo, hi] of a function whose mirrored continuation is smooth and periodic, `ends` the mean of its
/// values at the ends: there the trapezoidal rule converges faster than any power. Doubles from 4 intervals, up to 64,
/// until the change between the last sums, falling on as it fell before, is within `tolerance`; empty where it never
/// is.
template <class Function>
std::optional<double> integratePeriodic(const Function& f, double lo, double hi, double tolerance,
                                        double ends = 0) noexcept {
  double step = 0.25 * (hi - lo);
  double sum = ends + f(lo + step) + f(lo + 2 * step) + f(lo + 3 * step);
  double lastChange = 0;
  for (int intervals = 4; intervals < 64; intervals *= 2) {
    double between = 0;
    for (int i = 0; i < intervals; ++i) between += f(lo + (i + 0.5) * step);
    const double coarse = sum * step;
    sum += between;
    step *= 0.5;
    const double value = sum * step;
    double change = std::abs(value - coarse);
    if (lastChange == 0) {
      if (change <= tolerance) return value;
    } else {
      // Two sums that agree by chance are not believed: a doubling gains a factor of 1000 at most.
      change = std::max(change, 1e-3 * lastChange);
      if (change * std::min(1.0, change / lastChange) <= tolerance) return value;
    }
    lastChange = change;
  }
  return std::nullopt;
}

}  // namespace rigel::detail
