// Random lights around, on and in a box: what the bounds are tested on.
#pragma once

#include <rigel/light.h>
#include <rigel/rig.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rigel::test {

/// Distances from .001 to 100 object sizes from a random point of the box's surface (log), radii 1e-4 to 1 sizes (log);
/// one in eight inside the box, one in eight touching it with its surface, one in sixteen exactly at a corner, an edge,
/// a face or the centre.
class RandomLights {
 public:
  /// `ellipsoid`: the object is the box's inscribed ellipsoid, and distances are from that.
  RandomLights(const RigBox& box, unsigned seed, bool ellipsoid = false)
      : box_(box), random_(seed), ellipsoid_(ellipsoid) {
    const Vec3 e = box.hi - box.lo;
    size_ = std::max({e.x, e.y, e.z});
  }

  SphereLight sphere() {
    place();
    return {position_, radius_, {1, 1, 1}};
  }
  PointLight point() {
    place();
    return {position_, {1, 1, 1}, radius_, range()};
  }
  /// Half of the disks aim at the object; of the others half have their plane through it, half look anywhere. One in
  /// four is two-sided.
  DiskLight disk() {
    place();
    Vec3 axis = onOrIn() - position_;
    const float distance = length(axis);
    axis = distance > 0 ? axis * (1 / distance) : direction();
    const double kind = uniform(0, 1);
    if (kind < 0.25) {
      axis = tilted(axis, M_PI / 2 + uniform(-0.05, 0.05) * uniform(0, 1));
    } else if (kind < 0.5) {
      axis = direction();
    }
    return {position_, axis * static_cast<float>(uniform(0.5, 2)), radius_, {1, 1, 1}, uniform(0, 1) < 0.25};
  }
  /// Half of the cones aim at the object, half have their rim on it.
  SpotLight spot() {
    place();
    const double outer = uniform(0.02, 1.5);
    const double inner = outer * (uniform(0, 1) < 0.1 ? 1 : uniform(0, 1));
    const Vec3 target = onOrIn();
    Vec3 axis = target - position_;
    const float distance = length(axis);
    axis = distance > 0 ? axis * (1 / distance) : direction();
    if (uniform(0, 1) < 0.5) axis = tilted(axis, uniform(0.5 * inner, 1.3 * outer));
    return {position_,
            axis * static_cast<float>(uniform(0.5, 2)),
            {1, 1, 1},
            static_cast<float>(inner),
            static_cast<float>(outer),
            radius_,
            range()};
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  double logUniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  Vec3 direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * M_PI), s = std::sqrt(1 - z * z);
    return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z)};
  }
  Vec3 onOrIn() {
    Vec3 p;
    for (int a = 0; a < 3; ++a) p[a] = static_cast<float>(uniform(box_.lo[a], box_.hi[a]));
    return p;
  }
  /// A point of the surface and its outward normal.
  Vec3 onSurface(Vec3& normal) {
    normal = {};
    if (ellipsoid_) {
      const Vec3 centre = (box_.lo + box_.hi) * 0.5f;
      const Vec3 half = (box_.hi - box_.lo) * 0.5f;
      const Vec3 u = direction();
      normal = {u.x / half.x, u.y / half.y, u.z / half.z};
      normal = normal * (1 / length(normal));
      return centre + Vec3{u.x * half.x, u.y * half.y, u.z * half.z};
    }
    Vec3 p = onOrIn();
    const int axis = std::uniform_int_distribution<int>(0, 2)(random_);
    const bool high = uniform(0, 1) < 0.5;
    p[axis] = high ? box_.hi[axis] : box_.lo[axis];
    normal[axis] = high ? 1.0f : -1.0f;
    return p;
  }
  Vec3 tilted(Vec3 v, double angle) {
    Vec3 across = cross(v, direction());
    const float l = length(across);
    if (!(l > 0)) return v;
    across = across * (1 / l);
    return v * static_cast<float>(std::cos(angle)) + across * static_cast<float>(std::sin(angle));
  }
  float range() {
    if (uniform(0, 1) < 0.5) return kNoRange;
    return static_cast<float>((distance_ + 0.3 * size_ * uniform(0, 1)) * logUniform(0.9, 10));
  }
  void place() {
    radius_ = static_cast<float>(size_ * logUniform(1e-4, 1));
    const double kind = uniform(0, 1);
    Vec3 normal;
    const Vec3 p = onSurface(normal);
    Vec3 outward = direction();
    if (dot(outward, normal) < 0) outward = -outward;
    if (kind < 0.0625) {
      for (int a = 0; a < 3; ++a) {
        const int where = std::uniform_int_distribution<int>(0, 2)(random_);
        position_[a] = where == 0 ? box_.lo[a] : where == 1 ? box_.hi[a] : 0.5f * (box_.lo[a] + box_.hi[a]);
      }
      distance_ = 0;
    } else if (kind < 0.1875) {
      position_ = onOrIn();
      distance_ = 0;
    } else if (kind < 0.3125) {
      // The surface touches: the centre is its radius away from the face, a little more or less.
      distance_ = radius_ * (1 + (uniform(0, 1) < 0.7 ? 1 : -1) * logUniform(1e-6, 0.1));
      position_ = p + normal * static_cast<float>(distance_);
    } else {
      distance_ = size_ * logUniform(1e-3, 100);
      position_ = p + outward * static_cast<float>(distance_);
    }
  }

  RigBox box_;
  std::mt19937 random_;
  bool ellipsoid_;
  float size_;
  Vec3 position_;
  float radius_ = 0;
  double distance_ = 0;
};

}  // namespace rigel::test
