// Real orthonormal SH from their definition, in 50 digits.
#pragma once

#include "reference/real50.h"

namespace rigel::reference {

/// Y_lm(w), |w| = 1: sqrt((2l+1)/4pi (l-|m|)!/(l+|m|)!) P_l^|m|(cos theta) times 1 (m = 0), sqrt(2) cos(m phi) (m > 0)
/// or sqrt(2) sin(|m| phi) (m < 0). P_l^m without the sign (-1)^m of Condon and Shortley. Any l.
Real50 shReference(int l, int m, const Vec50& w);

/// Legendre polynomial P_l(x) by Bonnet's recursion.
Real50 legendreReference(int l, const Real50& x);

}  // namespace rigel::reference
