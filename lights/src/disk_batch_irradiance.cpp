#include <algorithm>
#include <cassert>

#include "disk_batch_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "disk_batch_irradiance.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

/// What the points of a block see: of the cone, the normal in the frame, pi times the flux.
enum SeenRow { kSx, kCx, kSy, kT, kU, kNx, kNy, kNz, kScale, kSeenRows };

/// Packing writes a vector at a time, hence the room at the end.
constexpr std::size_t kRoom = kDiskBlock + Lane::kCount;

struct alignas(64) SeenPoints {
  float row[kSeenRows][kRoom];
};

struct Seen {
  DiskCone<Lane> cone;
  Lane nx, ny, nz, scale;

  HWY_INLINE Seen(const SeenPoints& from, std::size_t i)
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

  HWY_INLINE Lane clipped() const { return scale * diskLambert(cone, nx, ny, nz); }
};

HWY_NOINLINE void seeBlock(const DiskBatchLight& light, const float* x, const float* y, const float* z, const float* nx,
                           const float* ny, const float* nz, std::size_t points, SeenPoints& seen) {
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

/// What points receive that no horizon crosses. How many others there are.
HWY_NOINLINE std::size_t wholeBlock(const SeenPoints& seen, std::size_t points, float* irradiance) {
  std::size_t crossed = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const Seen at(seen, i);
    (at.scale * max(at.nz, Lane(0.0f))).store(irradiance + i);
    crossed += count(at.crossed());
  }
  return crossed;
}

HWY_NOINLINE void clipAll(const SeenPoints& seen, std::size_t points, float* irradiance) {
  for (std::size_t i = 0; i < points; i += Lane::kCount) Seen(seen, i).clipped().store(irradiance + i);
}

/// The points that the horizon crosses are put side by side first.
HWY_NOINLINE void clipCrossed(const SeenPoints& seen, std::size_t points, float* irradiance) {
  SeenPoints crossed;
  float index[kRoom], clipped[kRoom];
  std::size_t end = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const LaneMask where = Seen(seen, i).crossed();
    const LanePacker packer(where);
    for (int k = 0; k < kSeenRows; ++k) packer.store(Lane::load(seen.row[k] + i), crossed.row[k] + end);
    packer.store(hn::Iota(Lane::Tag(), static_cast<float>(i)), index + end);
    end += count(where);
  }
  for (auto& row : crossed.row) Lane(0.0f).store(row + end);
  clipAll(crossed, end, clipped);
  for (std::size_t i = 0; i < end; ++i) irradiance[static_cast<std::size_t>(index[i])] = clipped[i];
}

HWY_NOINLINE void irradianceBlock(const DiskBatchLight& light, const float* const* rows, std::size_t at,
                                  std::size_t points, float* irradiance) {
  SeenPoints seen;
  seeBlock(light, rows[0] + at, rows[1] + at, rows[2] + at, rows[3] + at, rows[4] + at, rows[5] + at, points, seen);
  const std::size_t crossed = wholeBlock(seen, points, irradiance);
  // Packing costs about a quarter of what clipping does.
  if (4 * crossed > 3 * points) return clipAll(seen, points, irradiance);
  if (crossed > 0) clipCrossed(seen, points, irradiance);
}

}  // namespace

void irradianceBatch(const DiskBatchLight& light, const Vec3Rows& points, const Vec3Rows& normals, float* irradiance) {
  const float* rows[] = {points.x.data(),  points.y.data(),  points.z.data(),
                         normals.x.data(), normals.y.data(), normals.z.data()};
  const std::size_t whole = points.size() - points.size() % Lane::kCount;
  for (std::size_t at = 0; at < whole; at += kDiskBlock)
    irradianceBlock(light, rows, at, std::min(kDiskBlock, whole - at), irradiance + at);
  if (const std::size_t rest = points.size() - whole) {
    float in[6][Lane::kCount] = {}, out[Lane::kCount];
    const float* const padded[] = {in[0], in[1], in[2], in[3], in[4], in[5]};
    for (int k = 0; k < 6; ++k) std::copy_n(rows[k] + whole, rest, in[k]);
    irradianceBlock(light, padded, 0, Lane::kCount, out);
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
