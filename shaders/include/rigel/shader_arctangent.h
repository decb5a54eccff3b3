// Arc tangent without the built-in one, for which GPUs promise 4096 ulp. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_ARCTANGENT_H
#define RIGEL_SHADER_ARCTANGENT_H

#include "rigel/shader_constants.h"
#include "rigel/shader_language.h"

#ifdef __cplusplus
#define rigel_atanTail atanTail
#define rigel_atanQuadrant atanQuadrant
namespace RIGEL_SHADER_NAMESPACE {
#else
#define Real float
#endif

/// Q(y^2) in atan y = y - y^3 Q(y^2), 0 <= y <= 1; atan to 5e-8. Minimax fit. For callers that want y - atan y without
/// cancellation.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_atanTail(Real q) RIGEL_NOEXCEPT {
  return Real(0.333316590f) +
         q * (Real(-0.199627032f) +
              q * (Real(0.139765777f) +
                   q * (Real(-0.097942225f) +
                        q * (Real(0.057773421f) + q * (Real(-0.023040017f) + q * Real(0.004355373f))))));
}

/// atan2(y, x) for x, y >= 0; 0 where both are. To 1.2e-7.
RIGEL_GENERIC RIGEL_FUNCTION Real rigel_atanQuadrant(Real y, Real x) RIGEL_NOEXCEPT {
  Real ratio = min(y, x) / max(max(y, x), Real(1e-30f));
  Real q = ratio * ratio;
  Real angle = ratio - ratio * q * rigel_atanTail(q);
  return rigel_select(y > x, Real(0.5 * kRigelPi) - angle, angle);
}

#ifdef __cplusplus
}  // namespace RIGEL_SHADER_NAMESPACE
#else
#undef Real
#endif

#endif
