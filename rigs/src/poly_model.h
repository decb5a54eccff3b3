// poly:K, a polynomial fitted by least squares to light sampled on the object's own surface.
//
// Monomials of the box coordinates u in [-1, 1]^3, ordered once in the rest pose by how much they vary over the
// surface; the first K are kept, so a smaller K is a prefix. Every divisor of a kept monomial is kept too, so the
// fitted function does not depend on where the box puts the origin or on its scale.
//
// invquad:K is 1/q(p) times such a polynomial, q a quadratic fitted to the light of each frame: the polynomial is then
// fitted to q F with weights share/q^2, which counts the error of the product.
#pragma once

#include "falloff.h"
#include "surface_fit.h"

#include <cstdint>

namespace rigel {

/// A falloff has ten coefficients of its own; fewer points than this do not tell them from the polynomial's.
inline constexpr int kFalloffPoints = 24;

class Rig::PolyModel final : public Rig::Model {
 public:
  PolyModel(RigSpec spec, const RigShape& rest, const Anchors& chosen);

  void setPose(const RigPose& pose) noexcept override;
  void adapt(std::span<const float> light, int width) noexcept override;
  void basis(Vec3 p, RigBasis& out) const noexcept override;
  void basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept override;

  /// Exponents of x, y, z in monomial k.
  std::array<std::uint8_t, 3> exponents(int k) const noexcept {
    std::array<std::uint8_t, 3> e{};
    for (; k > 0; k = terms_[k].from) ++e[terms_[k].axis];
    return e;
  }

  /// Monomial k > 0 is monomial divisor(k) < k times coordinate axis(k).
  int divisor(int k) const noexcept { return terms_[k].from; }
  int axis(int k) const noexcept { return terms_[k].axis; }

  /// Of the moment; 1 but for invquad.
  const Falloff& falloff() const noexcept { return falloff_; }

 private:
  /// A monomial as an earlier one times a coordinate, so that all are found with one product each.
  struct Term {
    std::int8_t from;
    std::int8_t axis;
  };

  std::vector<Term> terms_;  // [0] is the constant 1
  BoxCoordinates box_;
  SurfaceFit surfaceFit_;

  Falloff falloff_;  // invquad only, as what follows: per anchor
  std::vector<Vec3> u_;
  std::vector<double> strength_;
  std::vector<float> q_;
};

}  // namespace rigel
