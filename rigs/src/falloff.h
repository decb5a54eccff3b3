// One falloff for a whole rig: light varies over an object as 1/quadratic(position) times something smooth.
#pragma once

#include <rigel/vec3.h>

#include <algorithm>
#include <array>
#include <span>

namespace rigel {

/// q(u) = [u 1] Q [u 1]^T, u in box coordinates; the scale is 1/q. A single small light has such a q exactly,
/// 1/q = I/|p - x|^2. q is positive all over the box.
class Falloff {
 public:
  /// q = 1.
  Falloff() noexcept { reset(); }
  void reset() noexcept;

  /// Fits q to light of `strength` g_s >= 0 at u_s: least squares of q g - 1, each with weight w_s (sum 1), held
  /// slightly towards the constant, among the q that are positive on the box. Continuous in strength and
  /// positions. No light, or light that is not finite, gives q = 1. Allocates nothing.
  void fit(std::span<const Vec3> u, std::span<const float> weight, std::span<const double> strength) noexcept;

  /// q > 0 at the point of the box that is nearest to u: a quadratic says nothing of the light beyond.
  float operator()(Vec3 u) const noexcept {
    const auto& [xx, yy, zz, xy, xz, yz, x, y, z, one] = coefficient_;
    for (int a = 0; a < 3; ++a) u[a] = std::clamp(u[a], -1.0f, 1.0f);
    return one + u.x * (x + xx * u.x + xy * u.y + xz * u.z) + u.y * (y + yy * u.y + yz * u.z) + u.z * (z + zz * u.z);
  }

  /// Of uu, vv, ww, uv, uw, vw, u, v, w, 1 (u, v, w box coordinates).
  const std::array<float, 10>& coefficients() const noexcept { return coefficient_; }

  /// No more than the smallest q in the box, > 0.
  double least() const noexcept { return least_; }

 private:
  std::array<float, 10> coefficient_;
  double least_;
};

}  // namespace rigel
