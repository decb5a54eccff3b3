#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>

namespace rigel {

float clampWrap(float a) noexcept { return a != a ? 0.0f : std::clamp(a, kMinWrap, kMaxWrap); }

double wrapKernel(double x, double a) noexcept {
  const double base = (x + a) / (1 + a);
  return base > 0 ? std::pow(base, 1 + a) : 0.0;
}

template <int B>
std::array<float, B> wrapCoefficients(float wrap) noexcept {
  const double a = clampWrap(wrap);
  double f[B];
  f[0] = 2 * (1 + a) / (2 + a);
  f[1] = 2 * f[0] / (3 + a);
  for (int l = 1; l + 1 < B; ++l) f[l + 1] = ((2 + a - l) * f[l - 1] - (2 * l + 1) * a * f[l]) / (l + 3 + a);

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

template std::array<float, 2> wrapCoefficients<2>(float) noexcept;
template std::array<float, 3> wrapCoefficients<3>(float) noexcept;
template std::array<float, 4> wrapCoefficients<4>(float) noexcept;
template std::array<float, 5> wrapCoefficients<5>(float) noexcept;
template IrradianceSH<2> irradianceFromRadiance<2>(const RadianceSH<2>&, float) noexcept;
template IrradianceSH<3> irradianceFromRadiance<3>(const RadianceSH<3>&, float) noexcept;
template IrradianceSH<4> irradianceFromRadiance<4>(const RadianceSH<4>&, float) noexcept;
template IrradianceSH<5> irradianceFromRadiance<5>(const RadianceSH<5>&, float) noexcept;

}  // namespace rigel
