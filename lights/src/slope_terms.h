// How the derivative of SH by the point is put together from sums over lights. With w Y_lm = A+ Y_l+1 + A- Y_l-1 (sums
// over m' of sparse matrices, one an axis) the gradient of phi(d) Y_lm(w) is
//
//   (phi' - l phi/d) A+ Y_l+1  +  (phi' + (l+1) phi/d) A- Y_l-1,
//
// so that per band l two sums over lights do, G+_l of 2l+3 and G-_l of 2l-1 numbers, for the 3 (2l+1) of the gradient.
// Outside a sphere that nothing modulates G-_l = -(l-1)/l G+_(l-2): what is summed in its place is what is beyond that,
// X_l, for the few lights that have any.
#pragma once

#include <rigel/sh.h>

#include <array>
#include <cstddef>

#include "project_block.h"

namespace rigel::detail {

/// Numbers of a light at a point: of its SH; from kPlus on of G+, where that of Y_i of band 1 and more is kPlus + i -
/// 1; from kExcess on of X, that of Y_i kExcess + i.
template <int B>
struct SlopeNumbers {
  static constexpr int kPlus = B * B;
  static constexpr int kExcess = kPlus + (B + 1) * (B + 1) - 1;
  static constexpr int kAll = kExcess + (B - 1) * (B - 1);
};

constexpr double squareRoot(double x) {
  double root = x > 1 ? x : 1;
  for (int i = 0; i < 60; ++i) root = (root + x / root) / 2;
  return x > 0 ? root : 0;
}

/// The number of Y_lm' in axis * Y_lm, l' = l + 1 or l - 1; axis 0, 1, 2 for x, y, z.
constexpr double axisTimesY(int axis, int l, int m, int otherL, int otherM) {
  const int a = m < 0 ? -m : m, b = otherM < 0 ? -otherM : otherM;
  const bool up = otherL == l + 1;
  if (b > otherL || otherL < 0) return 0;
  const double odd = 2.0 * l + 1, norm = up ? odd * (odd + 2) : odd * (odd - 2);
  if (axis == 2) {
    if (otherM != m) return 0;
    const double k = up ? (l + 1.0) * (l + 1) - a * a : 1.0 * l * l - a * a;
    return squareRoot(k / norm);
  }
  if (b != a + 1 && b != a - 1) return 0;
  // sin(theta) times the polar part, of order a + 1 or a - 1.
  const double polar =
      b == a + 1 ? (up ? squareRoot((l + a + 1.0) * (l + a + 2) / norm) : -squareRoot((l - a) * (l - a - 1.0) / norm))
                 : (up ? -squareRoot((l - a + 1.0) * (l - a + 2) / norm) : squareRoot((l + a) * (l + a - 1.0) / norm));
  // cos(phi) or sin(phi) times cos or sin(a phi), which for a = 0 are normalised otherwise.
  const double half = a == 0 || b == 0 ? squareRoot(0.5) : 0.5;
  const bool sine = m < 0, otherSine = otherM < 0;
  if (axis == 0) {
    if (sine != otherSine) return 0;
    return half * polar;
  }
  if (sine == otherSine) return 0;
  if (!sine) return b == a + 1 ? half * polar : -half * polar;
  return b == a + 1 ? -half * polar : half * polar;
}

/// One product of the gradient: scale times the sum of a number.
struct SlopeTerm {
  int number = 0;
  float scale = 0;
};

/// The products of each output (axis * B^2 + i), from `begin` of it to that of the next.
template <int B>
struct SlopeTerms {
  std::array<SlopeTerm, 3 * B * B * 5> term{};
  std::array<std::size_t, 3 * B * B + 1> begin{};
};

/// Of G+, or of X.
template <int B>
constexpr SlopeTerms<B> slopeTerms(bool ofExcess) {
  SlopeTerms<B> out;
  std::size_t end = 0;
  const auto add = [&](int number, double scale) {
    if (scale * scale > 1e-20) out.term[end++] = {number, static_cast<float>(scale)};
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int l = 0; l < B; ++l)
      for (int m = -l; m <= l; ++m) {
        out.begin[static_cast<std::size_t>(axis * B * B + shIndex(l, m))] = end;
        for (int n = -l - 1; n <= l + 1 && !ofExcess; ++n) {
          const int k = shIndex(l + 1, n);
          add(SlopeNumbers<B>::kPlus + k - 1, 2 * kBasisScale[k] * axisTimesY(axis, l, m, l + 1, n));
        }
        for (int n = -l + 1; n <= l - 1; ++n) {
          const int k = shIndex(l - 1, n);
          const double scale = 2 * kBasisScale[k] * axisTimesY(axis, l, m, l - 1, n);
          if (ofExcess) add(SlopeNumbers<B>::kExcess + k, scale);
          if (!ofExcess && l > 1) add(SlopeNumbers<B>::kPlus + k - 1, -scale * (l - 1) / l);
        }
      }
  out.begin.back() = end;
  return out;
}

}  // namespace rigel::detail
