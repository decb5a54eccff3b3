#include "report/measure/half_coefficients.h"

#include <rigel/gpu_rig.h>
#include <rigel/half.h>

namespace rigel::tools {
namespace {

/// Floats from texels on, one after another.
class Reader {
 public:
  Reader(std::span<const GpuHalf4> texels, double scale) : texels_(texels), scale_(scale) {}

  float operator[](std::size_t i) const {
    const GpuHalf4& texel = texels_[i / 4];
    const std::uint16_t halves[] = {texel.x, texel.y, texel.z, texel.w};
    return static_cast<float>(scale_ * static_cast<double>(floatFromHalf(halves[i % 4])));
  }

 private:
  std::span<const GpuHalf4> texels_;
  double scale_;
};

}  // namespace

Rgb highBandIrradiance(const HighBand& high, Vec3 normal, float wrap) {
  float y[shCount(kMaxBands)];
  shBasis<kMaxBands>(normal, y);
  Rgb sum;
  for (int m = 0; m < 2 * high.band + 1; ++m) sum += high.c[m] * y[high.band * high.band + m];
  return sum * (static_cast<float>(kPi) * wrapCoefficients<kMaxBands>(wrap)[high.band]);
}

template <int B>
HalfCoefficients<B>::HalfCoefficients(const Rig& rig, const RigFrame& worldFromRig,
                                      std::span<const RadianceSH<B>> coefficients, const HighBand& high)
    : rig_(&rig), frame_(worldFromRig), coefficients_(static_cast<std::size_t>(rig.shVectors())), high_(high) {
  std::vector<GpuHalf4> texels(static_cast<std::size_t>(packRigBound(rig, B)));
  const GpuRig packed = packRig<B>(rig, worldFromRig, coefficients, high, {}, std::span(texels));
  const double scale = static_cast<double>(packed.scale) / kPi;  // stored is pi times radiance SH
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    const Reader row(std::span<const GpuHalf4>(texels).subspan(k * gpuVectorSize(B)), scale);
    for (std::size_t i = 0; i < 3 * shCount(B); ++i) coefficients_[k].data()[i] = row[i];
  }
  if (high.band == 0) return;
  const Reader row(std::span<const GpuHalf4>(texels).subspan(static_cast<std::size_t>(packed.highOffset)), scale);
  for (std::size_t m = 0; m < 2 * static_cast<std::size_t>(high.band) + 1; ++m)
    high_.c[m] = {row[3 * m], row[3 * m + 1], row[3 * m + 2]};
}

template <int B>
Rgb HalfCoefficients<B>::shade(Vec3 point, Vec3 normal, float wrap) const {
  const RadianceSH<B> radiance = evaluateRig<B>(*rig_, coefficients_, frame_.inversePoint(point));
  Rgb sum = irradiance<B>(radiance, wrapCoefficients<B>(wrap), normal);
  if (high_.band > 0) sum += highBandIrradiance(high_, normal, wrap);
  return sum;
}

template class HalfCoefficients<2>;
template class HalfCoefficients<3>;
template class HalfCoefficients<4>;
template class HalfCoefficients<5>;

}  // namespace rigel::tools
