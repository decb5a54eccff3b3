// SH of disk lights in float: geometry in double (disk_view.cpp), moments and the turn to world axes in float.
#include <rigel/disk.h>
#include <rigel/project.h>

#include "bounded_colour.h"
#include "disk_bands.h"

namespace rigel {
namespace {

template <int B>
detail::DiskMoments<float> momentsOf(const detail::DiskCone<float>& cone, DiskNodes nodes) noexcept {
  switch (nodes) {
    case DiskNodes::four:
      return detail::diskMoments4<B>(cone);
    case DiskNodes::six:
      return detail::diskMoments6<B>(cone);
    case DiskNodes::eight:
      return detail::diskMoments8<B>(cone);
  }
  return {};
}

}  // namespace

namespace detail {

template <int B>
RadianceSH<B> shOfDisk(const LocalDisk& disk, const DiskView<float>& view, const DiskMoments<float>& moments,
                       Rgb radiance) noexcept {
  float q[shCount(B)];
  diskBands<B>(moments, view, q);
  const Rgb scale = boundedColour(radiance, disk.powerScale * static_cast<double>(view.flux));
  RadianceSH<B> sh;
  for (int i = 0; i < shCount(B); ++i) sh[i] = scale * q[i];
  return sh;
}

}  // namespace detail

template <int B>
RadianceSH<B> projectDisk(const DiskLight& light, Vec3 p, DiskNodes nodes, float footprint) noexcept {
  const detail::LocalDisk disk = detail::localDisk(light, p, footprint);
  if (!disk.lit) return {};
  const detail::DiskView<float> view = detail::viewOf<float>(disk);
  return detail::shOfDisk<B>(disk, view, momentsOf<B>(view.cone, nodes), light.radiance);
}

template <int B>
RadianceSH<B> project(const DiskLight& light, Vec3 p, float footprint) noexcept {
  return projectDisk<B>(light, p, DiskNodes::six, footprint);
}

#define RIGEL_INSTANTIATE(B)                                                                           \
  template RadianceSH<B> projectDisk<B>(const DiskLight&, Vec3, DiskNodes, float) noexcept;            \
  template RadianceSH<B> project<B>(const DiskLight&, Vec3, float) noexcept;                           \
  template RadianceSH<B> detail::shOfDisk<B>(const detail::LocalDisk&, const detail::DiskView<float>&, \
                                             const detail::DiskMoments<float>&, Rgb) noexcept;

RIGEL_INSTANTIATE(2)
RIGEL_INSTANTIATE(3)
RIGEL_INSTANTIATE(4)
RIGEL_INSTANTIATE(5)

}  // namespace rigel
