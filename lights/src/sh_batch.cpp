#include <rigel/sh_batch.h>
#include <rigel/shader_constants.h>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "project_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sh_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lane_polynomials.h"

#ifndef RIGEL_SH_BATCH_VIEW
#define RIGEL_SH_BATCH_VIEW
namespace rigel {
namespace {

/// `count` points: rows of normals and of three colours, and what is summed.
struct ShBatch {
  const float* normal[3];
  std::size_t count;
  const float* sh;  // `vectors` times 3 B^2
  std::size_t vectors;
  const float* weights;  // a row of `stride` a vector
  std::size_t stride;    // at least `count`
  const float* scale;    // of the polynomials: what the basis and E(n) multiply them by
  float* irradiance[3];
};

/// More than a vector has lanes on any machine.
constexpr std::size_t kMostLanes = 16;

}  // namespace
}  // namespace rigel
#endif

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {
namespace {

// Two vectors of points take turns at a coefficient where there are registers for both.
constexpr int kSideBySide = HWY_MAX_BYTES == 64 ? 2 : 1;

template <int L>
constexpr int kPolynomials = (L + 1) * (L + 1);

template <int L>
HWY_INLINE void scaledPolynomials(const ShBatch& batch, std::size_t i, int first, Lane* y) {
  polynomials<L>(Lane::load(batch.normal[0] + i), Lane::load(batch.normal[1] + i), Lane::load(batch.normal[2] + i), y);
  for (int j = first; j < kPolynomials<L>; ++j) y[j] *= Lane(batch.scale[j]);
}

/// `Vectors` vectors of points from i on.
template <int B, int Vectors>
HWY_INLINE void irradianceAt(const ShBatch& batch, std::size_t i, Lane (*sum)[3]) {
  constexpr int kBasis = B * B;
  constexpr int L = std::max(2, B - 1);
  Lane y[Vectors][kPolynomials<L>];
  for (int v = 0; v < Vectors; ++v) {
    scaledPolynomials<L>(batch, i + static_cast<std::size_t>(v) * Lane::kCount, 0, y[v]);
    for (int c = 0; c < 3; ++c) sum[v][c] = Lane(0.0f);
  }
  for (std::size_t k = 0; k < batch.vectors; ++k) {
    const float* sh = batch.sh + k * 3 * kBasis;
    Lane e[Vectors][3];
    for (int c = 0; c < 3; ++c)
      for (int v = 0; v < Vectors; ++v) e[v][c] = y[v][0] * Lane(sh[c]);
    for (int j = 1; j < kBasis; ++j)
      for (int c = 0; c < 3; ++c) {
        const Lane coefficient(sh[3 * j + c]);
        for (int v = 0; v < Vectors; ++v) e[v][c] = mulAdd(y[v][j], coefficient, e[v][c]);
      }
    for (int v = 0; v < Vectors; ++v) {
      const Lane weight = Lane::load(batch.weights + k * batch.stride + i + static_cast<std::size_t>(v) * Lane::kCount);
      for (int c = 0; c < 3; ++c) sum[v][c] = mulAdd(weight, e[v][c], sum[v][c]);
    }
  }
}

template <int Vectors>
HWY_INLINE void store(const ShBatch& batch, std::size_t i, const Lane (*sum)[3]) {
  for (int v = 0; v < Vectors; ++v)
    for (int c = 0; c < 3; ++c) sum[v][c].store(batch.irradiance[c] + i + static_cast<std::size_t>(v) * Lane::kCount);
}

/// At least a vector of points. The last vector ends at the last point, whatever the one before it did.
template <int B>
void irradianceOf(const ShBatch& batch) {
  constexpr std::size_t kStep = kSideBySide * Lane::kCount;
  Lane sum[kSideBySide][3];
  std::size_t i = 0;
  for (; i + kStep <= batch.count; i += kStep) {
    irradianceAt<B, kSideBySide>(batch, i, sum);
    store<kSideBySide>(batch, i, sum);
  }
  for (; i < batch.count; i += Lane::kCount) {
    const std::size_t at = std::min(i, batch.count - Lane::kCount);
    irradianceAt<B, 1>(batch, at, sum);
    store<1>(batch, at, sum);
  }
}

template <int L>
HWY_INLINE void addBandAt(const ShBatch& batch, std::size_t i, Lane* sum) {
  constexpr int kFirst = L * L;
  Lane y[kPolynomials<L>];
  scaledPolynomials<L>(batch, i, kFirst, y);
  for (int c = 0; c < 3; ++c) {
    sum[c] = Lane::load(batch.irradiance[c] + i);
    for (int j = kFirst; j < kPolynomials<L>; ++j) sum[c] = mulAdd(y[j], Lane(batch.sh[3 * (j - kFirst) + c]), sum[c]);
  }
}

template <int L>
void addBandOf(const ShBatch& batch) {
  // The last vector overlaps the one before it, so that it is read before that is written.
  const std::size_t last = batch.count - Lane::kCount;
  Lane sum[1][3], end[1][3];
  addBandAt<L>(batch, last, end[0]);
  for (std::size_t i = 0; i < last; i += Lane::kCount) {
    addBandAt<L>(batch, i, sum[0]);
    store<1>(batch, i, sum);
  }
  store<1>(batch, last, end);
}

}  // namespace

std::size_t lanesOfShBatch() { return Lane::kCount; }

void shBatchIrradiance(int bands, const ShBatch& batch) {
  switch (bands) {
    case 2:
      return irradianceOf<2>(batch);
    case 3:
      return irradianceOf<3>(batch);
    case 4:
      return irradianceOf<4>(batch);
    default:
      return irradianceOf<5>(batch);
  }
}

void shBatchBand(int l, const ShBatch& batch) { l == 3 ? addBandOf<3>(batch) : addBandOf<4>(batch); }

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(lanesOfShBatch);
HWY_EXPORT(shBatchIrradiance);
HWY_EXPORT(shBatchBand);

namespace {

/// pi f_l times the constants of the basis; `bands` f_l.
template <std::size_t Count>
void fillScale(std::span<const float> bands, std::array<float, Count>& scale) {
  for (std::size_t l = 0; l < bands.size(); ++l)
    for (std::size_t j = l * l; j < (l + 1) * (l + 1); ++j)
      scale[j] = static_cast<float>(kPi * static_cast<double>(bands[l]) * detail::kBasisScale[j]);
}

ShBatch batchOf(const Vec3Rows& normals, std::span<float> irradiance) {
  const std::size_t count = normals.size();
  assert(normals.y.size() == count && normals.z.size() == count && irradiance.size() == 3 * count);
  float* const out = irradiance.data();
  return {{normals.x.data(), normals.y.data(), normals.z.data()},
          count,
          nullptr,
          0,
          nullptr,
          0,
          nullptr,
          {out, out + count, out + 2 * count}};
}

/// Calls serve(batch) with at least a vector of points: fewer are copied to where there is room.
template <class Serve>
void withRoom(const ShBatch& batch, Serve serve) {
  if (batch.count >= HWY_DYNAMIC_DISPATCH(lanesOfShBatch)()) return serve(batch);
  float normal[3][kMostLanes] = {}, colour[3][kMostLanes] = {}, weights[kMaxShBatch][kMostLanes] = {};
  ShBatch padded = batch;
  padded.count = padded.stride = kMostLanes;
  padded.weights = weights[0];
  for (int c = 0; c < 3; ++c) {
    std::copy_n(batch.normal[c], batch.count, normal[c]);
    std::copy_n(batch.irradiance[c], batch.count, colour[c]);
    padded.normal[c] = normal[c];
    padded.irradiance[c] = colour[c];
  }
  for (std::size_t k = 0; k < batch.vectors; ++k)
    std::copy_n(batch.weights + k * batch.stride, batch.count, weights[k]);
  serve(padded);
  for (int c = 0; c < 3; ++c) std::copy_n(colour[c], batch.count, batch.irradiance[c]);
}

}  // namespace

template <int B>
void irradianceBatch(std::span<const RadianceSH<B>> sh, std::span<const float> weights,
                     const std::array<float, B>& bands, const Vec3Rows& normals, std::span<float> irradiance) noexcept {
  ShBatch batch = batchOf(normals, irradiance);
  assert(sh.size() <= kMaxShBatch && weights.size() == sh.size() * batch.count);
  if (batch.count == 0) return;
  std::array<float, shCount(std::max(3, B))> scale{};
  fillScale(bands, scale);
  batch.scale = scale.data();
  batch.sh = sh.empty() ? nullptr : sh[0].data();
  batch.vectors = sh.size();
  batch.weights = weights.data();
  batch.stride = batch.count;
  withRoom(batch, [](const ShBatch& b) { HWY_DYNAMIC_DISPATCH(shBatchIrradiance)(B, b); });
}

void addBandIrradianceBatch(int l, std::span<const Rgb> c, float f, const Vec3Rows& normals,
                            std::span<float> irradiance) noexcept {
  assert((l == 3 || l == 4) && c.size() == static_cast<std::size_t>(2 * l + 1));
  ShBatch batch = batchOf(normals, irradiance);
  if (batch.count == 0) return;
  std::array<float, kMaxBands> bands{};
  bands[static_cast<std::size_t>(l)] = f;
  std::array<float, shCount(kMaxBands)> scale{};
  fillScale(bands, scale);
  batch.scale = scale.data();
  batch.sh = &c[0].r;
  withRoom(batch, [l](const ShBatch& b) { HWY_DYNAMIC_DISPATCH(shBatchBand)(l, b); });
}

template void irradianceBatch<2>(std::span<const RadianceSH<2>>, std::span<const float>, const std::array<float, 2>&,
                                 const Vec3Rows&, std::span<float>) noexcept;
template void irradianceBatch<3>(std::span<const RadianceSH<3>>, std::span<const float>, const std::array<float, 3>&,
                                 const Vec3Rows&, std::span<float>) noexcept;
template void irradianceBatch<4>(std::span<const RadianceSH<4>>, std::span<const float>, const std::array<float, 4>&,
                                 const Vec3Rows&, std::span<float>) noexcept;
template void irradianceBatch<5>(std::span<const RadianceSH<5>>, std::span<const float>, const std::array<float, 5>&,
                                 const Vec3Rows&, std::span<float>) noexcept;

}  // namespace rigel
#endif
