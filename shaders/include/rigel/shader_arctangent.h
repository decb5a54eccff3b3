// Arc tangent without the built-in one, for which GPUs promise 4096 ulp. Parsed by C++ and GLSL.
#ifndef RIGEL_SHADER_ARCTANGENT_H
#define RIGEL_SHADER_ARCTANGENT_H

#include "rigel/shader_constants.h"
#include "rigel/shader_language.h"

#ifdef __cplusplus
#define rigel_atanTail atanTail
#define rigel_atanQuadrant atanQuadrant
namespace rigel::detail {
#endif

/// Q(y^2) in atan y = y - y^3 Q(y^2), 0 <= y <= 1; atan to 5e-8. Minimax fit. For callers that want y - atan y without
/// cancellation.
RIGEL_FUNCTION float rigel_atanTail(float q) RIGEL_NOEXCEPT {
  return 0.333316590f +
         q * (-0.199627032f +
              q * (0.139765777f + q * (-0.097942225f + q * (0.057773421f + q * (-0.023040017f + q * 0.004355373f)))));
}

/// atan2(y, x) for x, y >= 0; 0 where both are. To 1.2e-7.
RIGEL_FUNCTION float rigel_atanQuadrant(float y, float x) RIGEL_NOEXCEPT {
  float ratio = min(y, x) / max(max(y, x), 1e-30f);
  float q = ratio * ratio;
  float angle = ratio - ratio * q * rigel_atanTail(q);
  return y > x ? 0.5f * float(kRigelPi) - angle : angle;
}

#ifdef __cplusplus
}  // namespace rigel::detail
#endif

#endif
