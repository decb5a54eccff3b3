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

using detail::PreparedKind;
using detail::PreparedLight;

constexpr int kBlock = 64;
constexpr int kVectors = kBlock / static_cast<int>(Lane::kCount);

/// Of a block of lights; what is missing has flux 0.
struct FarBlock {
  alignas(64) float x[kBlock], y[kBlock], z[kBlock];  // from the point to the light
  alignas(64) float squaredRadius[kBlock];
  alignas(64) float flux[3][kBlock];  // times share
  int count = 0;

  void add(const PreparedLight& light, float share, Vec3 p) {
    const Vec3 d = light.position - p;
    const bool sphere = light.kind == PreparedKind::sphere;
    const float r2 = sphere ? light.radius * light.radius : light.radiusSquare;
    // Also false for NaN.
    if (!(dot(d, d) < 1e30f && r2 < 1e30f)) return;
    x[count] = d.x;
    y[count] = d.y;
    z[count] = d.z;
    squaredRadius[count] = r2;
    for (int c = 0; c < 3; ++c) flux[c][count] = light.colour[c] * (2 * share * (sphere ? r2 : 1));
    ++count;
  }

  void fill() {
    for (int i = count; i < kBlock; ++i) {
      x[i] = 1;
      y[i] = z[i] = squaredRadius[i] = flux[0][i] = flux[1][i] = flux[2][i] = 0;
    }
  }
};

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
HWY_INLINE void seeVector(const FarBlock& block, int v, FarRows<B>& rows) {
  const std::size_t at = static_cast<std::size_t>(v) * Lane::kCount;
  const Lane dx = Lane::load(block.x + at), dy = Lane::load(block.y + at), dz = Lane::load(block.z + at);
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
HWY_NOINLINE void addBlock(FarBlock& block, FarRows<B>& rows, Lane* sums) {
  block.fill();
  for (int v = 0; v < kVectors; ++v) seeVector<B>(block, v, rows);
  addRows<B>(block, rows, sums);
  block.count = 0;
}

template <int B>
void sumFar(const PreparedLights& lights, std::span<const LightUse> uses, Vec3 p, float* out) {
  Lane sums[3 * kRows<B>];
  for (Lane& sum : sums) sum = Lane(0.0f);
  FarBlock block;
  FarRows<B> rows;
  for (const LightUse& use : uses) {
    const PreparedLight& light = lights[use.light];
    const bool local =
        light.kind == PreparedKind::sphere || light.kind == PreparedKind::point || light.kind == PreparedKind::spot;
    if (!local) continue;
    block.add(light, detail::heldShare(use.share), p);
    if (block.count == kBlock) addBlock<B>(block, rows, sums);
  }
  if (block.count > 0) addBlock<B>(block, rows, sums);
  for (int i = 0; i < 3 * kRows<B>; ++i) out[i] = hn::GetLane(hn::SumOfLanes(Lane::Tag(), sums[i].v));
}

}  // namespace

void sumFarLights(const PreparedLights& lights, std::span<const LightUse> uses, Vec3 p, int bands, float* out) {
  if (bands == 2) return sumFar<2>(lights, uses, p, out);
  return sumFar<3>(lights, uses, p, out);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {
namespace {

HWY_EXPORT(sumFarLights);

template <int B, class Light>
void accumulate(const Light& light, Vec3 p, ProjectionWithGradient<B>& out) noexcept {
  const ProjectionWithGradient<B> one = projectWithGradient<B>(light, p);
  out.value += one.value;
  for (int axis = 0; axis < 3; ++axis) out.gradient.d[axis] += one.gradient.d[axis];
}

template <int B>
void accumulate(const detail::PreparedLight& light, float share, Vec3 p, ProjectionWithGradient<B>& out) noexcept {
  const Rgb colour = light.colour * share;
  if (light.kind == detail::PreparedKind::sphere)
    accumulate<B>(SphereLight{light.position, light.radius, colour * static_cast<float>(1 / kPi)}, p, out);
  if (light.kind == detail::PreparedKind::point || light.kind == detail::PreparedKind::spot)
    accumulate<B>(PointLight{light.position, colour, light.radius}, p, out);
}

}  // namespace

template <int B>
ProjectionWithGradient<B> projectFar(const PreparedLights& lights, std::span<const LightUse> uses, Vec3 p) noexcept {
  ProjectionWithGradient<B> out;
  if constexpr (B > 3) {
    for (const LightUse& use : uses) accumulate<B>(lights[use.light], detail::heldShare(use.share), p, out);
  } else {
    std::array<float, 12 * B * B> sums;
    HWY_DYNAMIC_DISPATCH(sumFarLights)(lights, uses, p, B, sums.data());
    for (int i = 0; i < B * B; ++i) {
      const float* row = sums.data() + 12 * i;
      out.value[i] = {row[0], row[1], row[2]};
      for (int axis = 0; axis < 3; ++axis)
        out.gradient.d[axis][i] = {row[3 * axis + 3], row[3 * axis + 4], row[3 * axis + 5]};
    }
  }
  if (lights.anyDirectional()) out.value += detail::directionalSh<B>(lights, uses, {});
  return out;
}

#define RIGEL_INSTANTIATE(B) \
  template ProjectionWithGradient<B> projectFar<B>(const PreparedLights&, std::span<const LightUse>, Vec3) noexcept;
RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
#endif
