// One local light's irradiance field and its spatial derivatives, largest over all normals: what light_bound.cpp is
// made of.
//
// With n the normal, w the unit vector towards the light, rho its distance, x = n.w, the light's three-band irradiance
// is e0(rho) + e1(rho) x + e2(rho) P2(x). Per A/rho^2 (A = pi L r^2, the intensity of a point light) and with
// c = sqrt(1-(r/rho)^2), s_l = (f0/2, 3/2 f1, 5/2 f2):
//
//   e           s0/(1+c)          s1/2   s2 c/2
//   -rho e'     s0/c              s1     s2 v,   v = (3c - 1/c)/2
//   rho^2 e''   s0 (1+2c^2)/c^3   3 s1   s2 h,   h = 6c - 5/(2c) - 1/(2c^3)
//
// Directional derivatives along a unit vector of which the component along w is cos t are then, over all normals,
//
//   |first|  <= sqrt(P^2 cos^2 t + T^2 sin^2 t) / rho         P: radial, T: across
//   |second| <= (A2 cos^2 t + B2 sin^2 t) / rho^2
//
// which is sharp (it is reached, to 1e-3, for c > .8; test_light_field.cpp) and falls with rho, so that over a box it
// is largest at the point nearest to the light.
#pragma once

#include <rigel/light_bound.h>

namespace rigel {

using detail::WrapField;

WrapField wrapField(float wrap) noexcept;

class LightField {
 public:
  /// `power`: A; `radius` > 0.
  LightField(const WrapField& wrap, double power, double radius) noexcept : w_(&wrap), a_(power), r_(radius) {}

  double radius() const noexcept { return r_; }
  double power() const noexcept { return a_; }

  /// Largest SH irradiance at distance rho or more.
  double peak(double rho) const noexcept;
  /// The same of exact irradiance.
  double exactPeak(double rho) const noexcept;

  /// Of the four bounds above, at rho > radius (infinite or large at the radius).
  struct Slopes {
    double first, firstAcross;    // P/rho, T/rho
    double second, secondAcross;  // A2/rho^2, B2/rho^2
  };
  Slopes slopes(double rho) const noexcept;

  /// Largest slope that `projectWithGradient` returns at distance rho or more, whose cosine is held (project.h).
  double heldSlope(double rho) const noexcept;

  /// Integral of P/rho from `near` to `far` (near >= radius): how much the field can change on the way.
  double change(double near, double far) const noexcept;

  /// Integral of A2/rho^2 times the distance from `near`, from near to far: what is left of the field at `near` after a
  /// first-order expansion at `far`.
  double remainder(double near, double far) const noexcept;

  /// How much the field can change between the surface and the depth where the distance is rho <= radius.
  double changeInside(double rho) const noexcept;

 private:
  struct Bands {
    double e0, e1, e2;
  };
  double cosine(double rho) const noexcept;
  Bands values(double rho) const noexcept;        // outside
  Bands radialSlopes(double rho) const noexcept;  // -e'

  const WrapField* w_;
  double a_;
  double r_;
};

}  // namespace rigel
