#include "reference/wrap_reference.h"

#include <boost/math/special_functions/legendre.hpp>
#include <cmath>

#include "reference/smoothed_quadrature.h"

namespace rigel::reference {

double wrapKernelReference(double x, double a) { return x <= -a ? 0.0 : std::pow((x + a) / (1 + a), 1 + a); }

double wrapCoefficientReference(int l, double a) {
  return integrateSmoothed([=](double x) { return 2 * wrapKernelReference(x, a) * boost::math::legendre_p(l, x); }, -a,
                           1.0);
}

}  // namespace rigel::reference
