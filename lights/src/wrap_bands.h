// The wrap kernel's convolution coefficients in double.
#pragma once

#include <rigel/wrap.h>

namespace rigel::detail {

/// f_l(a), l < B; see wrapCoefficients.
template <int B>
inline void wrapBands(float wrap, double* f) noexcept {
  const double a = clampWrap(wrap);
  f[0] = 2 * (1 + a) / (2 + a);
  f[1] = 2 * f[0] / (3 + a);
  for (int l = 1; l + 1 < B; ++l) f[l + 1] = ((2 + a - l) * f[l - 1] - (2 * l + 1) * a * f[l]) / (l + 3 + a);
}

}  // namespace rigel::detail
