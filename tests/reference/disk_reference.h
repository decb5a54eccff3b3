// SH projection of a disk light by brute force, in double: spherical coordinates about the disk's axis, the polar angle
// by Gauss-Legendre, the azimuth by adaptive quadrature. Shares nothing with the bisector frame it checks.
#pragma once

#include <rigel/light.h>

#include <array>
#include <vector>

namespace rigel::reference {

using Point = std::array<double, 3>;

/// Not inline: GCC 12 drops the rounding of doubles that become a Vec3 and doubles again within one function.
Point pointOf(Vec3 v);

/// bands^2 coefficients for a disk of radiance 1 at receiver `p`. To 1e-12 of the norm up to 1e4 radii, off the rim by
/// 1e-3 R or more; about a millisecond.
std::vector<double> projectDiskReference(const DiskLight& light, const Point& p, int bands);

/// The same by the midpoints of rings^2 patches of equal area, which is as crude as it is plain: 1/rings^2, away from
/// the face.
std::vector<double> projectDiskPatches(const DiskLight& light, const Point& p, int bands, int rings);

}  // namespace rigel::reference
