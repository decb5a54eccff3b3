#include "disk_batch_light.h"

#include <algorithm>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "disk_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_batch_kernels.h"
#include "disk_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

// A kernel goes through a block of points in short loops, what one leaves for the next staying in the first-level
// cache. One loop would be bound by latency: the chain of roots and divisions from a point to its SH is longer than a
// core looks ahead. None of the loops is inlined, for they are shared by numbers of bands and nodes.

/// Bands up to 4 need no third axis.
template <bool WithY>
HWY_NOINLINE void viewBlock(const DiskBatchLight& light, const float* x, const float* y, const float* z,
                            const DiskGaps& gaps, std::size_t lanes, DiskView<Lane>* views) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const std::size_t at = i * Lane::kCount;
    const DiskView<Lane> view = viewFrom(light, x + at, y + at, z + at, gaps.along + at, gaps.m + at);
    // What the later loops read, number by number: a copy of the whole would take longer than the computation.
    DiskView<Lane>& kept = views[i];
    kept.cone.sx2 = view.cone.sx2;
    kept.cone.cx2 = view.cone.cx2;
    kept.cone.sy2 = view.cone.sy2;
    kept.cone.cy2 = view.cone.cy2;
    kept.cone.cx = view.cone.cx;
    kept.flux = view.flux;
    kept.xx = view.xx;
    kept.xy = view.xy;
    kept.xz = view.xz;
    kept.zx = view.zx;
    kept.zy = view.zy;
    kept.zz = view.zz;
    if constexpr (WithY) {
      kept.yx = view.yx;
      kept.yy = view.yy;
      kept.yz = view.yz;
    }
  }
}

template <int B, int Nodes>
HWY_NOINLINE void momentsBlock(const DiskView<Lane>* views, std::size_t lanes, DiskMoments<Lane>* moments) {
  for (std::size_t i = 0; i < lanes; ++i) {
    if constexpr (Nodes == 4) moments[i] = diskMoments4<B>(views[i].cone);
    if constexpr (Nodes == 6) moments[i] = diskMoments6<B>(views[i].cone);
    if constexpr (Nodes == 8) moments[i] = diskMoments8<B>(views[i].cone);
  }
}

template <int Count>
HWY_INLINE void storeBand(const Lane* band, Lane scale, float* sh, std::size_t stride) {
  for (int k = 0; k < Count; ++k) (scale * band[k]).store(sh + k * stride);
}

template <int B>
HWY_NOINLINE void worldBlock(const DiskView<Lane>* views, const DiskMoments<Lane>* moments, std::size_t lanes,
                             float* sh, std::size_t stride) {
  for (std::size_t i = 0; i < lanes; ++i, sh += Lane::kCount) {
    const DiskView<Lane>& view = views[i];
    const DiskMoments<Lane>& q = moments[i];
    const Lane scale = Lane(kRigelPi) * view.flux;
    (scale * q.q00).store(sh);
    const Lane band1[] = {view.zy, view.zz, view.zx};
    storeBand<3>(band1, Lane(kRigelY1) * scale, sh + stride, stride);
    Lane band[9];
    if constexpr (B > 2) {
      diskBand2(q, view, band);
      storeBand<5>(band, scale, sh + 4 * stride, stride);
    }
    if constexpr (B > 3) {
      diskBand3(q, view, band);
      storeBand<7>(band, scale, sh + 9 * stride, stride);
    }
    if constexpr (B > 4) {
      diskBand4(q, view, band);
      storeBand<9>(band, scale, sh + 16 * stride, stride);
    }
  }
}

template <int B, int Nodes>
HWY_NOINLINE void projectPoints(const DiskBatchLight& light, const Vec3Rows& points, float* sh) {
  DiskGaps gaps;
  DiskView<Lane> views[kDiskBlockLanes];
  DiskMoments<Lane> moments[kDiskBlockLanes];
  const auto project = [&](const float* x, const float* y, const float* z, std::size_t count, float* out,
                           std::size_t stride) HWY_ATTR {
    const std::size_t lanes = count / Lane::kCount;
    gapsOfBlock(light, x, y, z, count, gaps);
    viewBlock<(B > 4)>(light, x, y, z, gaps, lanes, views);
    momentsBlock<B, Nodes>(views, lanes, moments);
    worldBlock<B>(views, moments, lanes, out, stride);
  };
  const std::size_t whole = points.size() - points.size() % Lane::kCount;
  for (std::size_t at = 0; at < whole; at += kPointBlock)
    project(&points.x[at], &points.y[at], &points.z[at], std::min(kPointBlock, whole - at), sh + at, points.size());
  if (const std::size_t rest = points.size() - whole) {
    float x[Lane::kCount] = {}, y[Lane::kCount] = {}, z[Lane::kCount] = {}, out[B * B * Lane::kCount];
    std::copy_n(&points.x[whole], rest, x);
    std::copy_n(&points.y[whole], rest, y);
    std::copy_n(&points.z[whole], rest, z);
    project(x, y, z, Lane::kCount, out, Lane::kCount);
    for (int i = 0; i < B * B; ++i) std::copy_n(out + i * Lane::kCount, rest, sh + i * points.size() + whole);
  }
}

template <int B>
void projectBands(const DiskBatchLight& light, const Vec3Rows& points, int nodes, float* sh) {
  if (nodes == 4) return projectPoints<B, 4>(light, points, sh);
  if (nodes == 6) return projectPoints<B, 6>(light, points, sh);
  return projectPoints<B, 8>(light, points, sh);
}

}  // namespace

void projectDiskPoints(const DiskBatchLight& light, const Vec3Rows& points, int bands, int nodes, float* sh) {
  if (bands == 2) return projectBands<2>(light, points, nodes, sh);
  if (bands == 3) return projectBands<3>(light, points, nodes, sh);
  if (bands == 4) return projectBands<4>(light, points, nodes, sh);
  return projectBands<5>(light, points, nodes, sh);
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(projectDiskPoints);

template <int B>
void projectDiskBatch(const DiskLight& light, const Vec3Rows& points, DiskNodes nodes, std::span<float> sh) noexcept {
  assert(points.y.size() == points.size() && points.z.size() == points.size());
  assert(sh.size() == B * B * points.size());
  const DiskBatchLight prepared(light);
  if (prepared.perRadius == 0) {
    std::ranges::fill(sh, 0.0f);
    return;
  }
  HWY_DYNAMIC_DISPATCH(projectDiskPoints)(prepared, points, B, static_cast<int>(nodes), sh.data());
}

template void projectDiskBatch<2>(const DiskLight&, const Vec3Rows&, DiskNodes, std::span<float>) noexcept;
template void projectDiskBatch<3>(const DiskLight&, const Vec3Rows&, DiskNodes, std::span<float>) noexcept;
template void projectDiskBatch<4>(const DiskLight&, const Vec3Rows&, DiskNodes, std::span<float>) noexcept;
template void projectDiskBatch<5>(const DiskLight&, const Vec3Rows&, DiskNodes, std::span<float>) noexcept;

}  // namespace rigel
#endif
