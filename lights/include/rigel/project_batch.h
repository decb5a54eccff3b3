// Projection of many lights into SH at many points, in vectors as wide as the machine's (SSE4, AVX2, AVX-512 or NEON,
// chosen at run time by Highway): what project.h computes light by light and point by point.
//
// Points are in the lanes of a vector and one light after another is broadcast, so that no sum runs across lanes; a
// light at a vector of points goes through short loops (geometry and basis, then sums), what one leaves for the other
// staying in the first-level cache. Full vectors are worth having: the points of one call are to be a multiple of 16
// where that can be chosen.
#pragma once

#include <rigel/prepared_lights.h>
#include <rigel/project.h>
#include <rigel/vec3_rows.h>

#include <span>

namespace rigel {

/// Shares of lights that differ from point to point, as where points of several objects are in one call: point i takes
/// rows[u][i % period] (0 to 1) of the light of use u, where rows[u] is not null. A row is `period` numbers and kRowEnd
/// more that repeat its beginning, so that a vector may begin anywhere in it. Costs 1 % (all rows null) to 5 % (none).
struct PointShares {
  static constexpr std::size_t kRowEnd = 15;
  std::span<const float* const> rows;  // one a use, or empty: all of all
  std::size_t period = 1;
};

/// Addresses of what the caller uses next, one for each line of the cache: they are fetched while lights are projected,
/// which computes much and reads little, one after another over the whole time. Fetched at once they would be waited
/// for.
using LinesAhead = std::span<const void* const>;

/// Sum over `uses` of share times the light's SH at each point. Row 3 i + colour of `sums`, points.size() floats,
/// receives coefficient i (no pi, no f_l); what was there is overwritten. `footprints` [m]: of each point, as in
/// project.h, or empty for none. B in 2..5. Any count of points and lights, none included; the rows of points may have
/// any alignment. `sums` overlaps no input.
///
/// Errors per ||q|| of the light without its window and cone: as project.h where c < 0.7, in contact and inside;
/// farther off vectors to the light are rounded to float, which leaves 3e-7 as a rule, and in ten million cases 7e-7 of
/// 3 bands (6e-7 with AVX-512) and 1e-6 of 5. A spot's cone adds what float leaves of it, 3e-7 / (cosInner - cosOuter).
/// NaN, no radius, no direction, infinitely far: no light. Every result is finite: as project.h, but that flux held to
/// kMaxProjectionScale keeps its hue. The result at a point is the same whatever other points are in the call. No
/// allocation; any number of threads. A light within sqrt(2) radii (footprints) of a point takes the scalar functions'
/// time there.
template <int B>
void projectBatch(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                  std::span<const float> footprints, std::span<float> sums, const PointShares& shares = {},
                  LinesAhead ahead = {}) noexcept;

/// The same and its derivative by x, y and z of the point: 4 x 3 B^2 rows, value first. As projectWithGradient (no
/// footprints), within 3e-6 of the largest component of a light without window and cone; a cone's slope adds 1e-6 /
/// (cosInner - cosOuter)^2 of the light over its distance. Disks take the scalar function's time.
template <int B>
void projectBatchWithGradient(const PreparedLights& lights, std::span<const LightUse> uses, const Vec3Rows& points,
                              std::span<float> sums) noexcept;

}  // namespace rigel
