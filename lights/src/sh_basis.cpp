#include <rigel/sh.h>

#include "sh_polynomials.h"

namespace rigel {

template <int B>
void shBasis(Vec3 w, float* y) noexcept {
  detail::basisPolynomials<B>(w, y);
}

template <int B>
void shBasisGradient(Vec3 w, float* y, Vec3* dy) noexcept {
  detail::basisPolynomials<B>(w, y);
  detail::basisGradientPolynomials<B>(w, dy);
}

template void shBasis<2>(Vec3, float*) noexcept;
template void shBasis<3>(Vec3, float*) noexcept;
template void shBasis<4>(Vec3, float*) noexcept;
template void shBasis<5>(Vec3, float*) noexcept;
template void shBasisGradient<2>(Vec3, float*, Vec3*) noexcept;
template void shBasisGradient<3>(Vec3, float*, Vec3*) noexcept;
template void shBasisGradient<4>(Vec3, float*, Vec3*) noexcept;
template void shBasisGradient<5>(Vec3, float*, Vec3*) noexcept;

}  // namespace rigel
