// Plain value types of the public interface. They carry no alignment and no library of their own, so an engine's
// GLM or Eigen settings cannot change our layout; <rigel/glm.h> converts.
#pragma once

#include <cmath>

namespace rigel {

/// A point, displacement or direction. Metres where it is a position; 12 bytes, no padding.
struct Vec3 {
  float x = 0, y = 0, z = 0;

  constexpr float operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr float& operator[](int axis) noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, float s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(float s, Vec3 a) noexcept { return a * s; }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) noexcept { return a = a + b; }
constexpr float dot(Vec3 a, Vec3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) noexcept { return std::sqrt(dot(a, a)); }

/// Linear Rec.709 radiometric triple: radiance [W/(m2 sr)], irradiance [W/m2] or intensity [W/sr].
struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr float operator[](int channel) const noexcept { return channel == 0 ? r : channel == 1 ? g : b; }
  constexpr float& operator[](int channel) noexcept { return channel == 0 ? r : channel == 1 ? g : b; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr Rgb operator+(Rgb a, Rgb b) noexcept { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator-(Rgb a, Rgb b) noexcept { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Rgb operator*(Rgb a, float s) noexcept { return {a.r * s, a.g * s, a.b * s}; }
constexpr Rgb operator*(float s, Rgb a) noexcept { return a * s; }
constexpr Rgb& operator+=(Rgb& a, Rgb b) noexcept { return a = a + b; }

/// Double-precision colour of the exact (ground truth) path.
struct RgbD {
  double r = 0, g = 0, b = 0;

  constexpr double operator[](int channel) const noexcept { return channel == 0 ? r : channel == 1 ? g : b; }
};

constexpr RgbD operator+(RgbD a, RgbD b) noexcept { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr RgbD& operator+=(RgbD& a, RgbD b) noexcept { return a = a + b; }
constexpr RgbD operator*(Rgb a, double s) noexcept { return {a.r * s, a.g * s, a.b * s}; }

}  // namespace rigel
