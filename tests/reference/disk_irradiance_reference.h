// Irradiance from a uniform disk by brute force, in double: the kernel integrated over the directions to the disk in
// polar coordinates about the foot of the receiver in the disk's plane. Shares nothing with the cone's frame and the
// contour integrals that it checks.
#pragma once

#include <rigel/light.h>

namespace rigel::reference {

/// Irradiance per unit radiance at the receiver; unit normals (they are normalised). To 1e-9 of the peak over normals;
/// milliseconds.
double diskIrradianceReference(const DiskLight& light, Vec3 p, Vec3 n, double a);

/// The same by `count` rays to points of the disk's area (Hammersley's), which is as crude as it is plain.
double diskIrradianceByRays(const DiskLight& light, Vec3 p, Vec3 n, double a, int count);

}  // namespace rigel::reference
