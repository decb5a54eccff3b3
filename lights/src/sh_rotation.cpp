// SH rotation matrices band by band, each from the band below and the 3x3 rotation.
//
// Based on J. Ivanic, K. Ruedenberg, "Rotation Matrices for Real Spherical Harmonics. Direct Determination by
// Recursion", J. Phys. Chem. 100 (1996) 6342, Table 1 and 2, with the additions and corrections of 102 (1998) 9099:
//
//   R^l_mn = u U + v V + w W,   U, V, W sums of P_i(m, n) = products of the 3x3 rotation and R^(l-1).
#include <rigel/sh_rotation.h>

#include <cmath>
#include <cstdlib>

namespace rigel {
namespace {

/// R^l of one band, indices -l..l.
struct BandMatrix {
  int l = 0;
  double entry[2 * kMaxBands - 1][2 * kMaxBands - 1] = {};

  double operator()(int m, int n) const noexcept { return entry[m + l][n + l]; }
};

/// R^1: the rotation itself in the order (y, z, x) of Y1.
BandMatrix firstBand(const Rotation& r) noexcept {
  constexpr int kAxis[3] = {1, 2, 0};
  BandMatrix band;
  band.l = 1;
  for (int m = 0; m < 3; ++m) {
    for (int n = 0; n < 3; ++n) band.entry[m][n] = r.m[kAxis[m]][kAxis[n]];
  }
  return band;
}

/// P_i(m, n) of band `below.l + 1` (Table 2 of the paper).
double product(const BandMatrix& first, const BandMatrix& below, int i, int m, int n) noexcept {
  const int edge = below.l;
  if (n > edge) return first(i, 1) * below(m, edge) - first(i, -1) * below(m, -edge);
  if (n < -edge) return first(i, 1) * below(m, -edge) + first(i, -1) * below(m, edge);
  return first(i, 0) * below(m, n);
}

double entryOf(const BandMatrix& first, const BandMatrix& below, int m, int n) noexcept {
  const int l = below.l + 1;
  const int am = std::abs(m);
  const double denominator = std::abs(n) == l ? 2 * l * (2 * l - 1) : (l + n) * (l - n);
  const auto p = [&](int i, int row) { return product(first, below, i, row, n); };
  const double root2 = std::sqrt(2.0);

  double sum = 0;
  // Each factor vanishes exactly where its products would reach outside the band below.
  if (am < l) sum += std::sqrt((l + m) * (l - m) / denominator) * p(0, m);

  const double v = 0.5 * std::sqrt((l + am - 1) * (l + am) / denominator);
  if (m == 0) {
    sum -= v * root2 * (p(1, 1) + p(-1, -1));
  } else if (m == 1) {
    sum += v * root2 * p(1, 0);
  } else if (m == -1) {
    sum += v * root2 * p(-1, 0);
  } else if (m > 0) {
    sum += v * (p(1, m - 1) - p(-1, -m + 1));
  } else {
    sum += v * (p(1, m + 1) + p(-1, -m - 1));
  }

  if (m != 0 && am < l - 1) {
    const double w = 0.5 * std::sqrt((l - am - 1) * (l - am) / denominator);
    sum -= w * (m > 0 ? p(1, m + 1) + p(-1, -m - 1) : p(1, m - 1) - p(-1, -m + 1));
  }
  return sum;
}

BandMatrix nextBand(const BandMatrix& first, const BandMatrix& below) noexcept {
  BandMatrix band;
  band.l = below.l + 1;
  for (int m = -band.l; m <= band.l; ++m) {
    for (int n = -band.l; n <= band.l; ++n) band.entry[m + band.l][n + band.l] = entryOf(first, below, m, n);
  }
  return band;
}

}  // namespace

template <int B>
ShRotation<B>::ShRotation(const Rotation& r) noexcept {
  float* out = entries_;
  *out++ = 1;
  const BandMatrix first = firstBand(r);
  BandMatrix band = first;
  for (int l = 1; l < B; ++l) {
    if (l > 1) band = nextBand(first, band);
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) *out++ = static_cast<float>(band(m, n));
    }
  }
}

template <int B, class Tag>
void addZonal(ShRgb<B, Tag>& sh, const std::type_identity_t<std::array<float, B>>& zonal, Vec3 axis,
              Rgb colour) noexcept {
  float y[shCount(B)];
  shBasis<B>(axis, y);
  for (int l = 0; l < B; ++l) {
    const float turned = static_cast<float>(std::sqrt(4 * kPi / (2 * l + 1))) * zonal[l];
    for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) sh[i] += colour * (turned * y[i]);
  }
}

template class ShRotation<2>;
template class ShRotation<3>;
template class ShRotation<4>;
template class ShRotation<5>;

template void addZonal(ShRgb<2, RadianceTag>&, const std::array<float, 2>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<3, RadianceTag>&, const std::array<float, 3>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<4, RadianceTag>&, const std::array<float, 4>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<5, RadianceTag>&, const std::array<float, 5>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<2, IrradianceTag>&, const std::array<float, 2>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<3, IrradianceTag>&, const std::array<float, 3>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<4, IrradianceTag>&, const std::array<float, 4>&, Vec3, Rgb) noexcept;
template void addZonal(ShRgb<5, IrradianceTag>&, const std::array<float, 5>&, Vec3, Rgb) noexcept;

}  // namespace rigel
