// A disk light's irradiance field of three bands and its spatial derivatives, largest over all normals: what
// disk_bound.cpp is made of.
//
// The disk is a superposition of emitters dA with a cosine lobe, L cos t / rho^2 each, and so is every bound that is
// linear in the light. Before a half space at distance d from the centre, the normal of which makes an angle of sine s
// with the disk's axis, emitters are no closer than d + R s x, x the position along one diameter, and the powers of
// that have means over the disk in closed form. With q = sqrt(1 - (R s/d)^2):
//
//   <(d + R s x)^-2> = 2 / (q (1+q)) / d^2      <...^-3> = 1 / (q d)^3      <...^-4> = 1 / (q^5 d^4)
//
// Close to the disk, where these diverge, its vector irradiance V = pi sx sy (light_maths section 3: half-angles of the
// cone that it fills) bounds the field: no normal receives more than kappa V, kappa = max((s0+s1+s2)/2, s0 + s1/2), the
// larger of a distant light's and a hemisphere's. V falls with the distance from the disk's axis, and along the axis
// rises to one maximum and falls.
#pragma once

#include "disk_aspect.h"
#include "light_field.h"

#include <limits>

namespace rigel {

class DiskField {
 public:
  /// Radiance 1; `radius` > 0.
  DiskField(const WrapField& wrap, double radius, bool twoSided) noexcept;

  double radius() const noexcept { return radius_; }
  double area() const noexcept { return kPi * radius_ * radius_; }

  /// Largest V over the region, or more; falls to 0 behind the disk.
  double vector(const DiskAspect& view) const noexcept;
  /// Largest SH irradiance, largest exact irradiance and the negative lobe, each per V.
  double perVector() const noexcept { return perVector_; }
  double exactPerVector() const noexcept { return exactPerVector_; }
  double lobe() const noexcept { return lobe_; }

  /// Means over the disk of (d + R s x)^-k; infinite where the half space meets the disk.
  struct Means {
    double square = std::numeric_limits<double>::infinity(), cube = square, fourth = square;
  };
  Means means(double distance, double sine) const noexcept;

  /// Largest slope and curvature of one emitter of unit power at unit distance, along a direction whose cosine with
  /// that towards the emitter is at most `along`, at least `least`; `cosine`: of the lobe.
  double slopeAlong(Interval cosine, double least, double along) const noexcept;
  double curvatureAlong(Interval cosine, double along) const noexcept;
  /// The same in any direction.
  double slope(Interval cosine) const noexcept;
  double curvature(Interval cosine) const noexcept { return curvatureAlong(cosine, 1); }
  /// Of the second derivative's form in a vector of square `square`, of which `along` is towards the emitter.
  double curvature(Interval cosine, double along, double square) const noexcept;
  /// Largest irradiance of one emitter of unit power at unit distance.
  double peakOfEmitter() const noexcept { return peak_; }
  /// How much stronger high derivatives are than those of a point without lobe.
  double lobeStrength(Interval cosine) const noexcept;

  /// Jump of the slope across the disk's plane, per mean of 1 / distance^3.
  double kink() const noexcept { return (twoSided_ ? 2 : 1) * peak_ * area(); }

  /// Largest slope that `projectWithGradient` returns before the disk (project.h: held at the rim). From the rim: dE =
  /// integral over the rim of the cone of K times the angle that it moves by, at most max K 2 pi R <1/rho^2> = max K 2
  /// pi R / (d1 d2), with the distances from the nearest and the farthest point of the rim.
  double rimSlope(const DiskAspect& view) const noexcept;

 private:
  // Of s -> sqrt(y (P^2 - (P^2-T^2) y)) + E sqrt(y (1-y)) over y in [0, 1], per E: 1.72 (a = -0.25) .. 1.64 (a = 1).
  static constexpr double kLobeCurvature = 1.73;

  double vector(double off, double height) const noexcept;

  double radius_;
  bool twoSided_;
  double peak_;               // of an emitter of unit power at unit distance
  LightField::Slopes point_;  // the same of a point without lobe
  double perVector_, exactPerVector_, lobe_;
};

}  // namespace rigel
