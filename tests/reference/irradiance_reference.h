// Irradiance from a uniform sphere light by brute force, in double: the kernel integrated over the cap of directions in
// polar coordinates about the light. Shares nothing with the closed forms and the integral over circles about the
// normal that it checks.
#pragma once

namespace rigel::reference {

/// int f(n.w'|a) dw' over the directions w' within `alpha` (<= pi) of a light whose direction makes the angle
/// `normalAngle` with n: irradiance per unit radiance. To 1e-9 of the solid angle; milliseconds.
double capIrradianceReference(double alpha, double normalAngle, double a);

}  // namespace rigel::reference
