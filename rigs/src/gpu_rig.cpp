#include <rigel/gpu_rig.h>
#include <rigel/half.h>

#include "gpu_rig_reader.h"
#include "half_scale.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace rigel {
namespace {

constexpr int kLargestHigh = gpuVectorSize(3);  // a band of up to 9 colours takes what 9 coefficients take

float timesPi(float x) noexcept { return static_cast<float>(kPi * static_cast<double>(x)); }

/// Colours one after the other, as floats.
std::span<const float> floatsOf(std::span<const Rgb> colours) noexcept {
  return {&colours.front().r, 3 * colours.size()};
}

void store(float x, float y, float z, float w, float /*inverseScale*/, GpuVec4& out) noexcept { out = {x, y, z, w}; }
void store(float x, float y, float z, float w, float inverseScale, GpuHalf4& out) noexcept {
  out = {halfFromFloat(x * inverseScale), halfFromFloat(y * inverseScale), halfFromFloat(z * inverseScale),
         halfFromFloat(w * inverseScale)};
}

/// vec4 i of a vector of colours times pi, 0 beyond its end.
template <class Texel>
void storeVec4(std::span<const float> colours, int i, float inverseScale, Texel& out) noexcept {
  const auto at = [&](int j) {
    const auto k = static_cast<std::size_t>(4 * i + j);
    return k < colours.size() ? timesPi(colours[k]) : 0.0f;
  };
  store(at(0), at(1), at(2), at(3), inverseScale, out);
}

/// Largest finite magnitude.
float largestOf(std::span<const float> values, float largest = 0) noexcept {
  for (float v : values) {
    const float magnitude = std::abs(v);
    if (magnitude < std::numeric_limits<float>::infinity()) largest = std::max(largest, magnitude);
  }
  return largest;
}

template <int B, class Texel>
float scaleOf(std::span<const RadianceSH<B>> coefficients, const HighBand& highBand) noexcept {
  if constexpr (std::is_same_v<Texel, GpuVec4>) {
    return 1;
  } else {
    float largest = highBand.band > 0 ? largestOf(floatsOf(highBand.c)) : 0.0f;
    for (const RadianceSH<B>& c : coefficients) largest = largestOf(floatsOf(c.c), largest);
    return halfScale(kPi * static_cast<double>(largest));
  }
}

template <int B, class Texel>
GpuRig packInto(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                const HighBand& highBand, const GpuRigPlace& place, std::span<Texel> buffer) noexcept {
  constexpr int kSize = gpuVectorSize(B);
  const int vectors = static_cast<int>(coefficients.size());
  const int all = std::max(vectors, place.vectors);
  GpuRig out = GpuRigReader(rig).describe(worldFromRig);
  out.vectors = vectors;
  out.offset = place.offset;
  out.gaussOffset = place.gaussOffset;
  out.scale = scaleOf<B, Texel>(coefficients, highBand);
  const float inverseScale = 1 / out.scale;
  auto to = buffer.begin() + place.offset;
  for (int k = 0; k < all; ++k) {
    const std::span<const float> colours = k < vectors ? floatsOf(coefficients[k].c) : std::span<const float>();
    for (int i = 0; i < kSize; ++i) storeVec4(colours, i, inverseScale, *to++);
  }
  out.highOffset = place.offset + all * kSize;
  if (highBand.band > 0) {
    out.highBand = highBand.band;
    const std::span<const Rgb> band = std::span(highBand.c).first(2 * highBand.band + 1);
    for (int i = 0; i < kLargestHigh; ++i) storeVec4(floatsOf(band), i, inverseScale, *to++);
  }
  return out;
}

/// The axes by decreasing number of nodes.
std::array<int, 3> axesByNodes(const Rig& rig) noexcept {
  std::array<int, 3> order{0, 1, 2};
  // Not stable_sort, which allocates.
  std::ranges::sort(order, {}, [&](int a) { return std::pair(-rig.axes()[a].nodes, a); });
  return order;
}

template <int B, class Texel>
GpuRig packTextureInto(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                       std::span<Texel> texels) noexcept {
  assert(coefficients.size() == static_cast<std::size_t>(rig.shVectors()));
  const std::array<int, 3> order = axesByNodes(rig);
  GpuRig out = GpuRigReader(rig).describe(worldFromRig);
  const std::array<GpuVec4, 3> axis{out.axisX, out.axisY, out.axisZ};
  out.axisX = axis[order[0]];
  out.axisY = axis[order[1]];
  out.axisZ = axis[order[2]];
  out.kind = shader_types::kGpuRigTexture;
  out.vectors = static_cast<int>(coefficients.size());
  out.scale = scaleOf<B, Texel>(coefficients, {});
  const float inverseScale = 1 / out.scale;

  std::array<int, 3> nodes{}, stride{};  // of the texture's axes: their nodes, and the vectors from one to the next
  for (int a = 0; a < 3; ++a) {
    nodes[a] = rig.axes()[order[a]].nodes;
    stride[a] = 1;
    for (int before = 0; before < order[a]; ++before) stride[a] *= rig.axes()[before].nodes;
  }
  out.nodes = {nodes[0], nodes[1], nodes[2]};
  auto to = texels.begin();
  for (int i = 0; i < gpuVectorSize(B); ++i)
    for (int z = 0; z < nodes[2]; ++z)
      for (int y = 0; y < nodes[1]; ++y)
        for (int x = 0; x < nodes[0]; ++x) {
          const int k = x * stride[0] + y * stride[1] + z * stride[2];
          storeVec4(floatsOf(coefficients[k].c), i, inverseScale, *to++);
        }
  return out;
}

}  // namespace

