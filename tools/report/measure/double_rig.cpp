#include "report/measure/double_rig.h"

#include <rigel/exact_bands.h>
#include <rigel/near_far.h>

namespace rigel::tools {
namespace {

/// The lights that the rig holds, as ObjectLighting hands them to it.
LightSet farShares(const LightSet& lights, std::span<const LightVerdict> verdicts) {
  std::vector<float> weights(static_cast<std::size_t>(lights.size()), 0.0f);
  std::vector<std::uint8_t> culled;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    weights[i] = verdicts[i].weight;
    culled.push_back(verdicts[i].role == LightRole::culled ? 1 : 0);
  }
  LightSet far;
  std::vector<NearLight> near;
  splitLights(lights, weights, far, near, culled);
  return far;
}

/// P, K x S: what the rig makes of one functional at a time.
std::vector<float> operatorOf(const Rig& rig) {
  const auto functionals = static_cast<std::size_t>(rig.projections());
  std::vector<float> one(functionals * functionals, 0.0f);
  for (std::size_t s = 0; s < functionals; ++s) one[s * functionals + s] = 1;
  std::vector<float> p(static_cast<std::size_t>(rig.shVectors()) * functionals);
  rig.fit(one, rig.projections(), p);
  return p;
}

}  // namespace

template <int B>
DoubleRig<B> DoubleRig<B>::fitted(const Rig& rig, const RigFrame& worldFromRig, const LightSet& lights,
                                  std::span<const LightVerdict> verdicts) {
  const LightSet far = farShares(lights, verdicts);
  PreparedLights prepared;
  prepared.set(far);
  std::vector<RadianceSH<B>> functionals(static_cast<std::size_t>(rig.projections()));
  projectSamples<B>(rig, worldFromRig, prepared, prepared.all(), functionals);

  DoubleRig out(rig, worldFromRig, static_cast<std::size_t>(rig.shVectors()));
  const std::vector<float> p = operatorOf(rig);
  for (std::size_t k = 0; k < out.c_.size(); ++k) {
    for (std::size_t s = 0; s < functionals.size(); ++s) {
      const auto weight = static_cast<double>(p[k * functionals.size() + s]);
      if (weight == 0) continue;
      for (std::size_t i = 0; i < shCount(B); ++i) out.c_[k][i] += functionals[s].c[i] * weight;
    }
  }
  return out;
}

template <int B>
DoubleRig<B> DoubleRig<B>::widened(const Rig& rig, const RigFrame& worldFromRig,
                                   std::span<const RadianceSH<B>> coefficients) {
  DoubleRig out(rig, worldFromRig, coefficients.size());
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    for (std::size_t i = 0; i < shCount(B); ++i) out.c_[k][i] = coefficients[k].c[i] * 1.0;
  return out;
}

template <int B>
RgbD DoubleRig<B>::shade(Vec3 point, Vec3 normal, float wrap) const {
  RigBasis basis;
  rig_->basis(frame_.inversePoint(point), basis);
  Coefficients sum{};
  for (std::size_t j = 0; j < static_cast<std::size_t>(basis.count); ++j) {
    const auto k = static_cast<std::size_t>(basis.index[j]);
    if (k >= c_.size()) continue;
    const auto phi = static_cast<double>(basis.value[j]);
    for (std::size_t i = 0; i < shCount(B); ++i) {
      const RgbD& c = c_[k][i];
      sum[i] += {phi * c.r, phi * c.g, phi * c.b};
    }
  }
  return exactBandIrradiance(sum, normal, wrap, B);
}

template class DoubleRig<2>;
template class DoubleRig<3>;
template class DoubleRig<4>;
template class DoubleRig<5>;

}  // namespace rigel::tools
