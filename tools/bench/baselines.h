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

}  // namespace rigel::tools
