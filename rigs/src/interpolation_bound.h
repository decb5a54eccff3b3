// The error |(I - P) phi| of tensor rigs with samples at the corners of a box or its centre, about one light without
// window and cone.
#pragma once

#include "light_field.h"
#include "light_place.h"

namespace rigel {

/// Slope and curvature, in any direction, of what is interpolated.
struct Roughness {
  double slope = 0, curvature = 0;
};

/// Over the box; infinite where it meets the light.
double boxError(const detail::BoundPlan& plan, const Region& served, const LightField& field) noexcept;
/// The same of a function of which only the roughness is known.
double boxError(const detail::BoundPlan& plan, const Roughness& roughness) noexcept;

/// Over a ball about the centre, for one sample there, with or without slopes. Goes over to `cap` as the light swallows
/// the centre.
double ballError(const detail::BoundPlan& plan, const Region& served, const LightField& field, double cap) noexcept;

/// What secants (@numeric) in several directions add to the error of slopes.
double secantError(const detail::BoundPlan& plan, const Region& nodes, const LightField& field) noexcept;

/// Squares of the largest third derivatives of one emitter across the direction towards it and along it, over all
/// normals, per (peak / distance^3)^2; in between their weights are the squares of sine and cosine.
struct ThirdDerivatives {
  double across, along;
};
/// Square root of the sum of the squares of those along `axes` axes, each where it is largest in `nodes`.
double norm(const ThirdDerivatives& squares, int axes, const Region& nodes) noexcept;

/// How much secants are off by, times how far their slopes reach, from that norm, in full, and the second derivative.
double secantReach(const detail::BoundPlan& plan, double third, double second) noexcept;

/// How far slopes reach from their samples, over the axes that have them.
struct SlopeReach {
  double halves = 0;    // sum over the axes, in half extents of the box
  double farthest = 0;  // m
};
SlopeReach slopeReach(const detail::BoundPlan& plan) noexcept;

/// Half extent at which @numeric takes its secants (tensor_model.cpp).
inline constexpr double kSecant = 0.77459667;

}  // namespace rigel
