// Zonal factors of a uniform sphere light and Legendre polynomials, without cancellation.
#pragma once

namespace rigel::detail {

/// k_l = g_l / min(1, (r/d)^2), g_l = s2 P_l'(c)/(l(l+1)), of the views of local_light.h: outside k_0 = 1/(1+c) and
/// h_l = g_l/s2; inside k_0 = 1-c and k_l = s2 h_l. The SH of the light are fluxScale * k_l * Y_lm(w).
template <int B, class Real>
inline void zonalFactors(Real s2, Real c, bool inside, Real* k) noexcept {
  const Real share = inside ? s2 : Real(1);
  k[0] = inside ? 1 - c : 1 / (1 + c);
  k[1] = share / 2;
  if constexpr (B > 2) k[2] = share * c / 2;
  if constexpr (B > 3) k[3] = share * (4 - 5 * s2) / 8;
  if constexpr (B > 4) k[4] = share * c * (4 - 7 * s2) / 8;
}

/// h_l = P_l'(c)/(l(l+1)) for l >= 1, and 0 for l = 0, whose basis function has no slope.
template <int B, class Real>
inline void slopeFactors(Real s2, Real c, Real* h) noexcept {
  h[0] = 0;
  h[1] = Real(0.5);
  if constexpr (B > 2) h[2] = c / 2;
  if constexpr (B > 3) h[3] = (4 - 5 * s2) / 8;
  if constexpr (B > 4) h[4] = c * (4 - 7 * s2) / 8;
}

/// P_l(c) with c^2 = 1 - s2.
template <int B, class Real>
inline void legendre(Real s2, Real c, Real* p) noexcept {
  const Real c2 = 1 - s2;
  p[0] = 1;
  p[1] = c;
  if constexpr (B > 2) p[2] = (3 * c2 - 1) / 2;
  if constexpr (B > 3) p[3] = c * (5 * c2 - 3) / 2;
  if constexpr (B > 4) p[4] = ((35 * c2 - 30) * c2 + 3) / 8;
}

}  // namespace rigel::detail
