// Largest values over a ball or a half space of a spot's window and cone times its field. Ranges of the three, each
// over all of the region, miss that the point nearest to the light is often not the one in the full light.
#pragma once

#include "light_field.h"
#include "light_place.h"

namespace rigel {

struct SpotCone {
  double range = 0;
  double cosOuter = 0, width = 1;  // smoothstep((cosine - cosOuter) / width)
  Interval cosines;                // that the region has
};

/// Seen from the light, the region's points at an angle theta from the cone's axis are no nearer than those in the
/// plane of the axis and the front's direction, |theta - thetaFront| from the latter. On either side of the front's
/// direction cone and distance are then monotone in theta, and branch and bound holds functions of both between their
/// values at the ends of intervals. The interval with the largest bound is halved, a fixed number of times: results are
/// continuous in all parameters, whichever of two equals comes first.
class ConeSweep {
 public:
  /// The light is outside the region: front.distance > 0.
  ConeSweep(const LightField& field, const SpotCone& cone, const Front& front) noexcept;

  // M: window times cone, E: the light's peak without them; over the region.
  double peak() const noexcept { return above(0); }  // largest M E
  double above(double least) const noexcept;         // largest (M - least) E, or 0
  double below(double most) const noexcept;          // largest (most - M) E, or 0

 private:
  /// What an angle from the front's direction stands for.
  struct Edge {
    double off;     // the angle
    double near;    // distance to the nearest point there
    double peak;    // E at that distance
    double window;  // at that distance
    double cosine;  // to the axis
  };
  template <class Bound>
  double largest(double side, const Bound& bound) const noexcept;
  Edge edge(double off, double side) const noexcept;
  double window(double rho) const noexcept;
  double smooth(double cosine) const noexcept;

  const LightField& field_;
  SpotCone cone_;
  Front front_;
  double sinAxis_;
  double centre_, ball_;   // where the front is a ball
  double towards_, away_;  // largest angle between the front's direction and a point, towards the axis or not
};

}  // namespace rigel
