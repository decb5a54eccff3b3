#include "reference/sh_reference.h"

#include <cstdlib>

namespace rigel::reference {
namespace {

/// P_l^m(z) / sin^m(theta), which is a polynomial in z.
Real50 associatedLegendreOverSine(int l, int m, const Real50& z) {
  Real50 diagonal = 1;
  for (int k = 1; k <= m; ++k) diagonal *= 2 * k - 1;
  Real50 previous = 0;
  Real50 current = diagonal;
  for (int k = m + 1; k <= l; ++k) {
    const Real50 next = ((2 * k - 1) * z * current - (k + m - 1) * previous) / (k - m);
    previous = current;
    current = next;
  }
  return current;
}

}  // namespace

Real50 shReference(int l, int m, const Vec50& w) {
  const int am = std::abs(m);
  // (x + i y)^m = sin^m(theta) (cos(m phi) + i sin(m phi))
  Real50 re = 1;
  Real50 im = 0;
  for (int k = 0; k < am; ++k) {
    const Real50 nextRe = re * w.x - im * w.y;
    im = re * w.y + im * w.x;
    re = nextRe;
  }
  Real50 factorials = 1;  // (l+m)!/(l-m)!
  for (int k = l - am + 1; k <= l + am; ++k) factorials *= k;
  const Real50 norm = sqrt((2 * l + 1) / (4 * pi50() * factorials));
  const Real50 azimuth = m == 0 ? Real50(1) : sqrt(Real50(2)) * (m > 0 ? re : im);
  return norm * associatedLegendreOverSine(l, am, w.z) * azimuth;
}

Real50 legendreReference(int l, const Real50& x) { return associatedLegendreOverSine(l, 0, x); }

}  // namespace rigel::reference
