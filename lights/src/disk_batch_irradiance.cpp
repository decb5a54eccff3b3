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

/// The points of a block whose horizon crosses the disk, side by side: for all others the light is seen whole or not at
/// all. A vector is written at a time, hence the room at the end.
struct alignas(64) CrossedPoints {
  static constexpr std::size_t kRoom = kDiskBlock + Lane::kCount;

  float sx[kRoom] = {}, cx[kRoom] = {}, t[kRoom] = {}, u[kRoom] = {};  // of the cone
  float nx[kRoom] = {}, ny[kRoom] = {}, nz[kRoom] = {};                // the normal, in the frame
  float scale[kRoom] = {};
  float index[kRoom] = {};  // in the block
  std::size_t count = 0;
};

/// As diskLambert sees it.
HWY_INLINE LaneMask crossesHorizon(const DiskCone<Lane>& cone, Lane x, Lane y, Lane z) {
  const Lane ex = cone.sx * cone.u * x, ey = cone.sy * y, ez = cone.cy * z;
  return ez * ez < ex * ex + ey * ey;
}

/// What points receive that no horizon crosses; the others to `crossed`.
HWY_NOINLINE void wholeBlock(const DiskBatchLight& light, const float* x, const float* y, const float* z,
                             const float* nx, const float* ny, const float* nz, std::size_t points, float* irradiance,
                             CrossedPoints& crossed) {
  DiskGaps gaps;
  gapsOfBlock(light, x, y, z, points, gaps);
  std::size_t end = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const DiskView<Lane> view = viewFrom(light, x + i, y + i, z + i, gaps.along + i, gaps.m + i);
    const Lane wx = Lane::load(nx + i), wy = Lane::load(ny + i), wz = Lane::load(nz + i);
    const Lane normalX = view.xx * wx + view.xy * wy + view.xz * wz;
    const Lane normalY = view.yx * wx + view.yy * wy + view.yz * wz;
    const Lane normalZ = view.zx * wx + view.zy * wy + view.zz * wz;
    const Lane scale = Lane(kRigelPi) * view.flux;
    (scale * max(normalZ, Lane(0.0f))).store(irradiance + i);

    const auto where = crossesHorizon(view.cone, normalX, normalY, normalZ) && view.flux > Lane(0.0f);
    const LanePacker packer(where);
    packer.store(view.cone.sx, crossed.sx + end);
    packer.store(view.cone.cx, crossed.cx + end);
    packer.store(view.cone.t, crossed.t + end);
    packer.store(view.cone.u, crossed.u + end);
    packer.store(normalX, crossed.nx + end);
    packer.store(normalY, crossed.ny + end);
    packer.store(normalZ, crossed.nz + end);
    packer.store(scale, crossed.scale + end);
    packer.store(hn::Iota(Lane::Tag(), static_cast<float>(i)), crossed.index + end);
    end += count(where);
  }
  crossed.count = end;
}

HWY_NOINLINE void crossedBlock(const CrossedPoints& crossed, float* irradiance) {
  for (std::size_t i = 0; i < crossed.count; i += Lane::kCount) {
    const Lane u = Lane::load(crossed.u + i);
    const DiskCone<Lane> cone =
        diskConeOf(Lane::load(crossed.sx + i), Lane::load(crossed.cx + i), Lane::load(crossed.t + i), u * u);
    const Lane e =
        diskLambert(cone, Lane::load(crossed.nx + i), Lane::load(crossed.ny + i), Lane::load(crossed.nz + i));
    float out[Lane::kCount];
    (Lane::load(crossed.scale + i) * e).store(out);
    const std::size_t rest = std::min(Lane::kCount, crossed.count - i);
    for (std::size_t k = 0; k < rest; ++k) irradiance[static_cast<std::size_t>(crossed.index[i + k])] = out[k];
  }
}

}  // namespace

void irradianceBatch(const DiskBatchLight& light, const Vec3Rows& points, const Vec3Rows& normals, float* irradiance) {
  CrossedPoints crossed;
  const std::size_t whole = points.size() - points.size() % Lane::kCount;
  for (std::size_t at = 0; at < whole; at += kDiskBlock) {
    wholeBlock(light, &points.x[at], &points.y[at], &points.z[at], &normals.x[at], &normals.y[at], &normals.z[at],
               std::min(kDiskBlock, whole - at), irradiance + at, crossed);
    crossedBlock(crossed, irradiance + at);
  }
  if (const std::size_t rest = points.size() - whole) {
    float in[6][Lane::kCount] = {}, out[Lane::kCount];
    const float* rows[] = {points.x.data(),  points.y.data(),  points.z.data(),
                           normals.x.data(), normals.y.data(), normals.z.data()};
    for (int k = 0; k < 6; ++k) std::copy_n(rows[k] + whole, rest, in[k]);
    wholeBlock(light, in[0], in[1], in[2], in[3], in[4], in[5], Lane::kCount, out, crossed);
    crossedBlock(crossed, out);
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
