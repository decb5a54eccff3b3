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

/// Numbers of a light at a point: of its SH, of G+ by band, of X by band.
template <int B>
struct SlopeNumbers {
  static constexpr int kPlus = B * B;
  static constexpr int kExcess = kPlus + (B + 1) * (B + 1) - 1;
  static constexpr int kAll = kExcess + (B - 1) * (B - 1);
  /// Y_(l+1)m' in G+_l, and Y_(l-1)m' in X_l.
  static constexpr int plus(int l, int i) { return kPlus + i - 1 + 0 * l; }
  static constexpr int excess(int i) { return kExcess + i; }
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

/// One product of the gradient: output (axis * B^2 + i) += scale * sum of `number`.
struct SlopeTerm {
  int output = 0, number = 0;
  float scale = 0;
};

/// Constants of the basis, as the kernels' polynomials leave them out (lane_polynomials.h).
inline constexpr double kBasisScale[] = {kRigelY00,
                                         kRigelY1,
                                         kRigelY1,
                                         kRigelY1,
                                         2 * kRigelY22,
                                         kRigelY21,
                                         kRigelY20,
                                         kRigelY21,
                                         kRigelY22,
                                         kRigelY33,
                                         kRigelY32,
                                         kRigelY31,
                                         kRigelY30,
                                         kRigelY31,
                                         kRigelY32,
                                         kRigelY33,
                                         2 * kRigelY44,
                                         kRigelY43,
                                         kRigelY42,
                                         kRigelY41,
                                         kRigelY40,
                                         kRigelY41,
                                         kRigelY42,
                                         kRigelY43,
                                         kRigelY44,
                                         0.65638205684017010281,
                                         2.07566231488104106,
                                         0.48923829943525038768,
                                         2.39676839248666199,
                                         0.45294665119569692130,
                                         0.11695032245342359644,
                                         0.45294665119569692130,
                                         2.39676839248666199,
                                         0.48923829943525038768,
                                         2.07566231488104106,
                                         0.65638205684017010281};

template <int B>
struct SlopeTerms {
  std::array<SlopeTerm, 3 * B * B * 6> term{};
  std::size_t ordinary = 0, all = 0;  // those of G+ alone, then those of X
};

template <int B>
constexpr SlopeTerms<B> slopeTerms() {
  SlopeTerms<B> out;
  const auto add = [&](int axis, int i, int number, double scale) {
    if (scale * scale > 1e-20) out.term[out.all++] = {axis * B * B + i, number, static_cast<float>(scale)};
  };
  for (const bool excess : {false, true}) {
    for (int axis = 0; axis < 3; ++axis)
      for (int l = 0; l < B; ++l)
        for (int m = -l; m <= l; ++m) {
          const int i = shIndex(l, m);
          for (int k = shIndex(l + 1, -l - 1); !excess && k <= shIndex(l + 1, l + 1); ++k)
            add(axis, i, SlopeNumbers<B>::kPlus + k - 1,
                2 * kBasisScale[k] * axisTimesY(axis, l, m, l + 1, k - shIndex(l + 1, 0)));
          if (l == 0) continue;
          for (int k = shIndex(l - 1, -l + 1); k <= shIndex(l - 1, l - 1); ++k) {
            const double scale = 2 * kBasisScale[k] * axisTimesY(axis, l, m, l - 1, k - shIndex(l - 1, 0));
            if (excess) add(axis, i, SlopeNumbers<B>::kExcess + k, scale);
            if (!excess && l > 1) add(axis, i, SlopeNumbers<B>::kPlus + k - 1, -scale * (l - 1) / l);
          }
        }
    if (!excess) out.ordinary = out.all;
  }
  return out;
}

}  // namespace rigel::detail
