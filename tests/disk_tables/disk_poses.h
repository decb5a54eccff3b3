// Random disk lights and receivers in front of them.
#pragma once

#include <rigel/light.h>

#include <algorithm>
#include <cmath>

#include "lights/random.h"

namespace rigel::test {

struct DiskPose {
  DiskLight light;
  Vec3 p;
  double rimDistance = 0;  // in radii
};

/// The disk at the origin, `radius` m large, facing any way; the receiver in front of it in all directions, half of
/// them about the centre at distances of 1e-3 to 1e4 radii, half about a point of the rim at 1e-6 to 1.
inline DiskPose randomDiskPose(Random& random, double radius = 1) {
  const Vec3 axis = random.direction();
  Vec3 side = random.direction();
  const float along = side.x * axis.x + side.y * axis.y + side.z * axis.z;
  side = side - axis * along;
  side = side * (1 / std::hypot(side.x, side.y, side.z));
  Vec3 up = random.direction();
  const float height = up.x * axis.x + up.y * axis.y + up.z * axis.z;
  if (height < 0) up = up - axis * (2 * height);
  // A third of the receivers at grazing angles, down to 1e-6 of the distance.
  if (random.index(3) == 0) up = up - axis * (std::abs(height) * (1 - static_cast<float>(random.logUniform(1e-6, 1))));
  const bool atRim = random.index(2) == 0;
  const auto distance = static_cast<float>(atRim ? random.logUniform(1e-6, 1) : random.logUniform(1e-3, 1e4));
  const Vec3 inRadii = (atRim ? side : Vec3{}) + up * distance;

  DiskPose pose;
  pose.light = {{0, 0, 0}, axis, static_cast<float>(radius), random.colour(), random.index(4) == 0};
  pose.p = inRadii * static_cast<float>(radius);
  const double z = double(inRadii.x) * axis.x + double(inRadii.y) * axis.y + double(inRadii.z) * axis.z;
  const double square = double(inRadii.x) * inRadii.x + double(inRadii.y) * inRadii.y + double(inRadii.z) * inRadii.z;
  pose.rimDistance = std::hypot(std::sqrt(std::max(0.0, square - z * z)) - 1, z);
  return pose;
}

}  // namespace rigel::test
