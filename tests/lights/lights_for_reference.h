// Random lights around random receivers at every scale, for comparison with the 50-digit reference.
#pragma once

#include <rigel/light.h>

#include <algorithm>

#include "lights/random.h"

namespace rigel::test {

/// A receiver and a centre at about `distance` from it, both rounded to float; the receiver is off the origin.
struct Placement {
  Vec3 receiver;
  Vec3 centre;
  double distance = 0;  // of the rounded positions
};

inline Placement place(Random& random, double distance) {
  Placement out;
  out.receiver = random.pointInCube(2 * distance);
  out.centre = out.receiver + random.direction() * static_cast<float>(distance);
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double difference = static_cast<double>(out.centre[axis]) - out.receiver[axis];
    squared += difference * difference;
  }
  out.distance = std::sqrt(squared);
  return out;
}

/// The largest float not above `value`, so that a ratio asked for is not exceeded by rounding.
inline float floatBelow(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest <= value ? nearest : std::nextafter(nearest, 0.0f);
}

inline SphereLight sphereAt(const Placement& at, double radiusOverDistance) {
  return {at.centre, floatBelow(radiusOverDistance * at.distance), {1, 1, 1}};
}

inline PointLight pointAt(Random& random, const Placement& at, double radiusOverDistance) {
  PointLight light{at.centre, {1, 1, 1}, floatBelow(radiusOverDistance * at.distance), kNoRange};
  if (random.index(2) == 0) light.range = static_cast<float>(at.distance * random.uniform(1.05, 4));
  return light;
}

/// A spot whose cone contains the receiver, often in its penumbra.
inline SpotLight spotAt(Random& random, const Placement& at, double radiusOverDistance) {
  const PointLight point = pointAt(random, at, radiusOverDistance);
  SpotLight spot{at.centre, {}, {1, 1, 1}, 0, 0, point.radius, point.range};
  const Vec3 wanted = (at.receiver - at.centre) * static_cast<float>(1 / at.distance);
  spot.direction = (wanted + random.direction() * random.uniformf(0, 0.9)) * random.uniformf(0.2, 3);
  const double cosine = static_cast<double>(dot(wanted, spot.direction)) / static_cast<double>(length(spot.direction));
  // The cone's cosine is scaled by d/r inside the light.
  const double scaled = cosine * std::min(1.0, at.distance / static_cast<double>(point.radius));
  const double angle = std::acos(std::clamp(scaled, -1.0, 1.0));
  spot.outerAngle = static_cast<float>(std::min(3.1, angle + random.uniform(0.1, 0.6)));
  spot.innerAngle = static_cast<float>(spot.outerAngle * random.uniform(0, 0.95));
  return spot;
}

/// A ratio r/d: mostly ordinary, often tiny or all but touching, sometimes inside.
inline double hardRatio(Random& random) {
  switch (random.index(5)) {
    case 0:
      return random.logUniform(1e-8, 1e-2);
    case 1:
      return 1 - random.logUniform(1e-7, 0.1);
    case 2:
      return random.logUniform(1, 1e4);
    default:
      return random.uniform(0.01, 1);
  }
}

}  // namespace rigel::test
