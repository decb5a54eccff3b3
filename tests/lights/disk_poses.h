// Disk lights and receivers in the families of poses that break approximations, with normals that look anywhere or put
// the horizon across the disk.
#pragma once

#include <rigel/exact.h>
#include <rigel/light.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lights/describe.h"
#include "lights/random.h"

namespace rigel::test {

enum class DiskFamily { contact, rim, grazing, crossing, random, far };

struct DiskPose {
  DiskLight light;
  Vec3 p;
  Vec3 n;
};

inline const char* nameOf(DiskFamily family) {
  constexpr const char* kNames[] = {"contact", "rim", "grazing emitter", "horizon crossing", "random", "far"};
  return kNames[static_cast<int>(family)];
}

inline std::string describe(const DiskPose& pose) {
  return "disk at " + describe(pose.light.position) + ", direction " + describe(pose.light.direction) + ", radius " +
         describe(pose.light.radius) + (pose.light.twoSided ? ", two-sided" : "") + ", p " + describe(pose.p) + ", n " +
         describe(pose.n);
}

inline Vec3 unit(Vec3 v) { return v * (1 / length(v)); }

inline Vec3 perpendicular(Random& random, Vec3 v) { return unit(cross(v, random.direction())); }

/// A normal at `p` for which the horizon passes through or near some point of the rim.
inline Vec3 normalAcross(Random& random, const DiskLight& light, Vec3 p) {
  const Vec3 rim = light.position + perpendicular(random, light.direction) * light.radius;
  const Vec3 w = rim - p;
  const float d = length(w);
  if (!(d > 0)) return random.direction();
  const Vec3 across = perpendicular(random, w * (1 / d));
  return unit(across + w * ((random.index(2) == 0 ? 0.0f : random.uniformf(-0.2, 0.2)) / d));
}

/// The length of the vector irradiance, of which E(n) - E(-n) is the component along n.
inline double peakOf(const DiskLight& light, Vec3 p) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 n;
    n[axis] = 1;
    const double along = exactIrradiance(light, p, n).r - exactIrradiance(light, p, -n).r;
    squared += along * along;
  }
  return std::sqrt(squared);
}

/// Distances in radii, the light within a few radii of the origin.
inline DiskPose diskPose(Random& random, DiskFamily family) {
  double rho = 0;
  double z = 0;
  switch (family) {
    case DiskFamily::contact:
      rho = random.uniform(0, 0.98);
      z = random.logUniform(1e-6, 1e-2);
      break;
    case DiskFamily::rim: {
      const double angle = random.uniform(0, M_PI);
      const double gap = random.logUniform(1e-5, 0.1);
      rho = 1 + gap * std::cos(angle);
      z = gap * std::sin(angle);
      break;
    }
    case DiskFamily::grazing: {
      const double d = random.logUniform(1.05, 20);
      const double angle = random.logUniform(1e-4, 0.1);
      rho = d * std::cos(angle);
      z = d * std::sin(angle);
      break;
    }
    case DiskFamily::crossing:
    case DiskFamily::random: {
      const double angle = std::acos(random.uniform());
      const double d = random.logUniform(0.05, 20);
      rho = d * std::sin(angle);
      z = d * std::cos(angle);
      break;
    }
    case DiskFamily::far: {
      const double angle = std::acos(random.uniform());
      const double d = random.logUniform(20, 1e7);
      rho = d * std::sin(angle);
      z = d * std::cos(angle);
      break;
    }
  }
  DiskPose pose;
  pose.light.direction = random.direction();
  pose.light.radius = static_cast<float>(random.logUniform(1e-3, 1e3));
  pose.light.position = random.pointInCube(static_cast<double>(pose.light.radius) * 0.3);
  pose.light.radiance = {1, 1, 1};
  pose.light.twoSided = random.index(4) == 0;
  const auto side = static_cast<float>(pose.light.twoSided && random.index(2) == 0 ? -z : z);
  pose.p = pose.light.position +
           (pose.light.direction * side + perpendicular(random, pose.light.direction) * static_cast<float>(rho)) *
               pose.light.radius;
  const bool across = family == DiskFamily::crossing || random.index(2) == 0;
  pose.n = across ? normalAcross(random, pose.light, pose.p) : random.direction();
  return pose;
}

}  // namespace rigel::test
