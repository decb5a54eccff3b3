// Irradiance of a sphere light in float, normalised by pi L min(1, (r/d)^2): 1 is what a small light straight above
// gives. The receiver is outside the sphere here, s = r/d, c = sqrt(1-s^2), x = n.w; inside, E(x) = f_0 - s^2 E_cap(-x)
// with s = d/r (exact.cpp).
#pragma once

#include <rigel/near_light.h>

#include <algorithm>
#include <cmath>

namespace rigel::detail {

inline constexpr float kPiFloat = static_cast<float>(kPi);

/// Q(y^2) in atan y = y - y^3 Q(y^2), 0 <= y <= 1; atan to 5e-8. Minimax fit. GPUs promise 4096 ulp for theirs, and the
/// difference y - atan y is wanted without cancellation.
inline float atanTail(float q) noexcept {
  return 0.333316590f +
         q * (-0.199627032f +
              q * (0.139765777f + q * (-0.097942225f + q * (0.057773421f + q * (-0.023040017f + q * 0.004355373f)))));
}

/// atan2(y, x) for x, y >= 0; 0 where both are.
inline float atanQuadrant(float y, float x) noexcept {
  const float ratio = std::min(y, x) / std::max(std::max(y, x), 1e-30f);
  const float q = ratio * ratio;
  const float angle = ratio - ratio * q * atanTail(q);
  return y > x ? 0.5f * kPiFloat - angle : angle;
}

/// Lambert, clipped at the horizon: the form of exact.cpp, whose terms are all of the result's size, over pi s^2.
inline float lambertCap(float x, float s, float c) noexcept {
  if (std::abs(x) >= s) return std::max(x, 0.0f);
  const float t = x / s;
  const float z = std::sqrt((1 - t) * (1 + t));
  const float quadrant = atanQuadrant(z, c * std::abs(t));
  const float arc = x * (t > 0 ? kPiFloat - quadrant : quadrant);
  const float sz = s * z;
  float rest;
  if (sz > c) {
    rest = (atanQuadrant(sz, c) - sz * c) / (s * s);
  } else {
    // s^2 v - (v - atan v), v = s z/c, over s^2.
    const float zc = z / std::max(c, 1e-30f);
    const float v = s * zc;
    rest = v * (1 - zc * zc * atanTail(v * v));
  }
  return std::max(0.0f, arc + rest) * (1 / kPiFloat);
}

/// Lambert, cheap: the parabola (x+s)^2/4s between x = -s and s, plus (s/4) g(c) (1-(x/s)^2). g is a fit over all
/// normals for each c; g(0) = 1 makes the touching sphere, (1+x)/2, exact.
inline float lambertCapCheap(float x, float s, float c) noexcept {
  const float t = std::clamp(x / s, -1.0f, 1.0f);
  const float g = 1 + c * (-2.818f + c * (2.973f - c * 1.285f));
  return std::max(x - s, 0.0f) + 0.25f * s * (1 + t) * (1 + t + g * (1 - t));
}

/// f(x|a) with its corner at the horizon blurred over +-width in u = (x+a)/(1+a).
inline float blurredKernel(float x, float width, const NearWrap& wrap) noexcept {
  const float u = (x + wrap.a) * wrap.inverse;
  const float half = std::max(width, 1e-6f);
  const float t = 1 + std::clamp(u / half, -1.0f, 1.0f);
  const float base = 0.25f * half * t * t + std::max(u - half, 0.0f);
  return std::pow(base, 1 + wrap.a);
}

/// How much of the kernel's bands from 5 on a sphere of angular size s keeps; with nearWrap's blur a fit over all a.
inline float highBandShare(float s2) noexcept { return std::max(0.0f, 1 - s2 * (2.111f + 1.709f * s2)); }

/// Any wrap: the first five bands as SH give them, and above them the blurred kernel's, less and less the larger the
/// light,
///   h blurred(x) + sum_{l<5} [band_l (2 k_l - h) - h blurBand_l s^2 (1 - 1.474 s^2)] P_l(x),
/// k_l the zonal factors of zonal.h.
inline float wrapCap(float x, float s, float c, const NearWrap& wrap) noexcept {
  const float s2 = s * s;
  const float h = highBandShare(s2);
  const float blur = h * s2 * (1 - 1.474f * s2);
  const float factor[5] = {2 / (1 + c), 1, c, 1 - 1.25f * s2, c * (1 - 1.75f * s2)};
  float b[5];
  for (int l = 0; l < 5; ++l) b[l] = wrap.band[l] * (factor[l] - h) - blur * wrap.blurBand[l];
  const float q = x * x;
  float e = b[0] - 0.5f * b[2] + 0.375f * b[4] + q * (1.5f * b[2] - 3.75f * b[4] + q * (4.375f * b[4]));
  e += x * (b[1] - 1.5f * b[3] + q * (2.5f * b[3]));
  if (h > 0) {
    e += h * blurredKernel(x, wrap.blur * s, wrap);
  } else {
    // No cap gives more than the whole sphere: where it touches, held at both ends or E would jump on the way in.
    e = std::min(e, 4 * wrap.band[0] / s2);
  }
  return std::max(e, 0.0f);
}

/// The delta kernel less its own three bands.
inline float kernelAboveBand2(float x, const NearWrap& wrap) noexcept {
  const float kernel = wrap.a == 0 ? std::max(x, 0.0f) : blurredKernel(x, 0, wrap);
  return kernel - wrap.band[0] - wrap.band[1] * x - wrap.band[2] * (1.5f * x * x - 0.5f);
}

}  // namespace rigel::detail
