#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>

#include "wrap_bands.h"

namespace rigel {

float clampWrap(float a) noexcept { return a != a ? 0.0f : std::clamp(a, kMinWrap, kMaxWrap); }

double wrapKernel(double x, double a) noexcept {
  const double base = (x + a) / (1 + a);
  return base > 0 ? std::pow(base, 1 + a) : 0.0;
}

template <int B>
std::array<float, B> wrapCoefficients(float wrap) noexcept {
  double f[B];
  detail::wrapBands<B>(wrap, f);
  std::array<float, B> out;
  for (int l = 0; l < B; ++l) out[l] = static_cast<float>(f[l]);
  return out;
}

template <int B>
IrradianceSH<B> irradianceFromRadiance(const RadianceSH<B>& radiance, float wrap) noexcept {
  const std::array<float, B> f = wrapCoefficients<B>(wrap);
  IrradianceSH<B> out;
  for (int l = 0; l < B; ++l) {
    const float factor = static_cast<float>(kPi) * f[l];
    for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) out[i] = radiance[i] * factor;
  }
  return out;
}

float wrapEnergy(float wrap) noexcept {
  const double a = clampWrap(wrap);
  return static_cast<float>((2 + a) / (2 * (1 + a)));
}

// Blur and highBandShare (shader_near_cap.h) were fitted together, to exact irradiance over s in [0, 1] and all
// normals. The blur at s is `width` s sqrt(1-a^2)/(1+a), the light's angular size at the horizon. It adds a bump at
// x = -a to the kernel, whose bands are its area, (2/(2p+1) - 1/(p+1)) width^(p+1) for the power p = 1 + a, times
// P_l(-a); the fit's `area` stands for what is not width^2 in it.
GpuWrap gpuWrap(float wrap, float gain) noexcept {
  GpuWrap out{};
  out.a = clampWrap(wrap);
  out.inverse = 1 / (1 + out.a);
  out.gain = gain > 0 && std::isfinite(gain) ? gain : 0.0f;
  const std::array<float, 5> f = wrapCoefficients<5>(out.a);
  out.f = {f[0] * out.gain, f[1] * out.gain, f[2] * out.gain, f[3] * out.gain};
  out.f4 = f[4] * out.gain;

  const double a = out.a;
  const double width = std::max(0.0, 0.746 + a * (0.3718 - a * 1.7425));
  const double area = 0.2042 + a * (-0.6257 + a * 0.5433);
  const double blur = width * std::sqrt((1 - a) / (1 + a));
  out.blur = static_cast<float>(blur);
  const double bump = 2 * (1 + a) * area * blur * blur * static_cast<double>(out.gain);
  const double a2 = a * a;
  out.blurBand.x = static_cast<float>(bump);
  out.blurBand.y = static_cast<float>(bump * -a);
  out.blurBand.z = static_cast<float>(bump * (1.5 * a2 - 0.5));
  out.blurBand.w = static_cast<float>(bump * -a * (2.5 * a2 - 1.5));
  out.blurBand4 = static_cast<float>(bump * (35 * a2 * a2 - 30 * a2 + 3) / 8);
  return out;
}

template std::array<float, 2> wrapCoefficients<2>(float) noexcept;
template std::array<float, 3> wrapCoefficients<3>(float) noexcept;
template std::array<float, 4> wrapCoefficients<4>(float) noexcept;
template std::array<float, 5> wrapCoefficients<5>(float) noexcept;
template IrradianceSH<2> irradianceFromRadiance<2>(const RadianceSH<2>&, float) noexcept;
template IrradianceSH<3> irradianceFromRadiance<3>(const RadianceSH<3>&, float) noexcept;
template IrradianceSH<4> irradianceFromRadiance<4>(const RadianceSH<4>&, float) noexcept;
template IrradianceSH<5> irradianceFromRadiance<5>(const RadianceSH<5>&, float) noexcept;

}  // namespace rigel
