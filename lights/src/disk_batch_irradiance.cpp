#include <rigel/shader_disk_near.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cassert>

#include "disk_batch_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "disk_batch_irradiance.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_batch_kernels.h"
#include "disk_lanes.h"

#include "block_lanes.h"
#include "near_lanes.h"

#undef RIGEL_SHADER_DISK_NEAR_H
HWY_BEFORE_NAMESPACE();
#include <rigel/shader_disk_near.h>

namespace rigel::HWY_NAMESPACE {

namespace {

/// What the points of a block see: of the cone, the normal in the frame, pi times the flux.
enum SeenRow { kSx, kCx, kSy, kT, kU, kNx, kNy, kNz, kScale, kSeenRows };

struct Seen {
  using Rows = BlockRows<kSeenRows>;
  DiskCone<Lane> cone;
  Lane nx, ny, nz, scale;

  HWY_INLINE Seen(const Rows& from, std::size_t i)
      : nx(Lane::load(from.row[kNx] + i)),
        ny(Lane::load(from.row[kNy] + i)),
        nz(Lane::load(from.row[kNz] + i)),
        scale(Lane::load(from.row[kScale] + i)) {
    cone.sx = Lane::load(from.row[kSx] + i);
    cone.cx = Lane::load(from.row[kCx] + i);
    cone.sy = Lane::load(from.row[kSy] + i);
    cone.t = Lane::load(from.row[kT] + i);
    cone.u = Lane::load(from.row[kU] + i);
    cone.cy = cone.cx * cone.u;
    cone.sx2 = cone.sx * cone.sx;
    cone.cx2 = cone.cx * cone.cx;
    cone.sy2 = cone.sy * cone.sy;
    cone.cy2 = cone.cy * cone.cy;
  }

  /// Where the horizon crosses the disk, as diskLambert sees it; else the light is seen whole or not at all.
  HWY_INLINE LaneMask crossed() const {
    const Lane ex = cone.sx * cone.u * nx, ey = cone.sy * ny, ez = cone.cy * nz;
    return ez * ez < ex * ex + ey * ey && scale > Lane(0.0f);
  }

  HWY_INLINE Lane whole() const { return scale * max(nz, Lane(0.0f)); }
  HWY_INLINE Lane clipped() const { return scale * diskLambert(cone, nx, ny, nz); }

  /// No horizon: what there is of one is in the kernel.
  HWY_INLINE Lane wrapped(const NearWrap& wrap) const {
    const Lane e = scale * diskWrapped(diskMoments6<kMaxBands>(cone), cone, nx, ny, nz, wrap);
    return select(scale > Lane(0.0f), e, Lane(0.0f));
  }
};

HWY_NOINLINE void seeBlock(const DiskBatchLight& light, const SurfaceRows& surface, std::size_t points,
                           Seen::Rows& seen) {
  const auto [x, y, z, nx, ny, nz] = surface.row;
  DiskGaps gaps;
  gapsOfBlock(light, x, y, z, points, gaps);
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const DiskView<Lane> view = viewFrom(light, x + i, y + i, z + i, gaps.along + i, gaps.m + i);
    const Lane wx = Lane::load(nx + i), wy = Lane::load(ny + i), wz = Lane::load(nz + i);
    view.cone.sx.store(seen.row[kSx] + i);
    view.cone.cx.store(seen.row[kCx] + i);
    view.cone.sy.store(seen.row[kSy] + i);
    view.cone.t.store(seen.row[kT] + i);
    view.cone.u.store(seen.row[kU] + i);
    (view.xx * wx + view.xy * wy + view.xz * wz).store(seen.row[kNx] + i);
    (view.yx * wx + view.yy * wy + view.yz * wz).store(seen.row[kNy] + i);
    (view.zx * wx + view.zy * wy + view.zz * wz).store(seen.row[kNz] + i);
    (Lane(kRigelPi) * view.flux).store(seen.row[kScale] + i);
  }
}

HWY_NOINLINE void wrappedBlock(const Seen::Rows& seen, std::size_t points, const NearWrap& wrap, float* irradiance) {
  for (std::size_t i = 0; i < points; i += Lane::kCount) Seen(seen, i).wrapped(wrap).store(irradiance + i);
}

HWY_NOINLINE void lambertBlock(const DiskBatchLight& light, const SurfaceRows& surface, std::size_t points,
                               float* irradiance) {
  Seen::Rows seen;
  seeBlock(light, surface, points, seen);
  irradianceOf<Seen>(seen, points, irradiance);
}

}  // namespace

void diskIrradianceBlock(const DiskBatchLight& light, const SurfaceRows& surface, std::size_t points,
                         const NearWrap& wrap, float* irradiance) {
  if (wrap.a == 0) {
    lambertBlock(light, surface, points, irradiance);
    for (std::size_t i = 0; wrap.gain != 1 && i < points; i += Lane::kCount)
      (Lane(wrap.gain) * Lane::load(irradiance + i)).store(irradiance + i);
    return;
  }
  Seen::Rows seen;
  seeBlock(light, surface, points, seen);
  wrappedBlock(seen, points, wrap, irradiance);
}

void irradianceBatch(const DiskBatchLight& light, const Vec3Rows& points, const Vec3Rows& normals, float* irradiance) {
  const std::span<const float> rows[] = {points.x, points.y, points.z, normals.x, normals.y, normals.z};
  const auto surfaceAt = [&](std::size_t at) {
    SurfaceRows surface;
    for (int k = 0; k < 6; ++k) surface.row[k] = rows[k].data() + at;
    return surface;
  };
  const std::size_t whole = points.size() - points.size() % Lane::kCount;
  for (std::size_t at = 0; at < whole; at += kPointBlock)
    lambertBlock(light, surfaceAt(at), std::min(kPointBlock, whole - at), irradiance + at);
  if (const std::size_t rest = points.size() - whole) {
    float in[6][Lane::kCount] = {}, out[Lane::kCount];
    for (int k = 0; k < 6; ++k) std::copy_n(rows[k].data() + whole, rest, in[k]);
    lambertBlock(light, {{in[0], in[1], in[2], in[3], in[4], in[5]}}, Lane::kCount, out);
    std::copy_n(out, rest, irradiance + whole);
  }
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(irradianceBatch);

void diskIrradianceBatch(const DiskLight& light, const Vec3Rows& points, const Vec3Rows& normals,
                         std::span<float> irradiance) noexcept {
  assert(points.y.size() == points.size() && points.z.size() == points.size());
  assert(normals.x.size() == points.size() && normals.y.size() == points.size());
  assert(normals.z.size() == points.size() && irradiance.size() == points.size());
  const DiskBatchLight prepared(light);
  if (prepared.perRadius == 0) {
    std::ranges::fill(irradiance, 0.0f);
    return;
  }
  HWY_DYNAMIC_DISPATCH(irradianceBatch)(prepared, points, normals, irradiance.data());
}

}  // namespace rigel
#endif
