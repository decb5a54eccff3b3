// What our kernels are compared with.
#pragma once

#include <rigel/light.h>
#include <rigel/sh.h>

namespace rigel::tools {

/// The textbook projection of a sphere light into 3-band SH, scalar, in float: cap half-angle by asin, zonal
/// coefficients by cos and sin, turned to the light's direction with the basis. It loses all digits for small r/d.
void projectSphereTextbook(const SphereLight& light, Vec3 p, RadianceSH<3>& sum);

/// Value and gradient as one would write them from the above: central differences of `step` metres, seven projections.
void projectSphereTextbookGradient(const SphereLight& light, Vec3 p, float step, RadianceSH<3>& value,
                                   RadianceShGradient<3>& gradient);

/// Irradiance of unit radiance [W/m2] that a disk gives, scalar, in float, as published: pi A cos cos' / (pi r^2 + A),
/// the disk's centre standing for all of it. J. Wallace, K. Elmquist, E. Haines, "A Ray Tracing Algorithm for
/// Progressive Radiosity", SIGGRAPH 1989.
float wallaceIrradiance(const DiskLight& light, Vec3 p, Vec3 n);

}  // namespace rigel::tools
