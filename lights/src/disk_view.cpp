#include <rigel/disk.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vec3d.h"

namespace rigel::detail {
namespace {

DiskCone<float> narrow(const DiskCone<double>& cone) noexcept {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(cone.sx2), f(cone.cx2), f(cone.sy2), f(cone.cy2), f(cone.sx),
          f(cone.cx),  f(cone.sy),  f(cone.cy),  f(cone.t),   f(cone.u)};
}

}  // namespace

LocalDisk localDisk(const DiskLight& light, Vec3 p, float footprint) noexcept {
  LocalDisk disk;
  if (anyNan(light.radius) || anyNan(light.radiance) || !(light.radius > 0)) return disk;
  const Vec3d toCentre = widen(light.position) - widen(p);
  const double distance2 = dot(toCentre, toCentre);
  if (!std::isfinite(distance2)) return disk;  // NaN included

  constexpr double kLargest = std::numeric_limits<float>::max();
  const double ownRadius = std::min<double>(light.radius, kLargest);
  disk.radius = std::max({ownRadius, std::min<double>(footprint, kLargest), std::sqrt(distance2) / kRigelDiskReach});
  const double share = ownRadius / disk.radius;
  disk.powerScale = kPi * share * share;

  const Vec3d v = toCentre * (1 / disk.radius);
  const Vec3d axis = directionOf(light.direction);
  disk.place = diskPlace(v.x, v.y, v.z, axis.x, axis.y, axis.z, dot(v, axis), light.twoSided ? -1.0 : 0.0);
  if (!(disk.place.z > 0)) return disk;
  disk.lit = true;
  disk.view = diskView(disk.place, (disk.place.rho - 1) * (disk.place.rho + 1) + disk.place.z * disk.place.z);
  disk.fluxScale = disk.powerScale * disk.view.flux;
  return disk;
}

DiskView<float> narrow(const DiskView<double>& view) noexcept {
  const auto f = [](double x) { return static_cast<float>(x); };
  DiskView<float> out;
  out.cone = narrow(view.cone);
  out.flux = f(view.flux);
  out.xx = f(view.xx), out.xy = f(view.xy), out.xz = f(view.xz);
  out.yx = f(view.yx), out.yy = f(view.yy), out.yz = f(view.yz);
  out.zx = f(view.zx), out.zy = f(view.zy), out.zz = f(view.zz);
  return out;
}

}  // namespace rigel::detail