std::optional<Error> checkGpuRig(const RigSpec& spec) {
  if (spec.family == RigSpec::Family::tensor || spec.family == RigSpec::Family::poly) return std::nullopt;
  return Error{"this model is for comparison on the CPU alone: no shader evaluates it", "rig '" + spec.text + "'"};
}

int packRigBound(const Rig& rig, int bands, int vectors) noexcept {
  return std::max(rig.shVectors(), vectors) * gpuVectorSize(bands) + kLargestHigh;
}

template <int B>
GpuRig packRig(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
               const HighBand& highBand, const GpuRigPlace& place, std::span<GpuVec4> buffer) noexcept {
  return packInto<B>(rig, worldFromRig, coefficients, highBand, place, buffer);
}

template <int B>
GpuRig packRig(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
               const HighBand& highBand, const GpuRigPlace& place, std::span<GpuHalf4> buffer) noexcept {
  return packInto<B>(rig, worldFromRig, coefficients, highBand, place, buffer);
}

int packGaussNodesBound(const Rig& rig) noexcept {
  if (rig.spec().family != RigSpec::Family::tensor || rig.spec().fit != FitMethod::gauss) return 0;
  int pairs = 0;
  for (const AxisModel& axis : rig.axes()) pairs += (axis.nodes + 1) / 2;
  return pairs;
}

void packGaussNodes(const Rig& rig, std::span<GpuVec4> out) noexcept {
  if (packGaussNodesBound(rig) > 0) GpuRigReader(rig).gaussNodes(out);
}

bool fitsTexture(const RigSpec& spec) noexcept {
  const bool slopes =
      std::ranges::any_of(spec.axes, [](const AxisModel& axis) { return axis.kind == AxisModel::Kind::gradient; });
  return spec.family == RigSpec::Family::tensor && spec.fit != FitMethod::gauss &&
         spec.kernel != LatticeKernel::cubic && !slopes;
}

std::optional<GpuTextureSize> textureSize(const Rig& rig, int bands) noexcept {
  if (!fitsTexture(rig.spec())) return {};
  const std::array<int, 3> order = axesByNodes(rig);
  return GpuTextureSize{rig.axes()[order[0]].nodes, rig.axes()[order[1]].nodes,
                        rig.axes()[order[2]].nodes * gpuVectorSize(bands)};
}

template <int B>
GpuRig packTexture(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                   std::span<GpuVec4> texels) noexcept {
  return packTextureInto<B>(rig, worldFromRig, coefficients, texels);
}

template <int B>
GpuRig packTexture(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                   std::span<GpuHalf4> texels) noexcept {
  return packTextureInto<B>(rig, worldFromRig, coefficients, texels);
}

int packHighBandBound() noexcept { return kLargestHigh; }

void packHighBand(const HighBand& highBand, int offset, std::span<GpuVec4> buffer, GpuRig& packed) noexcept {
  packed.highBand = highBand.band;
  packed.highOffset = offset;
  if (highBand.band == 0) return;
  // What is fetched is multiplied by the rig's scale, a power of two.
  std::array<Rgb, 2 * kMaxBands - 1> band{};
  const auto count = static_cast<std::size_t>(2 * highBand.band + 1);
  for (std::size_t m = 0; m < count; ++m) band[m] = highBand.c[m] * (1 / packed.scale);
  const std::span<const Rgb> used = std::span(band).first(count);
  for (int i = 0; i < kLargestHigh; ++i) storeVec4(floatsOf(used), i, 1, buffer[static_cast<std::size_t>(offset + i)]);
}

#define RIGEL_INSTANTIATE(B)                                                                               \
  template GpuRig packRig<B>(const Rig&, const RigFrame&, std::span<const RadianceSH<B>>, const HighBand&, \
                             const GpuRigPlace&, std::span<GpuVec4>) noexcept;                             \
  template GpuRig packRig<B>(const Rig&, const RigFrame&, std::span<const RadianceSH<B>>, const HighBand&, \
                             const GpuRigPlace&, std::span<GpuHalf4>) noexcept;                            \
  template GpuRig packTexture<B>(const Rig&, const RigFrame&, std::span<const RadianceSH<B>>,              \
                                 std::span<GpuVec4>) noexcept;                                             \
  template GpuRig packTexture<B>(const Rig&, const RigFrame&, std::span<const RadianceSH<B>>,              \
                                 std::span<GpuHalf4>) noexcept;
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)
#undef RIGEL_INSTANTIATE

}  // namespace rigel
