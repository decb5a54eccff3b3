// 50 decimal digits, and vectors of them. Every float and double converts without rounding.
#pragma once

#include <rigel/vec3.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_dec_float.hpp>

namespace rigel::reference {

using Real50 = boost::multiprecision::number<boost::multiprecision::cpp_dec_float<50>, boost::multiprecision::et_off>;

inline Real50 pi50() { return boost::math::constants::pi<Real50>(); }

struct Vec50 {
  Real50 x, y, z;

  const Real50& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  Real50& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline Vec50 exactly(Vec3 v) { return {Real50(v.x), Real50(v.y), Real50(v.z)}; }
inline Vec50 operator-(const Vec50& a, const Vec50& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec50 operator*(const Vec50& a, const Real50& s) { return {a.x * s, a.y * s, a.z * s}; }
inline Real50 dot(const Vec50& a, const Vec50& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real50 length(const Vec50& a) { return sqrt(dot(a, a)); }

}  // namespace rigel::reference
