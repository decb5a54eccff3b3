// Double-precision vector of the internal geometry: distances formed in double from float positions keep the accuracy
// of the inputs down to a light that touches the receiver.
#pragma once

#include <rigel/vec3.h>

#include <cmath>

namespace rigel::detail {

struct Vec3d {
  double x = 0, y = 0, z = 0;

  constexpr double operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
};

constexpr Vec3d widen(Vec3 v) noexcept { return {v.x, v.y, v.z}; }
constexpr Vec3 narrow(Vec3d v) noexcept {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
constexpr Vec3d operator+(Vec3d a, Vec3d b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3d operator-(Vec3d a, Vec3d b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3d operator*(Vec3d a, double s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
constexpr double dot(Vec3d a, Vec3d b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3d cross(Vec3d a, Vec3d b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Unit vector along `v`; zero where v has no direction (length zero, infinite or NaN). Squares of floats neither
/// overflow nor vanish in double, so every other float vector has one.
inline Vec3d directionOf(Vec3 v) noexcept {
  const Vec3d wide = widen(v);
  const double squared = dot(wide, wide);
  if (!(squared > 0) || !std::isfinite(squared)) return {};
  return wide * (1 / std::sqrt(squared));
}

template <class... Floats>
constexpr bool anyNan(Floats... values) noexcept {
  return ((values != values) || ...);
}
constexpr bool anyNan(Vec3 v) noexcept { return anyNan(v.x, v.y, v.z); }
constexpr bool anyNan(Rgb c) noexcept { return anyNan(c.r, c.g, c.b); }

}  // namespace rigel::detail
