#include <rigel/rig_light.h>

#include <algorithm>

namespace rigel {
namespace {

static_assert(Rig::kMaxBasisBatch <= kMaxShBatch);

/// A block of as many points as a batch may have.
template <int B>
struct RigBlock {
  const Rig& rig;
  const RigFrame& frame;
  std::span<const RadianceSH<B>> coefficients;
  const std::array<float, B>& bands;
  Vec3Rows points, normals;

  std::size_t count() const noexcept { return points.size(); }
  Vec3 local(std::size_t i) const noexcept { return frame.inversePoint({points.x[i], points.y[i], points.z[i]}); }

  void together(std::span<float> out) const noexcept {
    float row[3][Rig::kMaxBasisBatch], basis[Rig::kMaxBasisBatch * Rig::kMaxBasisBatch];
    for (std::size_t i = 0; i < count(); ++i) {
      const Vec3 p = local(i);
      for (int axis = 0; axis < 3; ++axis) row[axis][i] = p[axis];
    }
    const std::span<float> values = std::span(basis).first(coefficients.size() * count());
    rig.basisBatch({{row[0], count()}, {row[1], count()}, {row[2], count()}}, static_cast<int>(coefficients.size()),
                   values);
    irradianceBatch<B>(coefficients, values, bands, normals, out);
  }

  void oneByOne(std::span<float> out) const noexcept {
    for (std::size_t i = 0; i < count(); ++i) {
      const Rgb e =
          irradiance<B>(evaluateRig<B>(rig, coefficients, local(i)), bands, {normals.x[i], normals.y[i], normals.z[i]});
      for (std::size_t c = 0; c < 3; ++c) out[c * count() + i] = e[static_cast<int>(c)];
    }
  }
};

}  // namespace

template <int B>
void irradianceBatch(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                     const std::array<float, B>& wrapCoefficients, const Vec3Rows& points, const Vec3Rows& normals,
                     std::span<float> irradiance) noexcept {
  const std::size_t size = points.size();
  assert(normals.size() == size && irradiance.size() == 3 * size);
  float block[3 * Rig::kMaxBasisBatch];
  for (std::size_t at = 0; at < size; at += Rig::kMaxBasisBatch) {
    const std::size_t count = std::min(Rig::kMaxBasisBatch, size - at);
    const std::span<float> out = std::span(block).first(3 * count);
    const RigBlock<B> of{
        rig, worldFromRig, coefficients, wrapCoefficients, points.subrows(at, count), normals.subrows(at, count)};
    coefficients.size() <= Rig::kMaxBasisBatch ? of.together(out) : of.oneByOne(out);
    for (std::size_t c = 0; c < 3; ++c) std::copy_n(&out[c * count], count, &irradiance[c * size + at]);
  }
}

template void irradianceBatch<2>(const Rig&, const RigFrame&, std::span<const RadianceSH<2>>,
                                 const std::array<float, 2>&, const Vec3Rows&, const Vec3Rows&,
                                 std::span<float>) noexcept;
template void irradianceBatch<3>(const Rig&, const RigFrame&, std::span<const RadianceSH<3>>,
                                 const std::array<float, 3>&, const Vec3Rows&, const Vec3Rows&,
                                 std::span<float>) noexcept;
template void irradianceBatch<4>(const Rig&, const RigFrame&, std::span<const RadianceSH<4>>,
                                 const std::array<float, 4>&, const Vec3Rows&, const Vec3Rows&,
                                 std::span<float>) noexcept;
template void irradianceBatch<5>(const Rig&, const RigFrame&, std::span<const RadianceSH<5>>,
                                 const std::array<float, 5>&, const Vec3Rows&, const Vec3Rows&,
                                 std::span<float>) noexcept;

}  // namespace rigel
