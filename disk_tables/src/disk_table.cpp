#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/half.h>

#include <array>
#include <bit>

#include "look_up.h"

namespace rigel {
namespace {

#include "disk_table_data.inc"

template <class Texel>
using Texture = std::array<Texel, 4 * kDiskTableSize * kDiskTableSize>;

/// Four of a texel's six moments from `first` on, zero where there is none.
template <class Texel, class Convert>
constexpr Texture<Texel> texture(std::size_t first, Convert convert) {
  Texture<Texel> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t moment = first + i % 4;
    if (moment < 6) out[i] = convert(static_cast<float>(kTexels[i / 4 * 6 + moment]) * 0x1p-30f);
  }
  return out;
}

constexpr auto kAsFloat = [](float x) { return x; };
constexpr auto kAsHalf = [](float x) { return halfFromFloat(x); };
constexpr Texture<float> kFloats[2] = {texture<float>(0, kAsFloat), texture<float>(4, kAsFloat)};
constexpr Texture<std::uint16_t> kHalves[2] = {texture<std::uint16_t>(0, kAsHalf), texture<std::uint16_t>(4, kAsHalf)};

}  // namespace

template <int B>
RadianceSH<B> DiskTableView::project(const DiskLight& light, Vec3 p, float footprint) const noexcept {
  const detail::LocalDisk disk = detail::localDisk(light, p, footprint);
  if (!disk.lit) return {};
  const auto seen = detail::viewOf<float>(disk);
  return detail::shOfDisk<B>(disk, seen, detail::tabulatedMoments<B>(*this, seen.cone), light.radiance);
}

template RadianceSH<2> DiskTableView::project<2>(const DiskLight&, Vec3, float) const noexcept;
template RadianceSH<3> DiskTableView::project<3>(const DiskLight&, Vec3, float) const noexcept;
template RadianceSH<4> DiskTableView::project<4>(const DiskLight&, Vec3, float) const noexcept;
template RadianceSH<5> DiskTableView::project<5>(const DiskLight&, Vec3, float) const noexcept;

std::span<const float> DiskTable::data(int texture) noexcept { return kFloats[texture]; }
std::span<const std::uint16_t> DiskTable::halfData(int texture) noexcept { return kHalves[texture]; }
DiskTable::Provenance DiskTable::provenance() noexcept { return {kCommand, kVersion, kHash}; }

}  // namespace rigel
