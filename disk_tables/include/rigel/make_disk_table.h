// Makes the texels of the disk table (disk_table.h has them embedded at 32x32): for the program and for studies. What
// they hold is said in shader_disk_table.h.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rigel {

inline constexpr int kMinDiskTableSize = 2;
inline constexpr int kMaxDiskTableSize = 1024;

/// Goes up by one where the same size would give other texels.
inline constexpr int kDiskTableVersion = 1;

/// Two RGBA textures, rows along U, row 0 at V = 0.
struct DiskTableTexels {
  int size = 0;
  std::vector<float> texels[2];  // 4 size^2 floats each
};

/// `size` from kMinDiskTableSize to kMaxDiskTableSize. Moments in double, as projectDiskExact (disk.h) has
/// them. Takes about 3 us a texel; allocates. `progress` is told the share done, row by row.
DiskTableTexels makeDiskTable(int size, const std::function<void(double)>& progress = {});

/// FNV-1a (64 bits) of the texels' bytes, texture 0 first, each float from its least significant byte.
std::uint64_t hashDiskTable(std::span<const float> texture0, std::span<const float> texture1) noexcept;

}  // namespace rigel
