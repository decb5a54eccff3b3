// Fit and packing of a block.
#include "crowd_block.h"

#include <rigel/half.h>

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowd_fit.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigel::crowd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Vec = hn::Vec<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kBlock % kLanes == 0);

using Tag4 = hn::CappedTag<float, 4>;
using Vec4 = hn::Vec<Tag4>;
constexpr std::size_t kLanes4 = hn::MaxLanes(Tag4());

// A tile of the product stays in registers: 32 of 64 bytes, 16 of less.
constexpr int kTileColumns = 3;  // divides 3 B^2
constexpr int kTileRows = kLanes == 16 ? 6 : 3;

/// Vectors k to k + Rows, coefficients i to i + kTileColumns.
template <int Rows, bool Same>
HWY_INLINE void fitTile(const FitView& fit, int g, int k, int i, float* rows) {
  const Tag tag;
  const std::ptrdiff_t points = static_cast<std::ptrdiff_t>(fit.samples) * fit.characters;
  const float* sums = fit.sums + i * points + g;
  Vec c[Rows][kTileColumns];
  for (int r = 0; r < Rows; ++r)
    for (int j = 0; j < kTileColumns; ++j) c[r][j] = hn::Zero(tag);
  for (int s = 0; s < fit.samples; ++s, sums += fit.characters) {
    Vec f[kTileColumns];
    for (int j = 0; j < kTileColumns; ++j) f[j] = hn::LoadU(tag, sums + j * points);
    for (int r = 0; r < Rows; ++r) {
      const std::ptrdiff_t entry = (k + r) * fit.samples + s;
      const Vec p = Same ? hn::Set(tag, fit.op[entry]) : hn::Load(tag, fit.op + entry * kBlock + g);
      for (int j = 0; j < kTileColumns; ++j) c[r][j] = hn::MulAdd(p, f[j], c[r][j]);
    }
  }
  const Vec scale = hn::Set(tag, fit.scale);
  for (int r = 0; r < Rows; ++r)
    for (int j = 0; j < kTileColumns; ++j) {
      hn::Store(hn::Mul(c[r][j], scale), tag, rows + ((k + r) * fit.padded + i + j) * kBlock + g);
    }
}

template <bool Same>
void fitLanes(const FitView& fit, int g, float* rows) {
  const Tag tag;
  for (int i = 0; i < fit.width; i += kTileColumns) {
    int k = 0;
    for (; k + kTileRows <= fit.vectors; k += kTileRows) fitTile<kTileRows, Same>(fit, g, k, i, rows);
    for (; k + 2 <= fit.vectors; k += 2) fitTile<2, Same>(fit, g, k, i, rows);
    if (k < fit.vectors) fitTile<1, Same>(fit, g, k, i, rows);
  }
  for (int k = 0; k < fit.vectors; ++k)
    for (int i = fit.width; i < fit.padded; ++i)
      hn::Store(hn::Zero(tag), tag, rows + (k * fit.padded + i) * kBlock + g);
}

}  // namespace

void fitBlock(const FitView& fit, float* rows) {
  for (int g = 0; g < fit.characters; g += kLanes)
    fit.same ? fitLanes<true>(fit, g, rows) : fitLanes<false>(fit, g, rows);
}

