// Real orthonormal spherical harmonics: storage types and basis evaluation for 2 to 5 bands.
//
// No Condon-Shortley sign; coefficient index l(l+1)+m; Y1 = sqrt(3/4pi) (y, z, x). "B bands" means l < B: 3 bands are 9
// coefficients. All vectors are in world axes.
#pragma once

#include <rigel/vec3.h>

#include <array>

namespace rigel {

inline constexpr int kMinBands = 2;
inline constexpr int kMaxBands = 5;
inline constexpr int kDefaultBands = 3;
inline constexpr double kPi = 3.14159265358979323846;

constexpr int shCount(int bands) noexcept { return bands * bands; }
constexpr int shIndex(int l, int m) noexcept { return l * (l + 1) + m; }

/// RGB coefficients of a function on the sphere; interleaved (coefficient major), 3 B^2 floats without padding.
/// `Tag` makes radiance and irradiance different types, so that neither pi nor f_l can be applied twice.
template <int B, class Tag>
struct ShRgb {
  static_assert(B >= kMinBands && B <= kMaxBands);
  static constexpr int kBands = B;
  static constexpr int kCount = shCount(B);

  std::array<Rgb, kCount> c{};

  Rgb& operator[](int i) noexcept { return c[i]; }
  const Rgb& operator[](int i) const noexcept { return c[i]; }
  float* data() noexcept { return &c[0].r; }
  const float* data() const noexcept { return &c[0].r; }

  ShRgb& operator+=(const ShRgb& o) noexcept {
    for (int i = 0; i < kCount; ++i) c[i] += o.c[i];
    return *this;
  }
  friend ShRgb operator*(const ShRgb& a, float s) noexcept {
    ShRgb out;
    for (int i = 0; i < kCount; ++i) out.c[i] = a.c[i] * s;
    return out;
  }
};

/// Incident radiance L(w) = sum L_lm Y_lm(w) [W/(m2 sr)].
template <int B>
using RadianceSH = ShRgb<B, struct RadianceTag>;

/// Irradiance E(n) = sum E_lm Y_lm(n) [W/m2]; made from radiance by `irradianceFromRadiance` (wrap.h).
template <int B>
using IrradianceSH = ShRgb<B, struct IrradianceTag>;

/// Spatial derivative of a RadianceSH by x, y and z [W/(m3 sr)].
template <int B>
struct RadianceShGradient {
  std::array<RadianceSH<B>, 3> d{};
};

/// Y_lm(w) of the unit vector `w` for l < B; `y` has B^2 entries. Unrolled polynomials, no branches.
template <int B>
void shBasis(Vec3 w, float* y) noexcept;

/// Y_lm(w) and the gradient of its extension to R^3 as the homogeneous polynomial r^l Y_lm, dy[i] = grad Y_i at the
/// unit vector `w`; w . dy[i] = l Y_i. Only the part of dy tangential to w is a property of Y itself; callers project
/// with (I - w w^T).
template <int B>
void shBasisGradient(Vec3 w, float* y, Vec3* dy) noexcept;

/// Value in direction `w` (unit): the dot product of coefficients and basis.
template <int B, class Tag>
Rgb evaluate(const ShRgb<B, Tag>& sh, Vec3 w) noexcept {
  float y[shCount(B)];
  shBasis<B>(w, y);
  Rgb sum;
  for (int i = 0; i < shCount(B); ++i) sum += sh[i] * y[i];
  return sum;
}

}  // namespace rigel
