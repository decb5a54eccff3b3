// Wrap reflectance f(theta|a) = ((cos theta + a)/(1 + a))^(1 + a), zero where cos theta < -a, for skin and cloth.
// P.-P. Sloan, D. Nowrouzezahrai, H. Yuan, "Wrap Shading", JGGGT 2011. a = 0 is Lambert, a = 1 half-Lambert.
#pragma once

#include <rigel/sh.h>
#include <rigel/shader_constants.h>
#include <rigel/shader_types.h>

namespace rigel {

/// The range in which a is meaningful; functions clamp to it. Towards a = -1 the kernel becomes a delta and no SH of a
/// few bands holds it; above 1 the published coefficients no longer match the kernel.
inline constexpr float kMinWrap = static_cast<float>(kRigelMinWrap);
inline constexpr float kMaxWrap = static_cast<float>(kRigelMaxWrap);

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

/// 1 / f_0(a) = (2+a) / (2(1+a)): the published kernel reflects more light than it receives, f_0 = 1.2 times at a = 0.5
/// and 4/3 at a = 1, and irradiance times this is that of the kernel which reflects exactly what it receives (under
/// uniform radiance L, E = pi L for every a). 1 for Lambert.
float wrapEnergy(float a) noexcept;

/// What shaders need of a material's wrap, and the near path here (near_light.h); made once a material (about 60 ns).
/// `gain` multiplies the kernel and with it every irradiance: wrapEnergy(a) for the energy-normalised one, 1 for the
/// published one. A gain that is not a positive finite number gives 0.
GpuWrap gpuWrap(float a, float gain = 1) noexcept;

}  // namespace rigel
