// SH and wrap in double precision, from definitions that share nothing with the shaders' polynomials.
#pragma once

#include <rigel/sh.h>

#include <cmath>
#include <vector>

namespace rigel::test {

/// sqrt((2l+1)/4pi): what no Y_lm of a band exceeds in absolute value, save by sqrt 2.
inline double bandScale(int l) { return std::sqrt((2 * l + 1) / (4 * M_PI)); }

/// r^l Y_lm(w / r), r = |w|, for l < bands: w as it is, rounding of its length included.
inline std::vector<double> shDouble(Vec3 w, int bands) {
  const double x = w.x, y = w.y, z = w.z;
  const double r = std::sqrt(x * x + y * y + z * z);
  const double phi = std::atan2(y, x);
  std::vector<double> out(static_cast<std::size_t>(shCount(bands)));
  for (int l = 0; l < bands; ++l) {
    for (int m = 0; m <= l; ++m) {
      double ratio = 1;  // (l-m)!/(l+m)!
      for (int k = l - m + 1; k <= l + m; ++k) ratio /= k;
      const double k = bandScale(l) * std::sqrt(ratio * (m == 0 ? 1 : 2)) * std::pow(r, l);
      const double p = std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(m), z / r);
      out[static_cast<std::size_t>(shIndex(l, m))] = k * p * std::cos(m * phi);
      if (m > 0) out[static_cast<std::size_t>(shIndex(l, -m))] = k * p * std::sin(m * phi);
    }
  }
  return out;
}

inline int bandOf(int index) { return static_cast<int>(std::sqrt(static_cast<double>(index) + 0.5)); }

/// f_l(a) by Sloan's recurrence.
inline std::array<double, 5> wrapCoefficientsDouble(double a) {
  std::array<double, 5> f;
  f[0] = 2 * (1 + a) / (2 + a);
  f[1] = 2 * f[0] / (3 + a);
  for (std::size_t l = 1; l < 4; ++l) {
    const auto n = static_cast<double>(l);
    f[l + 1] = ((2 + a - n) * f[l - 1] - (2 * n + 1) * a * f[l]) / (n + 3 + a);
  }
  return f;
}

}  // namespace rigel::test
