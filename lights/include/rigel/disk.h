// SH of disk lights by the method one asks for; project.h has the usual one, six nodes. All of them see the light in
// its bisector frame (shader_disk.h), where a disk has few coefficients and those are smooth: they differ in how the
// coefficients are integrated. Error per ||q||, over distances of 1e-3 to 1e4 radii and all angles; what is left of it
// with eight nodes is float's rounding:
//
//   | nodes | rim farther than 1e-2 R | than 1e-3 R |
//   |---|---|---|
//   | 4 | 6e-5 | 3e-4 |
//   | 6 | 4e-7 | 2e-6 |
//   | 8 | 3e-7 | 3e-7 |
//
// One-sided disks give no light behind and in their plane; their SH jump there from what the front of the face sees.
// NaN, a missing direction or radius, an infinite distance: no light. Held to kMaxProjectionScale (project.h).
#pragma once

#include <rigel/light.h>
#include <rigel/sh.h>
#include <rigel/shader_disk_view.h>

#include <span>

namespace rigel {

/// How the SH of a disk light are found: by quadrature, from tables (disk_table.h), or in double.
enum class DiskMethod { quadrature, table, exact };

/// Nodes of the quadrature over a quarter of the rim (shader_disk.h).
enum class DiskNodes { four = 4, six = 6, eight = 8 };

/// As project<B>(DiskLight) of project.h, which takes six nodes.
template <int B>
RadianceSH<B> projectDisk(const DiskLight& light, Vec3 p, DiskNodes nodes, float footprint = 0) noexcept;

/// In double, to 1e-10 of ||q||: tanh-sinh quadrature of 257 nodes. `bands` 2 to 5; `sh` holds 3 bands^2 numbers,
/// colour by colour of each coefficient. About 1 us. No allocation.
void projectDiskExact(const DiskLight& light, Vec3 p, int bands, std::span<double> sh) noexcept;

namespace detail {

/// Where a receiver is of a disk light, in double: a rim that all but touches it keeps its digits.
struct LocalDisk {
  DiskPlace<double> place;
  double gap = 0;         // rho^2 + z^2 - 1
  double radius = 0;      // m, that place and gap are in: of the disk, of the footprint, or distance / kRigelDiskReach
  double powerScale = 0;  // pi, times what makes up for a radius that is not the disk's own
  bool lit = false;       // false: no light arrives, and the rest is not set
};

LocalDisk localDisk(const DiskLight& light, Vec3 p, float footprint = 0) noexcept;

/// Real: float or double. Radiance SH are radiance * powerScale * view.flux * (what the view's moments give).
template <class Real>
DiskView<Real> viewOf(const LocalDisk& disk) noexcept;

/// World SH from moments that any method gave; `view` is viewOf<float>(disk).
template <int B>
RadianceSH<B> shOfDisk(const LocalDisk& disk, const DiskView<float>& view, const DiskMoments<float>& moments,
                       Rgb radiance) noexcept;

/// The moments of all bands to 1e-11 of ||q||.
DiskMoments<double> exactDiskMoments(const DiskCone<double>& cone) noexcept;

}  // namespace detail
}  // namespace rigel
