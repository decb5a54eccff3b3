// With A the light's flux at one metre, w the unit vector towards it, e = A/d^2 and k_l, h_l = k_l as in zonal.h:
//
//   q_lm      = e k_l Y_lm(w)
//   d q_lm/dp = (e/d) [ (P_l(c)/c + l k_l) Y_lm(w) w - k_l grad(r^l Y_lm)(w) ]
//
// (project.cpp). Lights are dealt with in blocks: their numbers are brought into rows of lanes, made into the rows of
// basis functions and slopes, and each row is then added up, times three colours, in registers.
#include <rigel/far_lights.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "project_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "far_lights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lane.h"
#include "lane_estimate.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {
namespace {

using detail::FarBlock;

constexpr int kBlock = FarBlock::kSize;
constexpr int kVectors = kBlock / static_cast<int>(Lane::kCount);

/// Value, then slopes along x, y, z, of each coefficient.
template <int B>
constexpr int kRows = 4 * B* B;

template <int B>
struct FarRows {
  Lane row[kRows<B>][kVectors];
};

HWY_INLINE Lane of(double constant) { return Lane(constant); }

/// The number, and its slopes from grad (r^l Y): `along` is P_l/c + l k.
template <int B>
HWY_INLINE void setRow(FarRows<B>& rows, int i, int v, Lane number, Lane gx, Lane gy, Lane gz, Lane k, Lane along,
                       Lane unit, const Lane (&w)[3], Lane inverse) {
  rows.row[4 * i][v] = unit * k * number;
  const Lane slope = unit * inverse;
  const Lane radial = slope * along * number;
  const Lane across = slope * k;
  rows.row[4 * i + 1][v] = negMulAdd(across, gx, radial * w[0]);
  rows.row[4 * i + 2][v] = negMulAdd(across, gy, radial * w[1]);
  rows.row[4 * i + 3][v] = negMulAdd(across, gz, radial * w[2]);
}

template <int B>
HWY_INLINE void seeVector(const FarBlock& block, Vec3 p, int v, FarRows<B>& rows) {
  const std::size_t at = static_cast<std::size_t>(v) * Lane::kCount;
  const Lane dx = Lane::load(block.x + at) - Lane(p.x), dy = Lane::load(block.y + at) - Lane(p.y),
             dz = Lane::load(block.z + at) - Lane(p.z);
  const Lane squaredRadius = Lane::load(block.squaredRadius + at);
  const Lane least = max(Lane(4.0f) * squaredRadius, Lane(1e-30f));
  const Lane square = max(mulAdd(dx, dx, mulAdd(dy, dy, dz * dz)), least);
  const Lane inverse = inverseRoot(square);
  const Lane unit = inverse * inverse;
  const Lane w[3] = {dx * inverse, dy * inverse, dz * inverse};
  const Lane c = root(negMulAdd(squaredRadius, unit, Lane(1.0f)));
  const Lane perC = quotient(Lane(1.0f), c);
  const Lane zero(0.0f), half(0.5f);

  const Lane k0 = quotient(Lane(1.0f), Lane(1.0f) + c);
  setRow<B>(rows, 0, v, of(kRigelY00), zero, zero, zero, k0, perC, unit, w, inverse);
  const Lane y1 = of(kRigelY1), along1(1.5f);
  setRow<B>(rows, 1, v, y1 * w[1], zero, y1, zero, half, along1, unit, w, inverse);
  setRow<B>(rows, 2, v, y1 * w[2], zero, zero, y1, half, along1, unit, w, inverse);
  setRow<B>(rows, 3, v, y1 * w[0], y1, zero, zero, half, along1, unit, w, inverse);
  if constexpr (B > 2) {
    const Lane k2 = half * c;
    const Lane along2 = mulAdd(Lane(2.5f), c, -half * perC);
    const auto& [x, y, z] = w;
    const Lane y21 = of(kRigelY21), y20 = of(kRigelY20), y22 = of(kRigelY22), k20 = of(2 * kRigelY20);
    const Lane two(2.0f);
    setRow<B>(rows, 4, v, y22 * two * x * y, y21 * y, y21 * x, zero, k2, along2, unit, w, inverse);
    setRow<B>(rows, 5, v, y21 * y * z, zero, y21 * z, y21 * y, k2, along2, unit, w, inverse);
    setRow<B>(rows, 6, v, y20 * (two * z * z - mulAdd(x, x, y * y)), -k20 * x, -k20 * y, two * k20 * z, k2, along2,
              unit, w, inverse);
    setRow<B>(rows, 7, v, y21 * x * z, y21 * z, zero, y21 * x, k2, along2, unit, w, inverse);
    setRow<B>(rows, 8, v, y22 * (x - y) * (x + y), y21 * x, -y21 * y, zero, k2, along2, unit, w, inverse);
  }
}

/// Adds each row, times the colours, to sums[3 row + colour].
template <int B>
HWY_INLINE void addRows(const FarBlock& block, const FarRows<B>& rows, Lane* sums) {
  for (int c = 0; c < 3; ++c) {
    Lane flux[kVectors];
    for (int v = 0; v < kVectors; ++v) flux[v] = Lane::load(block.flux[c] + static_cast<std::size_t>(v) * Lane::kCount);
    for (int i = 0; i < kRows<B>; ++i) {
      Lane sum = sums[3 * i + c];
      for (int v = 0; v < kVectors; ++v) sum = mulAdd(rows.row[i][v], flux[v], sum);
      sums[3 * i + c] = sum;
    }
  }
}

template <int B>
HWY_NOINLINE void sumFar(std::span<const FarBlock> blocks, Vec3 p, float* out) {
  Lane sums[3 * kRows<B>];
  for (Lane& sum : sums) sum = Lane(0.0f);
  FarRows<B> rows;
  for (const FarBlock& block : blocks) {
    for (int v = 0; v < kVectors; ++v) seeVector<B>(block, p, v, rows);
    addRows<B>(block, rows, sums);
  }
  for (int i = 0; i < 3 * kRows<B>; ++i) out[i] = hn::GetLane(hn::SumOfLanes(Lane::Tag(), sums[i].v));
}

}  // namespace

