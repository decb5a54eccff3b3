// Spatial derivative of a disk's SH: the shared text of shader_disk*.h in dual numbers. Moments depend on rho and z
// alone; a step sideways (along Y) only turns the frame about the disk's axis, by 1/rho a radius.
#include <rigel/disk.h>
#include <rigel/project.h>

#include <algorithm>
#include <cmath>

#include "bounded_colour.h"
#include "disk_bands.h"
#include "dual.h"
#include "vec3d.h"

namespace rigel {
namespace {

using detail::Dual;
using detail::Vec3d;

/// Radii. On the axis 1/rho has no limit, though what it is multiplied with falls faster: the slope is that from here.
constexpr double kMinRho = 1e-7;

using Local = Dual<3>;   // by steps along X_b, Y and Z_b
using Planar = Dual<2>;  // along X_b and Z_b

Planar planar(const Local& x) noexcept {
  Planar out(x.value);
  out.slope = {x.slope[0], x.slope[2]};
  return out;
}

Local local(const Planar& x) noexcept {
  Local out(x.value);
  out.slope = {x.slope[0], 0, x.slope[1]};
  return out;
}

/// The place, as a function of the vector from receiver to centre: rho X_b + z Z_b.
detail::DiskPlace<Local> differentiate(const detail::DiskPlace<double>& at) noexcept {
  const double rho = std::max(at.rho, kMinRho);
  const auto along = [&](double value, double slope) { return Local::variable(value, 1, slope / rho); };
  detail::DiskPlace<Local> place;
  place.rho = Local::variable(rho, 0);
  place.z = Local::variable(at.z, 2);
  place.xx = along(at.xx, at.yx), place.xy = along(at.xy, at.yy), place.xz = along(at.xz, at.yz);
  place.yx = along(at.yx, -at.xx), place.yy = along(at.yy, -at.xy), place.yz = along(at.yz, -at.xz);
  place.zx = Local(at.zx), place.zy = Local(at.zy), place.zz = Local(at.zz);
  return place;
}

template <int B>
detail::DiskMoments<Local> momentsOf(const detail::DiskCone<Local>& cone) noexcept {
  const detail::DiskCone<Planar> c{planar(cone.sx2), planar(cone.cx2), planar(cone.sy2), planar(cone.cy2),
                                   planar(cone.sx),  planar(cone.cx),  planar(cone.sy),  planar(cone.cy),
                                   planar(cone.t),   planar(cone.u)};
  const detail::DiskMoments<Planar> q = detail::diskMoments6<B>(c);
  return {local(q.q00), local(q.q20), local(q.q22), local(q.q30),
          local(q.q32), local(q.q40), local(q.q42), local(q.q44)};
}

}  // namespace

template <int B>
ProjectionWithGradient<B> projectWithGradient(const DiskLight& light, Vec3 p) noexcept {
  ProjectionWithGradient<B> out;
  const detail::LocalDisk disk = detail::localDisk(light, p);
  if (!disk.lit) return out;
  out.value = project<B>(light, p);

  const detail::DiskPlace<Local> place = differentiate(disk.place);
  const detail::DiskView<Local> view =
      detail::diskView(place, (place.rho - Local(1)) * (place.rho + Local(1)) + place.z * place.z);
  Local q[shCount(B)];
  detail::diskBands<B>(momentsOf<B>(view.cone), view, q);

  const double rim = std::hypot(disk.place.rho - 1, disk.place.z);
  const double sine = disk.place.z / std::hypot(disk.place.rho, disk.place.z);
  const double held = std::min(1.0, rim / static_cast<double>(kMinGradientRim)) *
                      std::min(1.0, sine / static_cast<double>(kMinGradientSine));
  const double perMetre = held * disk.powerScale / disk.radius;
  const detail::DiskPlace<double>& at = disk.place;
  const Vec3d axes[3] = {{at.xx, at.xy, at.xz}, {at.yx, at.yy, at.yz}, {at.zx, at.zy, at.zz}};
  for (int i = 0; i < shCount(B); ++i) {
    const Local flux = view.flux * q[i];
    const Vec3d slope = axes[0] * flux.slope[0] + axes[1] * flux.slope[1] + axes[2] * flux.slope[2];
    // The receiver steps the other way.
    for (int axis = 0; axis < 3; ++axis) {
      out.gradient.d[axis][i] = detail::boundedColour(light.radiance, -perMetre * slope[axis]);
    }
  }
  return out;
}

template ProjectionWithGradient<2> projectWithGradient<2>(const DiskLight&, Vec3) noexcept;
template ProjectionWithGradient<3> projectWithGradient<3>(const DiskLight&, Vec3) noexcept;
template ProjectionWithGradient<4> projectWithGradient<4>(const DiskLight&, Vec3) noexcept;
template ProjectionWithGradient<5> projectWithGradient<5>(const DiskLight&, Vec3) noexcept;

}  // namespace rigel
