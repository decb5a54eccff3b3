#pragma once

#include <rigel/shader_disk_view.h>

namespace rigel::detail {

/// World SH of the first B bands, per vector irradiance; `q` has B^2 entries.
template <int B, class Real>
inline void diskBands(const DiskMoments<Real>& moments, const DiskView<Real>& view, Real* q) noexcept {
  q[0] = moments.q00;
  q[1] = Real(kRigelY1) * view.zy;
  q[2] = Real(kRigelY1) * view.zz;
  q[3] = Real(kRigelY1) * view.zx;
  if constexpr (B > 2) diskBand2(moments, view, q + 4);
  if constexpr (B > 3) diskBand3(moments, view, q + 9);
  if constexpr (B > 4) diskBand4(moments, view, q + 16);
}

}  // namespace rigel::detail
