// The shaders' text on near irradiance for Lane. Included once per Highway target, after <hwy/highway.h>; what that
// text includes has to be there already, for it is not to be compiled for the target.
#if defined(RIGEL_NEAR_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGEL_NEAR_LANES_H
#undef RIGEL_NEAR_LANES_H
#else
#define RIGEL_NEAR_LANES_H
#endif

#include "lane.h"
#include "lane_estimate.h"

#undef RIGEL_FUNCTION
#define RIGEL_FUNCTION HWY_INLINE
#undef RIGEL_SHADER_NAMESPACE
#define RIGEL_SHADER_NAMESPACE rigel::HWY_NAMESPACE
#undef RIGEL_SHADER_ARCTANGENT_H
#undef RIGEL_SHADER_NEAR_CAP_H

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

/// As in shader_wrap.h.
HWY_INLINE Lane wrapPower(Lane base, float a) {
  const hn::RebindToSigned<Lane::Tag> ints;
  const auto bits = hn::BitCast(ints, base.v);
  const auto e = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(ints, 0x3f3504f3)));
  const Lane m = hn::BitCast(Lane::Tag(), hn::Sub(bits, hn::ShiftLeft<23>(e)));
  const Lane z = quotient(m - Lane(1.0f), m + Lane(1.0f));
  const Lane q = z * z;
  const Lane perZ = mulAdd(q, mulAdd(q, Lane(0.595819175f), Lane(0.961587489f)), Lane(2.88539052f));

  const Lane shift = Lane(a) * Lane(hn::ConvertTo(Lane::Tag(), e));
  const auto whole = hn::Sub(hn::ConvertTo(ints, (shift + Lane(256.5f)).v), hn::Set(ints, 256));
  const Lane f = mulAdd(Lane(a) * z, perZ, shift - Lane(hn::ConvertTo(Lane::Tag(), whole)));
  const Lane perF = mulAdd(f * f,
                           mulAdd(f * f, mulAdd(f, Lane(0.000151883476f), Lane(0.00135869742f)),
                                  mulAdd(f, Lane(0.00962319039f), Lane(0.0554926805f))),
                           mulAdd(f, Lane(0.240224734f), Lane(0.693148315f)));
  const Lane scaled = base * Lane(hn::BitCast(Lane::Tag(), hn::ShiftLeft<23>(hn::Add(whole, hn::Set(ints, 127)))));
  return mulAdd(scaled * f, perF, scaled);
}

}  // namespace rigel::HWY_NAMESPACE

#include <rigel/shader_near_cap.h>
HWY_AFTER_NAMESPACE();
#endif
