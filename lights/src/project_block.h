// What the kernels of project_batch.h read of lights and write of sums, the same for all Highway targets.
#pragma once

#include <rigel/prepared_lights.h>
#include <rigel/project.h>
#include <rigel/project_batch.h>
#include <rigel/shader_constants.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "light_blocks.h"
#include "sh_polynomials.h"

namespace rigel::detail {

/// Rows of so many lights stay in the first-level cache between two loops.
inline constexpr int kLightBlock = 32;
/// The same with derivatives, whose rows are three times as long.
inline constexpr int kSlopeBlock = 16;
/// Vectors of points that a block of lights serves while it is at hand.
inline constexpr int kTileVectors = 4;

/// Constants of the basis, as the kernels' polynomials leave them out (lane_polynomials.h).
inline constexpr double kBasisScale[] = {kRigelY00,
                                         kRigelY1,
                                         kRigelY1,
                                         kRigelY1,
                                         2 * kRigelY22,
                                         kRigelY21,
                                         kRigelY20,
                                         kRigelY21,
                                         kRigelY22,
                                         kRigelY33,
                                         kRigelY32,
                                         kRigelY31,
                                         kRigelY30,
                                         kRigelY31,
                                         kRigelY32,
                                         kRigelY33,
                                         2 * kRigelY44,
                                         kRigelY43,
                                         kRigelY42,
                                         kRigelY41,
                                         kRigelY40,
                                         kRigelY41,
                                         kRigelY42,
                                         kRigelY43,
                                         kRigelY44,
                                         0.65638205684017010281,
                                         2.07566231488104106,
                                         0.48923829943525038768,
                                         2.39676839248666199,
                                         0.45294665119569692130,
                                         0.11695032245342359644,
                                         0.45294665119569692130,
                                         2.39676839248666199,
                                         0.48923829943525038768,
                                         2.07566231488104106,
                                         0.65638205684017010281};

/// What the sums of weighBasis (project_lanes.h) are to be multiplied by: 2, the constants of the basis, and what
/// weighBasis leaves out of the bands' k_l.
template <int B>
constexpr std::array<float, shCount(B)> shScale() noexcept {
  constexpr double kLeftOut[] = {1, 1.0 / 2, 1.0 / 2, 1.0 / 8, 1.0 / 8};
  std::array<float, shCount(B)> scale{};
  for (int l = 0, i = 0; l < B; ++l)
    for (; i < shCount(l + 1); ++i)
      scale[static_cast<std::size_t>(i)] = static_cast<float>(2 * kLeftOut[l] * kBasisScale[i]);
  return scale;
}

/// The row of a use's shares, or null.
inline const float* shareRow(const PointShares& shares, std::size_t use) noexcept {
  return shares.rows.empty() ? nullptr : shares.rows[use];
}

/// SH of a directional light.
template <int B>
RadianceSH<B> directionalSh(const PreparedLight& light, float share) noexcept {
  RadianceSH<B> sh;
  float y[shCount(B)];
  basisPolynomials<B>(light.position, y);
  const Rgb colour = light.colour * heldShare(share);
  for (int i = 0; i < shCount(B); ++i) sh[i] = colour * y[i];
  return sh;
}

/// SH of the directional lights that are the same at every point.
template <int B>
RadianceSH<B> directionalSh(const PreparedLights& lights, std::span<const LightUse> uses,
                            const PointShares& shares) noexcept {
  RadianceSH<B> sh;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const PreparedLight& light = lights[uses[u].light];
    if (light.kind != PreparedKind::directional || shareRow(shares, u) != nullptr) continue;
    sh += directionalSh<B>(light, uses[u].share);
  }
  return sh;
}

}  // namespace rigel::detail
