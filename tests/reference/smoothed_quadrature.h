// Quadrature of functions that are smooth inside an interval and behave as any power at its ends: a fixed rule, so that
// noise in the integrand (another integral) cannot keep it refining.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

namespace rigel::reference {

/// Integral of `f` over [lo, hi]: x = lo + (hi - lo) S(u) with the polynomial S whose first four derivatives vanish at
/// 0 and 1, then 60-point Gauss-Legendre in u. An end that behaves as x^p costs no accuracy for p > 0: it becomes
/// u^(5p+4).
template <class Function>
double integrateSmoothed(const Function& f, double lo, double hi) {
  using Gauss = boost::math::quadrature::gauss<double, 60>;
  return Gauss::integrate(
      [&](double u) {
        const double v = 1 - u;
        // Each half from its own end: near the end the distance from it keeps its digits, and x stays inside.
        const double t = std::min(u, v);
        const double step = t * t * t * t * t * (126 + t * (-420 + t * (540 + t * (-315 + t * 70))));
        const double slope = 630 * u * u * u * u * v * v * v * v;
        return f(u < v ? lo + (hi - lo) * step : hi - (hi - lo) * step) * (hi - lo) * slope;
      },
      0.0, 1.0);
}

}  // namespace rigel::reference
