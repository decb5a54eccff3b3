// Moments of a cone from the textures, in the order of operations of disk.glsl.
#pragma once

#include <rigel/disk_table.h>
#include <rigel/shader_disk_table.h>

#include <algorithm>
#include <cstddef>

namespace rigel::detail {

/// One coordinate: the texel before it and how far it is towards the next.
struct TexelPlace {
  std::size_t index = 0;
  float share = 0;

  TexelPlace(float coordinate, int size) noexcept {
    const float last = static_cast<float>(size - 1);
    const float x = clamp(coordinate * last, 0.0f, last);
    const int before = std::min(static_cast<int>(x), size - 2);
    index = static_cast<std::size_t>(before);
    share = x - static_cast<float>(before);
  }
};

template <int B>
DiskMoments<float> tabulatedMoments(const DiskTableView& table, const DiskCone<float>& cone) noexcept {
  DiskMoments<float> q = diskMomentsAtOneNode<B>(cone);
  const TexelPlace u(diskTableU(cone), table.size), v(diskTableV(cone), table.size);
  const std::size_t row = 4 * static_cast<std::size_t>(table.size);
  const std::size_t corner = v.index * row + 4 * u.index;
  const auto fetch = [&](const float* texture, std::size_t channel) {
    const float* texel = texture + corner + channel;
    const float lower = texel[0] + (texel[4] - texel[0]) * u.share;
    const float upper = texel[row] + (texel[row + 4] - texel[row]) * u.share;
    return lower + (upper - lower) * v.share;
  };
  const float* texture0 = table.texture0.data();
  q.q00 += fetch(texture0, 0);
  if constexpr (B > 2) {
    q.q20 += fetch(texture0, 1);
    q.q22 += fetch(texture0, 2);
  }
  if constexpr (B > 4) {
    const float* texture1 = table.texture1.data();
    q.q40 += fetch(texture0, 3);
    q.q42 += fetch(texture1, 0);
    q.q44 += fetch(texture1, 1);
  }
  return q;
}

}  // namespace rigel::detail
