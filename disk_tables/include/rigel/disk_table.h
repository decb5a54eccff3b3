// Disk lights by two small textures: a look-up in place of the quadrature of disk.h, the same as shaders do it
// (shader_disk_table.h says what the textures hold). The data are constants of the program: a scene without disk lights
// touches none of them.
#pragma once

#include <rigel/light.h>
#include <rigel/sh.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace rigel {

inline constexpr int kDiskTableSize = 32;

/// Two RGBA textures of any size, not owned: what makeDiskTable (make_disk_table.h) gave, or DiskTable's own.
struct DiskTableView {
  int size = 0;
  std::span<const float> texture0, texture1;  // 4 size^2 floats each, rows along U, row 0 at V = 0

  /// SH of one light at `p`, as project (project.h) with all it says of hard cases and of `footprint`. Bands 1 and 3
  /// are exact, the others within 1.6e-4 of ||q|| at 32x32, 6e-4 at 16x16, 4e-5 at 64x64 (disk_tables/README.md). No
  /// allocation.
  template <int B>
  RadianceSH<B> project(const DiskLight& light, Vec3 p, float footprint = 0) const noexcept;
};

/// The embedded table, kDiskTableSize a side.
class DiskTable {
 public:
  /// As DiskTableView::project.
  template <int B>
  static RadianceSH<B> project(const DiskLight& light, Vec3 p, float footprint = 0) noexcept {
    return view().project<B>(light, p, footprint);
  }

  static DiskTableView view() noexcept { return {kDiskTableSize, data(0), data(1)}; }

  /// Texture 0 or 1 for upload: RGBA32F, or RGBA16F, which costs the result another 5e-5 of ||q||.
  static std::span<const float> data(int texture) noexcept;
  static std::span<const std::uint16_t> halfData(int texture) noexcept;

  /// Where the data come from, and hashDiskTable of them.
  struct Provenance {
    std::string_view command;
    int version;  // kDiskTableVersion of the program that wrote them
    std::uint64_t hash;
  };
  static Provenance provenance() noexcept;
};

}  // namespace rigel
