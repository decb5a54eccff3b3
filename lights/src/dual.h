// Forward automatic differentiation: a number and its derivatives by N variables, in double. As `Real` of the generic
// shader_*.h headers it differentiates what they compute.
#pragma once

#include <array>
#include <cmath>

namespace rigel::detail {

template <int N>
struct Dual {
  double value = 0;
  std::array<double, N> slope{};

  constexpr Dual() noexcept = default;
  constexpr explicit Dual(double constant) noexcept : value(constant) {}

  /// Variable number `index`, or `scale` times it.
  static constexpr Dual variable(double value, int index, double scale = 1) noexcept {
    Dual x(value);
    x.slope[index] = scale;
    return x;
  }

  constexpr Dual& operator+=(const Dual& o) noexcept { return *this = *this + o; }

  friend constexpr Dual operator-(const Dual& a) noexcept { return combine(-a.value, a, -1, a, 0); }
  friend constexpr Dual operator+(const Dual& a, const Dual& b) noexcept {
    return combine(a.value + b.value, a, 1, b, 1);
  }
  friend constexpr Dual operator-(const Dual& a, const Dual& b) noexcept {
    return combine(a.value - b.value, a, 1, b, -1);
  }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) noexcept {
    return combine(a.value * b.value, a, b.value, b, a.value);
  }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) noexcept {
    const double inverse = 1 / b.value;
    const double value = a.value * inverse;
    return combine(value, a, inverse, b, -value * inverse);
  }
  friend Dual sqrt(const Dual& a) noexcept {
    const double root = std::sqrt(a.value);
    return combine(root, a, 0.5 / root, a, 0);
  }
  friend constexpr Dual abs(const Dual& a) noexcept { return a.value < 0 ? -a : a; }
  friend constexpr bool operator<(const Dual& a, const Dual& b) noexcept { return a.value < b.value; }
  friend constexpr bool operator>(const Dual& a, const Dual& b) noexcept { return a.value > b.value; }

 private:
  static constexpr Dual combine(double value, const Dual& a, double da, const Dual& b, double db) noexcept {
    Dual out(value);
    for (int i = 0; i < N; ++i) out.slope[i] = da * a.slope[i] + db * b.slope[i];
    return out;
  }
};

}  // namespace rigel::detail
