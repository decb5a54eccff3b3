// Local lights at a vector of points: geometry, the weights of the bands, the basis. Included once per Highway target,
// after <hwy/highway.h>.
#if defined(RIGEL_PROJECT_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_PROJECT_LANES_H
#undef RIGEL_PROJECT_LANES_H
#else
#define RIGEL_PROJECT_LANES_H
#endif

#include "lane.h"
#include "lane_estimate.h"
#include "lane_modulation.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// A vector of points; footprint is 0 where they are points indeed.
struct PointLanes {
  Lane x, y, z, footprint, footprintSquare;
};

/// A light at a vector of points.
struct SeenLanes {
  Lane wx, wy, wz;  // unit vector towards it
  Lane e;           // times window and cone; inside a sphere also times (d/r)^2
  Lane c;           // the cosine
  Lane band0;       // e / (1 + c); inside e (1 - c)
};

/// How `see` fared.
struct Sight {
  bool easy;  // all that is seen is right; where not, isSmall and isServed say at which points it is
  Lane s2;    // (r/d)^2, the sine squared
  bool dark;  // reaches none of the points
};

/// What the derivative by the point takes besides. e changes by radial w for a step towards the light because window
/// and cone do, and by -axial axis (that of PreparedLight) because the cone does.
struct SlopeLanes {
  Lane inverse;  // 1 / d
  Lane radial, axial;
};

/// 1 where it holds, else 0: on some machines masks cannot lie in arrays.
HWY_INLINE Lane oneWhere(LaneMask mask) { return select(mask, Lane(1.0f), Lane(0.0f)); }

/// Points and spots of no footprint are smaller, unless they are right there, and do with the first terms.
template <detail::BlockKind Kind, bool WithFootprint>
inline constexpr bool kTiny = Kind != detail::BlockKind::sphere && !WithFootprint;

/// Without window and cone.
template <detail::BlockKind Kind>
inline constexpr bool kBoundless = Kind == detail::BlockKind::sphere || Kind == detail::BlockKind::point;

/// c and 1/(1+c) of lights that are small enough, without a root: quadratics fitted to s2 < 1/64, within 1e-8; or the
/// first terms, which leave out s2^2/8 and s2^2/16.
template <bool Tiny>
HWY_INLINE void seeSmall(Lane e, Lane s2, SeenLanes& seen) {
  if constexpr (Tiny) {
    seen.c = negMulAdd(Lane(0.5f), s2, Lane(1.0f));
    seen.band0 = e * mulAdd(Lane(0.125f), s2, Lane(0.5f));
  } else {
    seen.c = mulAdd(s2, mulAdd(s2, Lane(-0.12637524f), Lane(-0.49999332f)), Lane(1.0f));
    seen.band0 = e * mulAdd(s2, mulAdd(s2, Lane(0.063360702f), Lane(0.12499582f)), Lane(0.5f));
  }
}

/// Also false for NaN, which s2 is where a light is too far for floats.
template <bool Tiny>
HWY_INLINE LaneMask isSmall(Lane s2) {
  constexpr double kBound = Tiny ? 5e-4 : detail::kSmallSquare;
  return s2 < Lane(kBound);
}

/// The vectors from points to a light, with what takes longest to find.
struct ApartLanes {
  Lane x, y, z, square, inverse;
};

HWY_INLINE ApartLanes apartFrom(const detail::PreparedLight& light, const PointLanes& points) {
  ApartLanes apart;
  apart.x = Lane(light.position.x) - points.x;
  apart.y = Lane(light.position.y) - points.y;
  apart.z = Lane(light.position.z) - points.z;
  apart.square = mulAdd(apart.x, apart.x, mulAdd(apart.y, apart.y, apart.z * apart.z));
  apart.inverse = inverseRoot(apart.square);
  return apart;
}

/// Where float serves, if the light is small there; elsewhere what is seen is of no use.
template <bool WithFootprint>
HWY_INLINE LaneMask isServed(const detail::PreparedLight& light, const PointLanes& points, Lane square, Lane s2) {
  LaneMask served = square >= Lane(light.nearestSquare) && s2 >= Lane(0.0f);
  if constexpr (WithFootprint) served = served && square >= Lane(detail::kCloseSquare) * points.footprintSquare;
  return served;
}

