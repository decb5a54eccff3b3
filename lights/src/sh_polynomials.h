// The real SH of bands 0 to 4 as polynomials of the unit vector, unrolled; shared by the basis and the projections,
// which inline them. P.-P. Sloan, "Efficient Spherical Harmonic Evaluation", JCGT 2013, gives the same grouping by
// powers of z.
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
    const float zz = z * z, xy2 = 2 * x * y, xxyy = (x - y) * (x + y);  // sin and cos of 2 phi times sin^2 theta
    out[4] = k(kY22) * xy2;
    out[5] = k(kY21) * y * z;
    out[6] = k(kY20) * (3 * zz - 1);
    out[7] = k(kY21) * x * z;
    out[8] = k(kY22) * xxyy;
    if constexpr (B > 3) {
      const float s3 = x * xy2 + y * xxyy, c3 = x * xxyy - y * xy2;  // of 3 phi
      const float f31 = k(kY31) * (5 * zz - 1);
      out[9] = k(kY33) * s3;
      out[10] = k(kY32) * z * xy2;
      out[11] = f31 * y;
      out[12] = k(kY30) * z * (5 * zz - 3);
      out[13] = f31 * x;
      out[14] = k(kY32) * z * xxyy;
      out[15] = k(kY33) * c3;
      if constexpr (B > 4) {
        const float f41 = k(kY41) * z * (7 * zz - 3), f42 = k(kY42) * (7 * zz - 1), f43 = k(kY43) * z;
        out[16] = k(kY44) * 2 * xy2 * xxyy;
        out[17] = f43 * s3;
        out[18] = f42 * xy2;
        out[19] = f41 * y;
        out[20] = k(kY40) * (zz * (35 * zz - 30) + 3);
        out[21] = f41 * x;
        out[22] = f42 * xxyy;
        out[23] = f43 * c3;
        out[24] = k(kY44) * (xxyy - xy2) * (xxyy + xy2);
      }
    }
  }
}

template <int B>
inline void basisGradientPolynomials(Vec3 w, Vec3* out) noexcept {
  const float x = w.x, y = w.y, z = w.z;
  const auto k = [](double constant) { return static_cast<float>(constant); };

  out[0] = {0, 0, 0};
  out[1] = {0, k(kY1), 0};
  out[2] = {0, 0, k(kY1)};
  out[3] = {k(kY1), 0, 0};
  if constexpr (B > 2) {
    const float zz = z * z, xy2 = 2 * x * y, xxyy = (x - y) * (x + y);
    out[4] = {k(kY21) * y, k(kY21) * x, 0};
    out[5] = {0, k(kY21) * z, k(kY21) * y};
    out[6] = {0, 0, 6 * k(kY20) * z};
    out[7] = {k(kY21) * z, 0, k(kY21) * x};
    out[8] = {k(kY21) * x, -k(kY21) * y, 0};
    if constexpr (B > 3) {
      const float s3 = x * xy2 + y * xxyy, c3 = x * xxyy - y * xy2;
      const float f31 = k(kY31) * (5 * zz - 1), k33 = 3 * k(kY33), k32 = 2 * k(kY32), k31 = 10 * k(kY31) * z;
      out[9] = {k33 * xy2, k33 * xxyy, 0};
      out[10] = {k32 * y * z, k32 * x * z, k(kY32) * xy2};
      out[11] = {0, f31, k31 * y};
      out[12] = {0, 0, k(kY30) * (15 * zz - 3)};
      out[13] = {f31, 0, k31 * x};
      out[14] = {k32 * x * z, -k32 * y * z, k(kY32) * xxyy};
      out[15] = {k33 * xxyy, -k33 * xy2, 0};
      if constexpr (B > 4) {
        const float f41 = k(kY41) * z * (7 * zz - 3), g41 = k(kY41) * (21 * zz - 3);
        const float f42 = 2 * k(kY42) * (7 * zz - 1), g42 = 14 * k(kY42) * z;
        const float f43 = 3 * k(kY43) * z, f44 = 4 * k(kY44);
        out[16] = {f44 * s3, f44 * c3, 0};
        out[17] = {f43 * xy2, f43 * xxyy, k(kY43) * s3};
        out[18] = {f42 * y, f42 * x, g42 * xy2};
        out[19] = {0, f41, g41 * y};
        out[20] = {0, 0, k(kY40) * z * (140 * zz - 60)};
        out[21] = {f41, 0, g41 * x};
        out[22] = {f42 * x, -f42 * y, g42 * xxyy};
        out[23] = {f43 * xxyy, -f43 * xy2, k(kY43) * c3};
        out[24] = {f44 * c3, -f44 * s3, 0};
      }
    }
  }
}

}  // namespace rigel::detail
