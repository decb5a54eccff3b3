// The real SH of bands 0 to 4 as polynomials of the unit vector, unrolled; shared by the basis and the projections,
// which inline them. They are kept homogeneous, r^l Y_lm, with r^2 = x^2 + y^2 + z^2 where r = 1 could be put in: the
// rounding of w's length then scales a band as a whole and nothing cancels near the poles, half the float error of the
// usual form. P.-P. Sloan, "Efficient Spherical Harmonic Evaluation", JCGT 2013, has the grouping by powers of z.
#pragma once

#include <rigel/sh.h>

namespace rigel::detail {

// K_lm of the normalised polynomials; the trailing comment is the closed form.
inline constexpr double kY00 = 0.28209479177387814347;  // sqrt(1/4pi)
inline constexpr double kY1 = 0.48860251190291992159;   // sqrt(3/4pi)
inline constexpr double kY20 = 0.31539156525252000603;  // sqrt(5/16pi)
inline constexpr double kY21 = 1.09254843059207907054;  // sqrt(15/4pi)
inline constexpr double kY22 = 0.54627421529603953527;  // sqrt(15/16pi)
inline constexpr double kY30 = 0.37317633259011539141;  // sqrt(7/16pi)
inline constexpr double kY31 = 0.45704579946446573616;  // sqrt(21/32pi)
inline constexpr double kY32 = 1.44530572132027702965;  // sqrt(105/16pi)
inline constexpr double kY33 = 0.59004358992664351035;  // sqrt(35/32pi)
inline constexpr double kY40 = 0.10578554691520430380;  // sqrt(9/256pi)
inline constexpr double kY41 = 0.66904654355728916799;  // sqrt(45/32pi)
inline constexpr double kY42 = 0.47308734787878000908;  // sqrt(45/64pi)
inline constexpr double kY43 = 1.77013076977993053104;  // sqrt(315/32pi)
inline constexpr double kY44 = 0.62583573544917613459;  // sqrt(315/256pi)

template <int B>
inline void basisPolynomials(Vec3 w, float* out) noexcept {
  const float x = w.x, y = w.y, z = w.z;
  const auto k = [](double constant) { return static_cast<float>(constant); };

  out[0] = k(kY00);
  out[1] = k(kY1) * y;
  out[2] = k(kY1) * z;
  out[3] = k(kY1) * x;
  if constexpr (B > 2) {
    const float zz = z * z, tt = x * x + y * y, xy2 = 2 * x * y,
                xxyy = (x - y) * (x + y);  // sin and cos of 2 phi times sin^2 theta
    out[4] = k(kY22) * xy2;
    out[5] = k(kY21) * y * z;
    out[6] = k(kY20) * (2 * zz - tt);
    out[7] = k(kY21) * x * z;
    out[8] = k(kY22) * xxyy;
    if constexpr (B > 3) {
      const float s3 = x * xy2 + y * xxyy, c3 = x * xxyy - y * xy2;  // of 3 phi
      const float f31 = k(kY31) * (4 * zz - tt);
      out[9] = k(kY33) * s3;
      out[10] = k(kY32) * z * xy2;
      out[11] = f31 * y;
      out[12] = k(kY30) * z * (2 * zz - 3 * tt);
      out[13] = f31 * x;
      out[14] = k(kY32) * z * xxyy;
      out[15] = k(kY33) * c3;
      if constexpr (B > 4) {
        const float f41 = k(kY41) * z * (4 * zz - 3 * tt), f42 = k(kY42) * (6 * zz - tt), f43 = k(kY43) * z;
        out[16] = k(kY44) * 2 * xy2 * xxyy;
        out[17] = f43 * s3;
        out[18] = f42 * xy2;
        out[19] = f41 * y;
        out[20] = k(kY40) * (8 * zz * (zz - 3 * tt) + 3 * tt * tt);
        out[21] = f41 * x;
        out[22] = f42 * xxyy;
        out[23] = f43 * c3;
        out[24] = k(kY44) * (xxyy - xy2) * (xxyy + xy2);
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
  out[1] = {0, k(kY1), 0};
  out[2] = {0, 0, k(kY1)};
  out[3] = {k(kY1), 0, 0};
  if constexpr (B > 2) {
    const float zz = z * z, tt = x * x + y * y, xy2 = 2 * x * y, xxyy = (x - y) * (x + y);
    const float k20 = 2 * k(kY20);
    out[4] = {k(kY21) * y, k(kY21) * x, 0};
    out[5] = {0, k(kY21) * z, k(kY21) * y};
    out[6] = {-k20 * x, -k20 * y, 2 * k20 * z};
    out[7] = {k(kY21) * z, 0, k(kY21) * x};
    out[8] = {k(kY21) * x, -k(kY21) * y, 0};
    if constexpr (B > 3) {
      const float s3 = x * xy2 + y * xxyy, c3 = x * xxyy - y * xy2;
      const float k33 = 3 * k(kY33), k32 = 2 * k(kY32), k31 = k(kY31), k30 = 3 * k(kY30);
      const float f31 = 4 * zz - tt;
      out[9] = {k33 * xy2, k33 * xxyy, 0};
      out[10] = {k32 * y * z, k32 * x * z, k(kY32) * xy2};
      out[11] = {-k31 * xy2, k31 * (f31 - 2 * y * y), 8 * k31 * y * z};
      out[12] = {-2 * k30 * x * z, -2 * k30 * y * z, k30 * (2 * zz - tt)};
      out[13] = {k31 * (f31 - 2 * x * x), -k31 * xy2, 8 * k31 * x * z};
      out[14] = {k32 * x * z, -k32 * y * z, k(kY32) * xxyy};
      out[15] = {k33 * xxyy, -k33 * xy2, 0};
      if constexpr (B > 4) {
        const float k41 = k(kY41), k42 = 2 * k(kY42), k40 = k(kY40), f43 = 3 * k(kY43) * z, f44 = 4 * k(kY44);
        const float f41 = 4 * zz - 3 * tt, g41 = 3 * k41 * (4 * zz - tt);
        const float f42 = 6 * zz - tt, f40 = 12 * k40 * (tt - 4 * zz);
        out[16] = {f44 * s3, f44 * c3, 0};
        out[17] = {f43 * xy2, f43 * xxyy, k(kY43) * s3};
        out[18] = {k42 * y * (f42 - 2 * x * x), k42 * x * (f42 - 2 * y * y), 6 * k42 * z * xy2};
        out[19] = {-3 * k41 * z * xy2, k41 * z * (f41 - 6 * y * y), g41 * y};
        out[20] = {f40 * x, f40 * y, 16 * k40 * z * (2 * zz - 3 * tt)};
        out[21] = {k41 * z * (f41 - 6 * x * x), -3 * k41 * z * xy2, g41 * x};
        out[22] = {k42 * x * (f42 - xxyy), -k42 * y * (f42 + xxyy), 6 * k42 * z * xxyy};
        out[23] = {f43 * xxyy, -f43 * xy2, k(kY43) * c3};
        out[24] = {f44 * c3, -f44 * s3, 0};
      }
    }
  }
}

}  // namespace rigel::detail
