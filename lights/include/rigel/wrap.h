// Wrap reflectance f(theta|a) = ((cos theta + a)/(1 + a))^(1 + a), zero where cos theta < -a, for skin and cloth.
// P.-P. Sloan, D. Nowrouzezahrai, H. Yuan, "Wrap Shading", JGGGT 2011. a = 0 is Lambert, a = 1 half-Lambert.
#pragma once

#include <rigel/sh.h>

namespace rigel {

/// The range in which a is meaningful; functions clamp to it. Towards a = -1 the kernel becomes a delta and no SH of a
/// few bands holds it; above 1 the published coefficients no longer match the kernel.
inline constexpr float kMinWrap = -0.25f;
inline constexpr float kMaxWrap = 1.0f;

/// `a` held within [kMinWrap, kMaxWrap]; NaN gives 0 (Lambert). What every function below does to its wrap argument,
/// wrapKernel apart.
float clampWrap(float a) noexcept;

/// f(theta|a) for x = cos theta in [-1, 1] and any a in (-1, 1].
double wrapKernel(double x, double a) noexcept;

/// f_l(a), l < B, such that E(n) = pi sum_l f_l sum_m L_lm Y_lm(n); a = 0: 1, 2/3, 1/4, 0, -1/24. By the three-term
/// recurrence (l+3+a) f_{l+1} = (2+a-l) f_{l-1} - (2l+1) a f_l, evaluated in double.
template <int B>
std::array<float, B> wrapCoefficients(float a) noexcept;

/// Convolution with the wrap kernel: E_lm = pi f_l(a) L_lm.
template <int B>
IrradianceSH<B> irradianceFromRadiance(const RadianceSH<B>& radiance, float wrap = 0) noexcept;

}  // namespace rigel