void transposeRows(const float* rows, int count, int characters, float* const* out) {
  for (int c = 0; c < characters; c += 4) {
    const int some = std::min(4, characters - c);
    for (int i = 0; i < count; i += 4) {
      const float* from = rows + i * kBlock + c;
      float* const* to = out + c;
#if HWY_TARGET == HWY_SCALAR
      for (int k = 0; k < some; ++k)
        for (int j = 0; j < 4; ++j) to[k][i + j] = from[j * kBlock + k];
#else
      const Tag4 tag;
      const Vec4 r0 = hn::Load(tag, from), r1 = hn::Load(tag, from + kBlock);
      const Vec4 r2 = hn::Load(tag, from + 2 * kBlock), r3 = hn::Load(tag, from + 3 * kBlock);
      const Vec4 low02 = hn::InterleaveLower(tag, r0, r2), high02 = hn::InterleaveUpper(tag, r0, r2);
      const Vec4 low13 = hn::InterleaveLower(tag, r1, r3), high13 = hn::InterleaveUpper(tag, r1, r3);
      hn::StoreU(hn::InterleaveLower(tag, low02, low13), tag, to[0] + i);
      if (some > 1) hn::StoreU(hn::InterleaveUpper(tag, low02, low13), tag, to[1] + i);
      if (some > 2) hn::StoreU(hn::InterleaveLower(tag, high02, high13), tag, to[2] + i);
      if (some > 3) hn::StoreU(hn::InterleaveUpper(tag, high02, high13), tag, to[3] + i);
#endif
    }
  }
}

void blend(const float* a, const float* b, float t, std::size_t count, float* out) {
  const Tag4 tag;
  const Vec4 share = hn::Set(tag, t);
  for (std::size_t i = 0; i < count; i += kLanes4) {
    const Vec4 from = hn::LoadU(tag, a + i);
    hn::StoreU(hn::MulAdd(hn::Sub(hn::LoadU(tag, b + i), from), share, from), tag, out + i);
  }
}

float largestOf(const float* values, std::size_t count) {
  const Tag4 tag;
  Vec4 largest = hn::Zero(tag);
  for (std::size_t i = 0; i < count; i += kLanes4) {
    const Vec4 magnitude = hn::Abs(hn::LoadU(tag, values + i));
    const Vec4 finite =
        hn::IfThenElseZero(hn::Le(magnitude, hn::Set(tag, std::numeric_limits<float>::max())), magnitude);
    largest = hn::Max(largest, finite);
  }
  return hn::GetLane(hn::MaxOfLanes(tag, largest));
}

void storeHalves(const float* values, float inverseScale, std::size_t count, GpuHalf4* out) {
#if HWY_TARGET <= HWY_AVX2
  const Tag4 tag;
  const hn::Rebind<hwy::float16_t, Tag4> halves;
  const Vec4 scale = hn::Set(tag, inverseScale);
  for (std::size_t i = 0; i < count; i += 4)
    hn::StoreU(hn::DemoteTo(halves, hn::Mul(hn::LoadU(tag, values + i), scale)), halves,
               reinterpret_cast<hwy::float16_t*>(&out[i / 4]));
#else
  for (std::size_t i = 0; i < count; i += 4)
    out[i / 4] = {halfFromFloat(values[i] * inverseScale), halfFromFloat(values[i + 1] * inverseScale),
                  halfFromFloat(values[i + 2] * inverseScale), halfFromFloat(values[i + 3] * inverseScale)};
#endif
}

}  // namespace rigel::crowd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::crowd {

HWY_EXPORT(fitBlock);
HWY_EXPORT(transposeRows);
HWY_EXPORT(blend);
HWY_EXPORT(largestOf);
HWY_EXPORT(storeHalves);

void fitBlock(const FitView& fit, float* rows) noexcept { HWY_DYNAMIC_DISPATCH(fitBlock)(fit, rows); }
void transposeRows(const float* rows, int count, int characters, float* const* out) noexcept {
  HWY_DYNAMIC_DISPATCH(transposeRows)(rows, count, characters, out);
}
void blend(const float* a, const float* b, float t, std::size_t count, float* out) noexcept {
  HWY_DYNAMIC_DISPATCH(blend)(a, b, t, count, out);
}
float largestOf(const float* values, std::size_t count) noexcept {
  return HWY_DYNAMIC_DISPATCH(largestOf)(values, count);
}
void storeHalves(const float* values, float inverseScale, std::size_t count, GpuHalf4* out) noexcept {
  HWY_DYNAMIC_DISPATCH(storeHalves)(values, inverseScale, count, out);
}

}  // namespace rigel::crowd
#endif
