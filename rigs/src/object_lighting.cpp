#include <rigel/near_batch.h>
#include <rigel/object_lighting.h>
#include <rigel/sh_batch.h>

#include <algorithm>

#include "object_lighting_state.h"

namespace rigel {

template <int B>
Result<ObjectLighting<B>> ObjectLighting<B>::create(const RigSpec& spec, const RigShape& rest,
                                                    const LightingOptions& options) {
  auto rig = Rig::create(spec, rest);
  if (!rig) return rig.error();
  return ObjectLighting(std::make_unique<State>(*std::move(rig), rest, options));
}

template <int B>
ObjectLighting<B>::ObjectLighting(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
template <int B>
ObjectLighting<B>::ObjectLighting(ObjectLighting&&) noexcept = default;
template <int B>
ObjectLighting<B>& ObjectLighting<B>::operator=(ObjectLighting&&) noexcept = default;
template <int B>
ObjectLighting<B>::~ObjectLighting() = default;

template <int B>
const Rig& ObjectLighting<B>::rig() const noexcept {
  return state_->rig;
}
template <int B>
LightingOptions& ObjectLighting<B>::options() noexcept {
  return state_->options;
}
template <int B>
std::span<const int> ObjectLighting<B>::anchors() const noexcept {
  return state_->anchors;
}
template <int B>
void ObjectLighting<B>::setPose(const RigPose& pose, const RigFrame& worldFromRig) noexcept {
  state_->setPose(pose, worldFromRig);
}
template <int B>
void ObjectLighting<B>::reset() noexcept {
  state_->nearFar.reset();
  state_->faces.reset();
  state_->fresh = true;
}

template <int B>
void ObjectLighting<B>::light(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids,
                              LightingProbe probe) {
  if (state_->chooses()) {
    state_->weigh(lights, seconds, ids, probe);
    state_->settle(lights, state_->options.target.value, seconds, ids, probe);
  } else {
    state_->lightFixed(lights, seconds, ids, probe);
  }
}

template <int B>
void ObjectLighting<B>::weigh(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids,
                              LightingProbe probe) {
  state_->weigh(lights, seconds, ids, probe);
}
template <int B>
float ObjectLighting<B>::costAt(float target) const {
  state_->tradeOff.choose(state_->request(target), state_->costing);
  return state_->costing.nanoseconds;
}
template <int B>
void ObjectLighting<B>::settle(const LightSet& lights, float target, float seconds, std::span<const std::uint32_t> ids,
                               LightingProbe probe) {
  state_->settle(lights, target, seconds, ids, probe);
}

template <int B>
std::span<const RadianceSH<B>> ObjectLighting<B>::coefficients() const noexcept {
  return std::span(state_->coefficients).first(state_->active);
}
template <int B>
std::span<const NearLight> ObjectLighting<B>::nearLights() const noexcept {
  return state_->near;
}
template <int B>
std::span<const LightVerdict> ObjectLighting<B>::verdicts() const noexcept {
  return state_->verdicts;
}
template <int B>
std::optional<float> ObjectLighting<B>::spatialEstimate() const noexcept {
  return state_->spatialEstimate;
}
template <int B>
std::optional<float> ObjectLighting<B>::totalEstimate() const noexcept {
  return state_->totalEstimate;
}
template <int B>
float ObjectLighting<B>::modelledNanoseconds() const noexcept {
  return state_->nanoseconds;
}

template <int B>
float ObjectLighting<B>::lateNanoseconds() const noexcept {
  return state_->chooses() ? state_->nanoseconds - state_->choice.nanoseconds : 0;
}
template <int B>
const HighBand& ObjectLighting<B>::highBand() const noexcept {
  return state_->high;
}

template <int B>
Rgb ObjectLighting<B>::rigIrradiance(Vec3 p, Vec3 n, const MaterialWrap<B>& wrap) const noexcept {
  const State& s = *state_;
  Rgb out;
  if (s.active > 0) {
    RigBasis basis;
    s.rig.basis(s.frame.inversePoint(p), basis);
    RadianceSH<B> sum;
    for (int j = 0; j < basis.count; ++j) {
      if (basis.index[j] >= s.active) continue;
      const float* c = s.coefficients[basis.index[j]].data();
      for (int i = 0; i < 3 * shCount(B); ++i) sum.data()[i] += basis.value[j] * c[i];
    }
    out = rigel::irradiance<B>(sum, wrap.bands, n);
  }
  if (s.high.band > 0) {
    float y[shCount(kMaxBands)];
    shBasis<kMaxBands>(n, y);
    const int l = s.high.band;
    const float scale = static_cast<float>(kPi) * wrap.allBands[l];
    for (int i = 0; i < 2 * l + 1; ++i) out += s.high.c[i] * (scale * y[l * l + i]);
  }
  return out;
}

template <int B>
auto ObjectLighting<B>::shade(Vec3 p, Vec3 n, const MaterialWrap<B>& wrap) const noexcept -> Parts {
  Parts parts{rigIrradiance(p, n, wrap), {}};
  for (const NearLight& light : state_->near) parts.nearLights += nearIrradiance(light, p, n, wrap.nearLights);
  return parts;
}

template <int B>
void ObjectLighting<B>::rigIrradiance(const Vec3Rows& points, const Vec3Rows& normals, const MaterialWrap<B>& wrap,
                                      std::span<float> irradiance) const noexcept {
  const State& s = *state_;
  irradianceBatch<B>(s.rig, s.frame, coefficients(), wrap.bands, points, normals, irradiance);
  if (s.high.band == 0) return;
  const auto l = static_cast<std::size_t>(s.high.band);
  addBandIrradianceBatch(s.high.band, std::span(s.high.c).first(2 * l + 1), wrap.allBands[l], normals, irradiance);
}

template <int B>
void ObjectLighting<B>::shade(const Vec3Rows& points, const Vec3Rows& normals, const MaterialWrap<B>& wrap,
                              std::span<Parts> out) const noexcept {
  constexpr std::size_t kBlock = 256;
  float rig[3 * kBlock], near[3 * kBlock];
  for (std::size_t at = 0; at < points.size(); at += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - at);
    const Vec3Rows p = points.subrows(at, count), n = normals.subrows(at, count);
    rigIrradiance(p, n, wrap, std::span(rig).first(3 * count));
    nearIrradianceBatch(state_->near, p, n, wrap.nearLights, std::span(near).first(3 * count));
    for (std::size_t k = 0; k < count; ++k)
      out[at + k] = {{rig[k], rig[count + k], rig[2 * count + k]}, {near[k], near[count + k], near[2 * count + k]}};
  }
}

template class ObjectLighting<2>;
template class ObjectLighting<3>;
template class ObjectLighting<4>;
template class ObjectLighting<5>;

}  // namespace rigel
