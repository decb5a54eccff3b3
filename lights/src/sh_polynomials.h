// The real SH of bands 0 to 4 as polynomials of the unit vector, unrolled; shared by the basis and the projections,
// which inline them. They are kept homogeneous, r^l Y_lm, with r^2 = x^2 + y^2 + z^2 where r = 1 could be put in: the
// rounding of w's length then scales a band as a whole and nothing cancels near the poles, half the float error of the
// usual form. P.-P. Sloan, "Efficient Spherical Harmonic Evaluation", JCGT 2013, has the grouping by powers of z.
#pragma once

#include <rigel/sh.h>
#include <rigel/shader_constants.h>

namespace rigel::detail {

template <int B>
inline void basisPolynomials(Vec3 w, float* out) noexcept {
  const float x = w.x, y = w.y, z = w.z;
  const auto k = [](double constant) { return static_cast<float>(constant); };

  out[0] = k(kRigelY00);
  out[1] = k(kRigelY1) * y;
  out[2] = k(kRigelY1) * z;
  out[3] = k(kRigelY1) * x;
  if constexpr (B > 2) {
    const float zz = z * z, tt = x * x + y * y, xy2 = 2 * x * y,
                xxyy = (x - y) * (x + y);  // sin and cos of 2 phi times sin^2 theta
    out[4] = k(kRigelY22) * xy2;
    out[5] = k(kRigelY21) * y * z;
    out[6] = k(kRigelY20) * (2 * zz - tt);
    out[7] = k(kRigelY21) * x * z;
    out[8] = k(kRigelY22) * xxyy;
    if constexpr (B > 3) {
      const float s3 = x * xy2 + y * xxyy, c3 = x * xxyy - y * xy2;  // of 3 phi
      const float f31 = k(kRigelY31) * (4 * zz - tt);
      out[9] = k(kRigelY33) * s3;
      out[10] = k(kRigelY32) * z * xy2;
      out[11] = f31 * y;
      out[12] = k(kRigelY30) * z * (2 * zz - 3 * tt);
      out[13] = f31 * x;
      out[14] = k(kRigelY32) * z * xxyy;
      out[15] = k(kRigelY33) * c3;
      if constexpr (B > 4) {
        const float f41 = k(kRigelY41) * z * (4 * zz - 3 * tt), f42 = k(kRigelY42) * (6 * zz - tt),
                    f43 = k(kRigelY43) * z;
        out[16] = k(kRigelY44) * 2 * xy2 * xxyy;
        out[17] = f43 * s3;
        out[18] = f42 * xy2;
        out[19] = f41 * y;
        out[20] = k(kRigelY40) * (8 * zz * (zz - 3 * tt) + 3 * tt * tt);
        out[21] = f41 * x;
        out[22] = f42 * xxyy;
        out[23] = f43 * c3;
        out[24] = k(kRigelY44) * (xxyy - xy2) * (xxyy + xy2);
      }
    }
  }
}

/// grad (r^l Y_lm) at w.
template <int B>
inline void basisGradientPolynomials(Vec3 w, Vec3* out) noexcept {
  const float x = w.x, y = w.y, z = w.z;
  const auto k = [](double constant) { return static_cast<float>(constant); };

  out[0] = {0, 0, 0};
  out[1] = {0, k(kRigelY1), 0};
  out[2] = {0, 0, k(kRigelY1)};
  out[3] = {k(kRigelY1), 0, 0};
  if constexpr (B > 2) {
    const float zz = z * z, tt = x * x + y * y, xy2 = 2 * x * y, xxyy = (x - y) * (x + y);
    const float k20 = 2 * k(kRigelY20);
    out[4] = {k(kRigelY21) * y, k(kRigelY21) * x, 0};
    out[5] = {0, k(kRigelY21) * z, k(kRigelY21) * y};
    out[6] = {-k20 * x, -k20 * y, 2 * k20 * z};
    out[7] = {k(kRigelY21) * z, 0, k(kRigelY21) * x};
    out[8] = {k(kRigelY21) * x, -k(kRigelY21) * y, 0};
    if constexpr (B > 3) {
      const float s3 = x * xy2 + y * xxyy, c3 = x * xxyy - y * xy2;
      const float k33 = 3 * k(kRigelY33), k32 = 2 * k(kRigelY32), k31 = k(kRigelY31), k30 = 3 * k(kRigelY30);
      const float f31 = 4 * zz - tt;
      out[9] = {k33 * xy2, k33 * xxyy, 0};
      out[10] = {k32 * y * z, k32 * x * z, k(kRigelY32) * xy2};
      out[11] = {-k31 * xy2, k31 * (f31 - 2 * y * y), 8 * k31 * y * z};
      out[12] = {-2 * k30 * x * z, -2 * k30 * y * z, k30 * (2 * zz - tt)};
      out[13] = {k31 * (f31 - 2 * x * x), -k31 * xy2, 8 * k31 * x * z};
      out[14] = {k32 * x * z, -k32 * y * z, k(kRigelY32) * xxyy};
      out[15] = {k33 * xxyy, -k33 * xy2, 0};
      if constexpr (B > 4) {
        const float k41 = k(kRigelY41), k42 = 2 * k(kRigelY42), k40 = k(kRigelY40), f43 = 3 * k(kRigelY43) * z,
                    f44 = 4 * k(kRigelY44);
        const float f41 = 4 * zz - 3 * tt, g41 = 3 * k41 * (4 * zz - tt);
        const float f42 = 6 * zz - tt, f40 = 12 * k40 * (tt - 4 * zz);
        out[16] = {f44 * s3, f44 * c3, 0};
        out[17] = {f43 * xy2, f43 * xxyy, k(kRigelY43) * s3};
        out[18] = {k42 * y * (f42 - 2 * x * x), k42 * x * (f42 - 2 * y * y), 6 * k42 * z * xy2};
        out[19] = {-3 * k41 * z * xy2, k41 * z * (f41 - 6 * y * y), g41 * y};
        out[20] = {f40 * x, f40 * y, 16 * k40 * z * (2 * zz - 3 * tt)};
        out[21] = {k41 * z * (f41 - 6 * x * x), -3 * k41 * z * xy2, g41 * x};
        out[22] = {k42 * x * (f42 - xxyy), -k42 * y * (f42 + xxyy), 6 * k42 * z * xxyy};
        out[23] = {f43 * xxyy, -f43 * xy2, k(kRigelY43) * c3};
        out[24] = {f44 * c3, -f44 * s3, 0};
      }
    }
  }
}

}  // namespace rigel::detail
