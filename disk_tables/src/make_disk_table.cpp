#include <rigel/disk.h>
#include <rigel/make_disk_table.h>
#include <rigel/shader_disk_table.h>

#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace rigel {
namespace {

constexpr int kMoments = 6;
/// What is left of the moments above one node, in the textures' order.
using Rest = std::array<double, kMoments>;

/// The cone at (U, V), from the definitions of both.
detail::DiskCone<double> coneAt(double placeU, double placeV) noexcept {
  const double u = std::pow(1 - placeV, 4.0 / 3.0);
  return detail::diskConeOf(std::sqrt(placeU * (2 - placeU)), 1 - placeU, std::sqrt((1 - u) * (1 + u)), u * u);
}

Rest restOf(const detail::DiskCone<double>& cone) noexcept {
  const detail::DiskMoments<double> exact = detail::exactDiskMoments(cone),
                                    node = detail::diskMomentsAtOneNode<5>(cone);
  return {exact.q00 - node.q00, exact.q20 - node.q20, exact.q22 - node.q22,
          exact.q40 - node.q40, exact.q42 - node.q42, exact.q44 - node.q44};
}

/// Between nodes h apart linear interpolation exceeds f by up to h^2 f''/8 where f'' > 0 and never falls below. Texels
/// lower by half of that share the error between both signs: half the largest one, and nothing to pay for it in the
/// look-up. Nodes on an edge are not moved across it, so that the table stays exact on the axis, on the face and far
/// away.
double equalised(const std::vector<Rest>& rest, int size, int i, int j, int moment) noexcept {
  const auto at = [&](int a, int b) { return rest[static_cast<std::size_t>(b * size + a)][moment]; };
  double bend = 0;
  if (i > 0 && i < size - 1) bend += at(i - 1, j) - 2 * at(i, j) + at(i + 1, j);
  if (j > 0 && j < size - 1) bend += at(i, j - 1) - 2 * at(i, j) + at(i, j + 1);
  return at(i, j) - bend / 16;
}

/// To a multiple of 2^-30: the quadrature's own rounding does not show, above all not where the rest is zero.
float rounded(double x) noexcept {
  return static_cast<float>(std::ldexp(std::nearbyint(std::ldexp(x, 30)), -30) + 0.0);
}

}  // namespace

DiskTableTexels makeDiskTable(int size, const std::function<void(double)>& progress) {
  assert(size >= kMinDiskTableSize && size <= kMaxDiskTableSize);
  const double last = size - 1;
  std::vector<Rest> rest;
  rest.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) rest.push_back(restOf(coneAt(i / last, j / last)));
    if (progress) progress((j + 1) / static_cast<double>(size));
  }

  DiskTableTexels table;
  table.size = size;
  for (std::vector<float>& texture : table.texels) texture.assign(4 * rest.size(), 0.0f);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const auto texel = static_cast<std::size_t>(4 * (j * size + i));
      for (int m = 0; m < kMoments; ++m) {
        table.texels[m / 4][texel + m % 4] = rounded(equalised(rest, size, i, j, m));
      }
    }
  }
  return table;
}

std::uint64_t hashDiskTable(std::span<const float> texture0, std::span<const float> texture1) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::span<const float> texture : {texture0, texture1}) {
    for (const float texel : texture) {
      const auto bits = std::bit_cast<std::uint32_t>(texel);
      for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ (bits >> shift & 0xffu)) * 0x100000001b3u;
    }
  }
  return hash;
}

}  // namespace rigel
