// A frame's lights as the vector kernels broadcast them: what depends on the light alone computed once, for all objects
// and threads.
#pragma once

#include <rigel/light.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rigel {

/// One light, as far as it counts: its colour times `share`, which is held within [0, 1] (NaN: 0).
struct LightUse {
  std::uint32_t light = 0;  // as LightSet::visit counts, or what PreparedLights::add returned
  float share = 1;
};

namespace detail {

enum class PreparedKind : std::uint8_t { none, directional, point, spot, sphere, disk };

/// One line of the cache. SH are 2 colour e times functions of order 1, with e = 1/d^2, or (radius/d)^2 of spheres
/// whose area float does not hold.
struct alignas(64) PreparedLight {
  Vec3 position;  // directional: unit vector towards the light
  float radius = 0;
  Rgb colour;               // of spheres times pi radius^2, or times pi alone
  float nearestSquare = 0;  // d^2 from which float does without care: no contact, no overflow
  Vec3 axis;                // spots: unit, over the cone's width, and backwards; disks: as in the light's struct
  float coneOffset = 0;     // the cone's smoothstep is that of axis . w + coneOffset
  float radiusSquare = 0;
  float inverseRangeSquare = 0;            // 0: no window
  PreparedKind kind = PreparedKind::none;  // none: contributes nothing
  bool twoSided = false;
  bool extreme = false;   // float does not do for all points from which it is seen under a small angle
  bool arealess = false;  // a sphere whose colour is without its area
};

}  // namespace detail

/// Not thread safe for writers; any number of readers. 72 bytes a light.
class PreparedLights {
 public:
  /// Replaces all lights; allocates only while their number grows. 10 ns a light.
  void set(const LightSet& lights);

  /// One more, beyond those of the set, until the next `set`; its index. Allocates only while their number grows.
  std::uint32_t add(const SphereLight& light);

  void reserve(int count);

  /// Each of them once, in full.
  std::span<const LightUse> all() const noexcept { return {uses_.data(), lights_.size()}; }

  int size() const noexcept { return static_cast<int>(lights_.size()); }

  /// Internal.
  const detail::PreparedLight& operator[](std::uint32_t index) const noexcept { return lights_[index]; }
  bool anyDirectional() const noexcept { return anyDirectional_; }
  bool anyDisk() const noexcept { return anyDisk_; }

 private:
  detail::PreparedLight& push();

  bool anyDirectional_ = false, anyDisk_ = false;
  std::vector<detail::PreparedLight> lights_;
  std::vector<LightUse> uses_;  // of the first lights; as many as there have been at most
};

}  // namespace rigel