/// What a light is at points, c and band0 as if it were small. `slope`: a SlopeLanes*, or nullptr where nobody asks for
/// it.
template <detail::BlockKind Kind, bool WithFootprint, class Slope>
HWY_INLINE Sight see(const detail::PreparedLight& light, const PointLanes& points, const ApartLanes& apart,
                     SeenLanes& seen, Slope slope) {
  constexpr bool kWithSlope = !std::is_same_v<Slope, std::nullptr_t>;
  constexpr bool kIsTiny = kTiny<Kind, WithFootprint>;
  bool dark = false;
  const Lane inverse = apart.inverse;
  const Lane wx = apart.x * inverse, wy = apart.y * inverse, wz = apart.z * inverse;
  if constexpr (kWithSlope) {
    slope->inverse = inverse;
    slope->radial = slope->axial = Lane(0.0f);
  }
  Lane e = inverse * inverse, widest = Lane(light.radiusSquare);
  if constexpr (WithFootprint) widest = max(widest, points.footprintSquare);
  const Lane s2 = widest * e;
  if (Kind == detail::BlockKind::windowedPoint || (Kind == detail::BlockKind::spot && light.inverseRangeSquare > 0)) {
    const RangeLanes range(apart.square, light.inverseRangeSquare);
    if constexpr (kWithSlope) slope->radial = range.slope(e) * inverse;
    e = range.window(e);
    dark = none(range.within);
  }
  if constexpr (Kind == detail::BlockKind::spot) {
    const Lane z = mulAdd(Lane(light.axis.z), wz, Lane(light.coneOffset));
    const Lane t = mulAdd(Lane(light.axis.x), wx, mulAdd(Lane(light.axis.y), wy, z));
    if (!all(t >= Lane(1.0f))) {
      if constexpr (kWithSlope) {
        const Lane held = clamp(t, Lane(0.0f), Lane(1.0f));
        slope->axial = Lane(6.0f) * e * inverse * held * (Lane(1.0f) - held);
        slope->radial = mulAdd(slope->radial, smoothStep(t), slope->axial * (t - Lane(light.coneOffset)));
      }
      e *= smoothStep(t);
      dark = dark || all(e <= Lane(0.0f));
    }
  }
  seen.wx = wx;
  seen.wy = wy;
  seen.wz = wz;
  seen.e = e;
  seeSmall<kIsTiny>(e, s2, seen);
  const bool easy = !light.extreme && all(isSmall<kIsTiny>(s2));
  // A cone is another one inside a light.
  if (Kind == detail::BlockKind::spot && dark && !easy)
    dark = all(isServed<WithFootprint>(light, points, apart.square, s2));
  return {easy, s2, dark};
}

/// c and band0 where the light is not small.
HWY_NOINLINE inline void seeLarge(Lane s2, Lane isSmall, SeenLanes& seen) {
  const LaneMask small = isSmall > Lane(0.0f);
  const Lane c = root(Lane(1.0f) - s2);
  seen.c = select(small, seen.c, c);
  seen.band0 = select(small, seen.band0, quotient(seen.e, Lane(1.0f) + c));
}

