// Rotation of SH vectors and zonal (rotationally symmetric) forms.
#pragma once

#include <rigel/sh.h>

#include <type_traits>

namespace rigel {

/// Row-major 3x3 rotation: rotated = R * v.
struct Rotation {
  float m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// Block-diagonal SH rotation, built once per rotation and applied to many vectors. After J. Ivanic, K. Ruedenberg,
/// "Rotation Matrices for Real Spherical Harmonics", J. Phys. Chem. 1996 (with the 1998 erratum).
template <int B>
class ShRotation {
 public:
  explicit ShRotation(const Rotation& r) noexcept;

  /// The SH of w -> f(R^-1 w). `in` and the result may not alias.
  template <class Tag>
  ShRgb<B, Tag> operator()(const ShRgb<B, Tag>& in) const noexcept {
    ShRgb<B, Tag> out;
    const float* row = entries_;
    for (int l = 0; l < B; ++l) {
      for (int m = -l; m <= l; ++m) {
        Rgb sum;
        for (int k = -l; k <= l; ++k) sum += in[shIndex(l, k)] * *row++;
        out[shIndex(l, m)] = sum;
      }
    }
    return out;
  }

 private:
  // sum over l < B of (2l+1)^2 entries, band after band, row major.
  float entries_[B * (4 * B * B - 1) / 3];
};

/// Adds `colour` * sum_l zonal[l] Y_l0 turned from +z to the unit vector `axis`: coefficient lm grows by
/// colour * sqrt(4pi/(2l+1)) zonal[l] Y_lm(axis).
template <int B, class Tag>
void addZonal(ShRgb<B, Tag>& sh, const std::type_identity_t<std::array<float, B>>& zonal, Vec3 axis,
              Rgb colour) noexcept;

}  // namespace rigel
