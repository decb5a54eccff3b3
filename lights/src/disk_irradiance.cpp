// Height above the plane and distance from the rim are formed in double: they decide what a receiver near the rim sees,
// and what one near the plane.
#include "disk_irradiance.h"

#include <rigel/shader_disk_near.h>
#include <rigel/shader_disk_view.h>

#include <algorithm>
#include <cmath>

#include "vec3d.h"

namespace rigel::detail {
namespace {

constexpr auto kPiFloat = static_cast<float>(kPi);

/// The disk in its bisector frame and the normal there; the irradiance is `scale` times a function of both.
struct DiskPose {
  DiskView<float> view;
  float nx = 0, ny = 0, nz = 0;
  float scale = 0;  // pi sx sy; 0: no light arrives
};

DiskPlace<float> narrow(const DiskPlace<double>& place) noexcept {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(place.rho), f(place.z),  f(place.xx), f(place.xy), f(place.xz), f(place.yx),
          f(place.yy),  f(place.yz), f(place.zx), f(place.zy), f(place.zz)};
}

DiskPose poseOf(const NearLight& light, Vec3 p, Vec3 n) noexcept {
  DiskPose pose;
  const Vec3d toCentre = widen(light.position) - widen(p);
  const double d2 = dot(toCentre, toCentre);
  if (!(light.radius > 0) || !std::isfinite(d2)) return pose;
  // Beyond the reach a disk of the same power, seen as small as it is there.
  const double radius = std::max<double>(light.radius, std::sqrt(d2) / kRigelDiskReach);
  const double share = light.radius / radius;
  const Vec3d v = toCentre * (1 / radius);
  const Vec3d axis = directionOf(light.axis);
  const DiskPlace<double> place =
      diskPlace(v.x, v.y, v.z, axis.x, axis.y, axis.z, dot(v, axis), static_cast<double>(light.cosOuter));
  if (!(place.z > 0)) return pose;
  pose.view = diskView(narrow(place), static_cast<float>(dot(v, v) - 1));
  const DiskView<float>& view = pose.view;
  pose.nx = n.x * view.xx + n.y * view.xy + n.z * view.xz;
  pose.ny = n.x * view.yx + n.y * view.yy + n.z * view.yz;
  pose.nz = n.x * view.zx + n.y * view.zy + n.z * view.zz;
  pose.scale = kPiFloat * view.flux * static_cast<float>(share * share);
  return pose;
}

}  // namespace

float diskIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept {
  const DiskPose pose = poseOf(light, p, n);
  if (!(pose.scale > 0)) return 0;
  const DiskCone<float>& cone = pose.view.cone;
  if (wrap.a == 0) return pose.scale * wrap.gain * diskLambertBranched(cone, pose.nx, pose.ny, pose.nz);
  return pose.scale * diskWrapped(diskMoments6<5>(cone), cone, pose.nx, pose.ny, pose.nz, wrap);
}

float diskCheap(const NearLight& light, Vec3 p, Vec3 n) noexcept {
  const DiskPose pose = poseOf(light, p, n);
  return pose.scale > 0 ? pose.scale * diskLambertCheap(pose.view.cone, pose.nx, pose.ny, pose.nz) : 0;
}

float diskCorrector(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept {
  const DiskPose pose = poseOf(light, p, n);
  return pose.scale > 0 ? pose.scale * diskAboveBand2(pose.view.cone, pose.nx, pose.ny, pose.nz, wrap) : 0;
}

}  // namespace rigel::detail
