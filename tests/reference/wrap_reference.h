// Wrap reflectance straight from its definition, in double.
#pragma once

namespace rigel::reference {

/// f(theta|a) = ((x + a)/(1 + a))^(1 + a), x = cos theta; 0 where x < -a.
double wrapKernelReference(double x, double a);

/// f_l(a) = 2 int_{-1}^{1} f P_l(x) dx by a quadrature that the kernel's fractional power does not disturb. To 1e-12.
double wrapCoefficientReference(int l, double a);

}  // namespace rigel::reference