/// The last step: `put(i, number)` for each coefficient, the light's SH over 2 colour and the constants of shScale.
/// What is put is not looked at again, so that few registers do.
template <int B, class Put>
HWY_INLINE void weighBasis(const SeenLanes& seen, const Put& put) {
  const Lane x = seen.wx, y = seen.wy, z = seen.wz;
  put(0, seen.band0);
  if constexpr (B == 2) {
    put(1, seen.e * y);
    put(2, seen.e * z);
    put(3, seen.e * x);
  } else {
    // Homogeneous, as in sh_polynomials.h: nothing cancels near the poles.
    const Lane ey = seen.e * y;
    put(1, ey);
    const Lane cy = seen.c * ey;
    put(5, cy * z);
    const Lane ez = seen.e * z;
    put(2, ez);
    const Lane zz = seen.c * ez * z;
    const Lane ex = seen.e * x;
    put(3, ex);
    const Lane cx = seen.c * ex;
    put(4, cx * y);
    put(7, cx * z);
    const Lane xx = cx * x, yy = cy * y;
    put(8, xx - yy);
    put(6, mulSub(Lane(2.0f), zz, xx + yy));
  }
  if constexpr (B > 3) {
    const Lane c2 = seen.c * seen.c;
    const Lane weight = seen.e * mulSub(Lane(5.0f), c2, Lane(1.0f));
    const Lane xx = x * x, yy = y * y, zz = z * z, tt = xx + yy, xxyy = xx - yy, xy2 = Lane(2.0f) * x * y;
    const Lane s3 = mulAdd(x, xy2, y * xxyy), c3 = mulSub(x, xxyy, y * xy2);
    const Lane f31 = weight * mulSub(Lane(4.0f), zz, tt), weightZ = weight * z;
    put(9, weight * s3);
    put(10, weightZ * xy2);
    put(11, f31 * y);
    put(12, weightZ * mulAdd(Lane(2.0f), zz, Lane(-3.0f) * tt));
    put(13, f31 * x);
    put(14, weightZ * xxyy);
    put(15, weight * c3);
    if constexpr (B > 4) {
      const Lane weight4 = seen.e * seen.c * mulSub(Lane(7.0f), c2, Lane(3.0f));
      const Lane f41 = weight4 * z * mulAdd(Lane(4.0f), zz, Lane(-3.0f) * tt);
      const Lane f42 = weight4 * mulSub(Lane(6.0f), zz, tt), f43 = weight4 * z;
      put(16, weight4 * xy2 * xxyy);
      put(17, f43 * s3);
      put(18, f42 * xy2);
      put(19, f41 * y);
      put(20, weight4 * mulAdd(Lane(8.0f) * zz, zz - Lane(3.0f) * tt, Lane(3.0f) * tt * tt));
      put(21, f41 * x);
      put(22, f42 * xxyy);
      put(23, f43 * c3);
      put(24, weight4 * (xxyy - xy2) * (xxyy + xy2));
    }
  }
}

/// A point that is the one before once more: vectors are filled up so.
HWY_INLINE bool repeats(std::size_t k, const float* x, const float* y, const float* z) {
  return k > 0 && x[k] == x[k - 1] && y[k] == y[k - 1] && z[k] == z[k - 1];
}

/// What the lanes see that float does not serve, one by one in double.
HWY_NOINLINE inline void seeWithCare(const detail::PreparedLight& light, const PointLanes& points, Lane isServed,
                                     SeenLanes& seen) {
  float x[Lane::kCount], y[Lane::kCount], z[Lane::kCount], footprint[Lane::kCount], served[Lane::kCount];
  float wx[Lane::kCount], wy[Lane::kCount], wz[Lane::kCount], c[Lane::kCount], band0[Lane::kCount], e[Lane::kCount];
  points.x.store(x), points.y.store(y), points.z.store(z), points.footprint.store(footprint);
  seen.wx.store(wx), seen.wy.store(wy), seen.wz.store(wz);
  seen.c.store(c), seen.band0.store(band0), seen.e.store(e);
  isServed.store(served);
  for (std::size_t k = 0; k < Lane::kCount; ++k) {
    if (served[k] != 0) continue;
    if (repeats(k, x, y, z) && footprint[k] == footprint[k - 1]) {
      wx[k] = wx[k - 1], wy[k] = wy[k - 1], wz[k] = wz[k - 1];
      c[k] = c[k - 1], band0[k] = band0[k - 1], e[k] = e[k - 1];
      continue;
    }
    const detail::CarefulTerm term = detail::carefulTerm(light, {x[k], y[k], z[k]}, footprint[k]);
    wx[k] = term.w.x, wy[k] = term.w.y, wz[k] = term.w.z;
    c[k] = term.c, band0[k] = term.band0, e[k] = term.e;
  }
  seen.wx = Lane::load(wx), seen.wy = Lane::load(wy), seen.wz = Lane::load(wz);
  seen.c = Lane::load(c), seen.band0 = Lane::load(band0), seen.e = Lane::load(e);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
