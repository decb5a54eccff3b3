// How large the weights of an invquad rig, and its errors about 1, x, y and z, get anywhere on a surface.
//
// Each is g(u)/q(u): a polynomial over the falloff's quadratic. Over a cell |u - c| <= h the polynomial is at most the
// sum of its Taylor coefficients' sizes times h^alpha, and q is at least what its own expansion leaves. Where that is
// far less than q at the centre the cell is halved: weights peak in the valleys of q, which are narrow and lie
// anywhere.
#pragma once

#include "falloff.h"

#include <rigel/light_bound.h>

#include <array>
#include <cstdint>
#include <span>

namespace rigel {

/// A box in box coordinates, within [-1, 1]^3.
struct WeightCell {
  std::array<double, 3> centre{}, half{};
  int halvings = 0;
};

class FalloffWeights {
 public:
  using Degrees = std::array<std::uint8_t, 3>;

  explicit FalloffWeights(const Falloff& falloff) noexcept;

  /// Calls visit(part) for parts that make up the cell, small enough that in most of them q varies little; those of
  /// which matters(part) is false are left out.
  template <class Matters, class Visit>
  void divide(const WeightCell& cell, Matters matters, Visit visit) const noexcept {
    std::array<WeightCell, kHalvings + 2> stack;
    int waiting = 0;
    stack[waiting++] = cell;
    while (waiting > 0) {
      const WeightCell part = stack[--waiting];
      if (part.halvings == kHalvings || leastOver(part) >= kEnough * q(part.centre)) {
        visit(part);
        continue;
      }
      if (!matters(part)) continue;
      for (const double side : {-0.5, 0.5}) stack[waiting++] = halved(part, side);
    }
  }

  /// Polynomials: coefficients of `monomials` (with every divisor of each), a row of `columns` a monomial.
  template <class Float>
  struct Polynomials {
    std::span<const Degrees> monomials;
    std::span<const Float> coefficients;
    int columns = 0;  // kMaxSamples at most
  };

  /// Raises `most` to the size that each polynomial over q can have in the part; returns the sum of these sizes.
  template <class Float>
  double raise(const WeightCell& part, const Polynomials<Float>& g, std::span<Float> most) const noexcept;

 private:
  // Parts are halved up to this often, while q may fall below this share of its value at the centre.
  static constexpr int kHalvings = 6;
  static constexpr double kEnough = 0.5;

  double q(const std::array<double, 3>& u) const noexcept;
  std::array<double, 3> slope(const std::array<double, 3>& u) const noexcept;
  double leastOver(const WeightCell& cell) const noexcept;
  WeightCell halved(const WeightCell& cell, double side) const noexcept;

  // q = one + linear u + square u^2 + cross (of the axes other than this)
  std::array<double, 3> square_, cross_, linear_;
  double one_;
  double floor_;  // of q
};

}  // namespace rigel
