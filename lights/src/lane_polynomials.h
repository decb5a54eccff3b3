// The SH polynomials of sh_polynomials.h on all lanes, homogeneous as there, without their constants (kBasisScale), and
// one band more. Included once per Highway target, after <hwy/highway.h>.
#if defined(RIGEL_LANE_POLYNOMIALS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_LANE_POLYNOMIALS_H
#undef RIGEL_LANE_POLYNOMIALS_H
#else
#define RIGEL_LANE_POLYNOMIALS_H
#endif

#include "lane.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// Bands 0 to L of the unit vector, L in 2..5.
template <int L>
HWY_INLINE void polynomials(Lane x, Lane y, Lane z, Lane* out) {
  const Lane xx = x * x, yy = y * y, zz = z * z, tt = xx + yy, xy = x * y, xxyy = xx - yy;
  out[0] = Lane(1.0f);
  out[1] = y;
  out[2] = z;
  out[3] = x;
  out[4] = xy;
  out[5] = y * z;
  out[6] = mulSub(Lane(2.0f), zz, tt);
  out[7] = x * z;
  out[8] = xxyy;
  if constexpr (L > 2) {
    const Lane xy2 = xy + xy;
    const Lane s3 = mulAdd(x, xy2, y * xxyy), c3 = mulSub(x, xxyy, y * xy2);
    const Lane f31 = mulSub(Lane(4.0f), zz, tt);
    out[9] = s3;
    out[10] = z * xy2;
    out[11] = f31 * y;
    out[12] = z * negMulAdd(Lane(3.0f), tt, zz + zz);
    out[13] = f31 * x;
    out[14] = z * xxyy;
    out[15] = c3;
    if constexpr (L > 3) {
      const Lane s4 = xy2 * xxyy, c4 = (xxyy - xy2) * (xxyy + xy2);
      const Lane f41 = z * negMulAdd(Lane(3.0f), tt, Lane(4.0f) * zz), f42 = mulSub(Lane(6.0f), zz, tt);
      out[16] = s4;
      out[17] = z * s3;
      out[18] = f42 * xy2;
      out[19] = f41 * y;
      out[20] = mulAdd(Lane(8.0f) * zz, negMulAdd(Lane(3.0f), tt, zz), Lane(3.0f) * tt * tt);
      out[21] = f41 * x;
      out[22] = f42 * xxyy;
      out[23] = z * c3;
      out[24] = c4;
      if constexpr (L > 4) {
        const Lane s42 = s4 + s4, f53 = mulSub(Lane(8.0f), zz, tt), f52 = z * mulSub(Lane(2.0f), zz, tt);
        const Lane f51 = mulAdd(Lane(4.0f) * zz, negMulAdd(Lane(3.0f), tt, zz + zz), tt * tt);
        out[25] = mulAdd(x, s42, y * c4);
        out[26] = z * s42;
        out[27] = f53 * s3;
        out[28] = f52 * xy2;
        out[29] = f51 * y;
        out[30] = z * mulAdd(Lane(8.0f) * zz, negMulAdd(Lane(5.0f), tt, zz), Lane(15.0f) * tt * tt);
        out[31] = f51 * x;
        out[32] = f52 * xxyy;
        out[33] = f53 * c3;
        out[34] = z * c4;
        out[35] = mulSub(x, c4, y * s42);
      }
    }
  }
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