void sumFarLights(std::span<const FarBlock> blocks, Vec3 p, int bands, float* out) {
  if (bands == 2) return sumFar<2>(blocks, p, out);
  return sumFar<3>(blocks, p, out);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {
namespace {

HWY_EXPORT(sumFarLights);

using detail::FarBlock;

/// Whether the light is among those that are made for this.
bool put(FarBlock& block, int i, const detail::PreparedLight& light, float share) noexcept {
  if (!isLocal(light)) return false;
  const float r2 = light.radiusSquare;
  // Also false for NaN.
  if (!(dot(light.position, light.position) < 1e30f && r2 < 1e30f)) return false;
  block.x[i] = light.position.x;
  block.y[i] = light.position.y;
  block.z[i] = light.position.z;
  block.squaredRadius[i] = r2;
  for (int c = 0; c < 3; ++c) block.flux[c][i] = light.colour[c] * (2 * share * (light.arealess ? r2 : 1));
  return true;
}

void clearFrom(FarBlock& block, int i) noexcept {
  for (; i < FarBlock::kSize; ++i) {
    block.x[i] = block.y[i] = block.z[i] = 0;
    block.squaredRadius[i] = 1;  // finite wherever it is seen from
    for (auto& flux : block.flux) flux[i] = 0;
  }
}

/// Fills the block from the front of `uses`, and leaves the rest of them.
void fill(FarBlock& block, const PreparedLights& lights, std::span<const LightUse>& uses) noexcept {
  int count = 0;
  std::size_t i = 0;
  for (; i < uses.size() && count < FarBlock::kSize; ++i)
    count += put(block, count, lights[uses[i].light], detail::heldShare(uses[i].share)) ? 1 : 0;
  clearFrom(block, count);
  uses = uses.subspan(i);
}

template <int B>
void accumulate(const FarBlock& block, Vec3 p, ProjectionWithGradient<B>& out) noexcept {
  for (int i = 0; i < FarBlock::kSize; ++i) {
    const Rgb intensity{block.flux[0][i] / 2, block.flux[1][i] / 2, block.flux[2][i] / 2};
    if (intensity == Rgb{}) continue;
    const ProjectionWithGradient<B> one = projectWithGradient<B>(
        PointLight{{block.x[i], block.y[i], block.z[i]}, intensity, std::sqrt(block.squaredRadius[i])}, p);
    out.value += one.value;
    for (int axis = 0; axis < 3; ++axis) out.gradient.d[axis] += one.gradient.d[axis];
  }
}

template <int B>
void accumulate(std::span<const FarBlock> blocks, Vec3 p, ProjectionWithGradient<B>& out) noexcept {
  if (!(dot(p, p) < 1e30f)) return;
  if constexpr (B > 3) {
    for (const FarBlock& block : blocks) accumulate<B>(block, p, out);
  } else {
    std::array<float, 12 * B * B> sums;
    HWY_DYNAMIC_DISPATCH(sumFarLights)(blocks, p, B, sums.data());
    for (int i = 0; i < B * B; ++i) {
      const float* row = sums.data() + 12 * i;
      out.value[i] += Rgb{row[0], row[1], row[2]};
      for (int axis = 0; axis < 3; ++axis)
        out.gradient.d[axis][i] += Rgb{row[3 * axis + 3], row[3 * axis + 4], row[3 * axis + 5]};
    }
  }
}

}  // namespace

void FarLightList::set(const PreparedLights& lights, std::span<const LightUse> uses) {
  blocks_.resize((uses.size() + FarBlock::kSize - 1) / FarBlock::kSize);
  for (FarBlock& block : blocks_) fill(block, lights, uses);
}

template <int B>
ProjectionWithGradient<B> projectFar(const FarLightList& lights, Vec3 p) noexcept {
  ProjectionWithGradient<B> out;
  accumulate<B>(lights.blocks(), p, out);
  return out;
}

template <int B>
ProjectionWithGradient<B> projectFar(const PreparedLights& lights, std::span<const LightUse> uses, Vec3 p) noexcept {
  ProjectionWithGradient<B> out;
  FarBlock blocks[4];
  for (std::span<const LightUse> rest = uses; !rest.empty();) {
    std::size_t count = 0;
    while (count < std::size(blocks) && !rest.empty()) fill(blocks[count++], lights, rest);
    accumulate<B>(std::span<const FarBlock>(blocks).first(count), p, out);
  }
  if (lights.anyDirectional()) out.value += detail::directionalSh<B>(lights, uses, {});
  return out;
}

#define RIGEL_INSTANTIATE(B)                                                                                         \
  template ProjectionWithGradient<B> projectFar<B>(const PreparedLights&, std::span<const LightUse>, Vec3) noexcept; \
  template ProjectionWithGradient<B> projectFar<B>(const FarLightList&, Vec3) noexcept;
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
#endif
