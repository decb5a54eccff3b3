#include <algorithm>
#include <cassert>

#include "disk_batch_light.h"

#define HWY_DISABLED_TARGETS RIGEL_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "disk_batch_irradiance.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

/// What diskLambert reads.
struct LitNormal {
  DiskCone<Lane> cone;
  Lane flux, x, y, z;
};

HWY_NOINLINE void normalBlock(const DiskBatchLight& light, const float* x, const float* y, const float* z,
                              const float* nx, const float* ny, const float* nz, std::size_t lanes, LitNormal* out) {
  DiskGaps gaps;
  gapsOfBlock(light, x, y, z, lanes * Lane::kCount, gaps);
  for (std::size_t i = 0; i < lanes; ++i) {
    const std::size_t at = i * Lane::kCount;
    const DiskView<Lane> view = viewFrom(light, x + at, y + at, z + at, gaps.along + at, gaps.m + at);
    const Lane nX = Lane::load(nx + at), nY = Lane::load(ny + at), nZ = Lane::load(nz + at);
    LitNormal& kept = out[i];
    kept.cone.sx2 = view.cone.sx2;
    kept.cone.cx2 = view.cone.cx2;
    kept.cone.sy2 = view.cone.sy2;
    kept.cone.cy2 = view.cone.cy2;
    kept.cone.sx = view.cone.sx;
    kept.cone.cx = view.cone.cx;
    kept.cone.sy = view.cone.sy;
    kept.cone.cy = view.cone.cy;
    kept.cone.t = view.cone.t;
    kept.cone.u = view.cone.u;
    kept.flux = view.flux;
    kept.x = view.xx * nX + view.xy * nY + view.xz * nZ;
    kept.y = view.yx * nX + view.yy * nY + view.yz * nZ;
    kept.z = view.zx * nX + view.zy * nY + view.zz * nZ;
  }
}

HWY_NOINLINE void lambertBlock(const LitNormal* in, std::size_t lanes, float* irradiance) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const Lane e = diskLambert(in[i].cone, in[i].x, in[i].y, in[i].z);
    (Lane(kRigelPi) * in[i].flux * e).store(irradiance + i * Lane::kCount);
  }
}

}  // namespace

void irradianceBatch(const DiskBatchLight& light, const Vec3Rows& points, const Vec3Rows& normals, float* irradiance) {
  LitNormal lit[kDiskBlockLanes];
  const std::size_t whole = points.size() - points.size() % Lane::kCount;
  for (std::size_t at = 0; at < whole; at += kDiskBlock) {
    const std::size_t lanes = std::min(kDiskBlock, whole - at) / Lane::kCount;
    normalBlock(light, &points.x[at], &points.y[at], &points.z[at], &normals.x[at], &normals.y[at], &normals.z[at],
                lanes, lit);
    lambertBlock(lit, lanes, irradiance + at);
  }
  if (const std::size_t rest = points.size() - whole) {
    float in[6][Lane::kCount] = {}, out[Lane::kCount];
    const float* rows[] = {points.x.data(),  points.y.data(),  points.z.data(),
                           normals.x.data(), normals.y.data(), normals.z.data()};
    for (int k = 0; k < 6; ++k) std::copy_n(rows[k] + whole, rest, in[k]);
    normalBlock(light, in[0], in[1], in[2], in[3], in[4], in[5], 1, lit);
    lambertBlock(lit, 1, out);
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
