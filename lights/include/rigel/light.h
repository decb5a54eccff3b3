// The light kinds and LightSet, their structure-of-arrays container.
//
// Every local light but the disk is a sphere of uniform radiance L: what is called a point light is one whose radius is
// small and whose radiance is I/(pi radius^2), so that it gives I/d^2 outside and stays bounded inside; a spot light is
// a point light times a cone that is evaluated where the receiver stands.
#pragma once

#include <rigel/vec3.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rigel {

inline constexpr float kDefaultPointRadius = 0.01f;  // m
inline constexpr float kMinPointRadius = 1e-6f;      // m; smaller radii (0 included) are raised to it
/// The cone's smoothstep spans at least this much of the cosine, so that inner == outer is a steep edge, not a jump.
inline constexpr float kMinConeWidth = 1e-4f;
inline constexpr float kNoRange = std::numeric_limits<float>::infinity();

/// A distant light; `direction` is the way the light travels (need not be unit), `irradiance` at normal incidence.
/// Without a direction (zero or infinite length) it contributes nothing.
struct DirectionalLight {
  Vec3 direction{0, -1, 0};
  Rgb irradiance;
};

/// Intensity I [W/sr]: irradiance I/d^2 at distance d >= radius. `range` R applies the window clamp(1-(d/R)^4, 0, 1)^2,
/// glTF's own window squared, which has no kink at R; a range that is not positive leaves no light.
struct PointLight {
  Vec3 position;
  Rgb intensity;
  float radius = kDefaultPointRadius;
  float range = kNoRange;
};

/// A point light within a cone along `direction` (need not be unit): full inside `innerAngle`, none outside
/// `outerAngle` (radians from the axis, 0 <= inner <= outer <= pi), smoothstep of the cosine between. Without a
/// direction it contributes nothing.
struct SpotLight {
  Vec3 position;
  Vec3 direction{0, -1, 0};
  Rgb intensity;
  float innerAngle = 0;
  float outerAngle = 0.785398163f;
  float radius = kDefaultPointRadius;
  float range = kNoRange;
};

/// A sphere of uniform radiance [W/(m2 sr)]. A radius that is not positive leaves no light.
struct SphereLight {
  Vec3 position;
  float radius = 0;
  Rgb radiance;
};

/// A flat disk of uniform radiance [W/(m2 sr)] that emits along `direction` (need not be unit), and backwards too where
/// `twoSided`. On its face a receiver sees the hemisphere filled; behind a one-sided disk, and in the plane of any, no
/// light. Without a direction, or with a radius that is not positive, it contributes nothing.
struct DiskLight {
  Vec3 position;
  Vec3 direction{0, -1, 0};
  float radius = 0;
  Rgb radiance;
  bool twoSided = false;
};

/// What a light's brightness is proportional to, whatever its kind: irradiance [W/m2] of a directional light, intensity
/// [W/sr] of a point or spot light, radiance [W/(m2 sr)] of a sphere or disk light. SH and irradiance are linear in it.
constexpr Rgb colourOf(const DirectionalLight& light) noexcept { return light.irradiance; }
constexpr Rgb colourOf(const PointLight& light) noexcept { return light.intensity; }
constexpr Rgb colourOf(const SpotLight& light) noexcept { return light.intensity; }
constexpr Rgb colourOf(const SphereLight& light) noexcept { return light.radiance; }
constexpr Rgb colourOf(const DiskLight& light) noexcept { return light.radiance; }
constexpr Rgb& colourOf(DirectionalLight& light) noexcept { return light.irradiance; }
constexpr Rgb& colourOf(PointLight& light) noexcept { return light.intensity; }
constexpr Rgb& colourOf(SpotLight& light) noexcept { return light.intensity; }
constexpr Rgb& colourOf(SphereLight& light) noexcept { return light.radiance; }
constexpr Rgb& colourOf(DiskLight& light) noexcept { return light.radiance; }

/// Sets of lights that an object may ask for: a light shines on an object where their masks share a bit.
inline constexpr std::uint32_t kAllLightGroups = 0xffffffffu;

/// All lights of a frame, structure of arrays per kind. Filling it allocates only while it grows; `clear` keeps
/// capacity. `index` arguments run within a kind. Groups are for whoever picks lights for an object (light_tree.h);
/// projections sum over all lights. Not thread safe for writers; any number of readers.
class LightSet {
 public:
  void clear() noexcept;
  void reserve(int perKind);

  void add(const DirectionalLight& light, std::uint32_t groups = kAllLightGroups);
  void add(const PointLight& light, std::uint32_t groups = kAllLightGroups);
  void add(const SpotLight& light, std::uint32_t groups = kAllLightGroups);
  void add(const SphereLight& light, std::uint32_t groups = kAllLightGroups);
  void add(const DiskLight& light, std::uint32_t groups = kAllLightGroups);

  int directionalCount() const noexcept { return static_cast<int>(directional_.r.size()); }
  int pointCount() const noexcept { return static_cast<int>(point_.r.size()); }
  int spotCount() const noexcept { return static_cast<int>(spot_.r.size()); }
  int sphereCount() const noexcept { return static_cast<int>(sphere_.r.size()); }
  int diskCount() const noexcept { return static_cast<int>(disk_.r.size()); }
  int size() const noexcept { return directionalCount() + pointCount() + spotCount() + sphereCount() + diskCount(); }

  DirectionalLight directional(int index) const noexcept {
    const Directional& l = directional_;
    return {{l.dx[index], l.dy[index], l.dz[index]}, {l.r[index], l.g[index], l.b[index]}};
  }
  PointLight point(int index) const noexcept {
    const Local& l = point_;
    return {l.position(index), l.colour(index), l.radius[index], l.range[index]};
  }
  SpotLight spot(int index) const noexcept {
    const Local& l = spot_;
    return {l.position(index),  {cone_.dx[index], cone_.dy[index], cone_.dz[index]},
            l.colour(index),    cone_.inner[index],
            cone_.outer[index], l.radius[index],
            l.range[index]};
  }
  SphereLight sphere(int index) const noexcept {
    const Local& l = sphere_;
    return {l.position(index), l.radius[index], l.colour(index)};
  }
  DiskLight disk(int index) const noexcept {
    const Local& l = disk_;
    return {l.position(index),
            {face_.dx[index], face_.dy[index], face_.dz[index]},
            l.radius[index],
            l.colour(index),
            face_.twoSided[index] != 0};
  }

  /// Group mask of light `i` of all, counted as `visit` does.
  std::uint32_t groups(int i) const noexcept {
    for (const std::vector<std::uint32_t>& kind : groups_) {
      const int count = static_cast<int>(kind.size());
      if (i < count) return kind[i];
      i -= count;
    }
    return 0;
  }

  /// `f(light)` with light `i` of all, counted in the order directional, point, spot, sphere, disk; its result.
  template <class F>
  decltype(auto) visit(int i, F&& f) const {
    if (i < directionalCount()) return f(directional(i));
    i -= directionalCount();
    if (i < pointCount()) return f(point(i));
    i -= pointCount();
    if (i < spotCount()) return f(spot(i));
    i -= spotCount();
    if (i < sphereCount()) return f(sphere(i));
    return f(disk(i - sphereCount()));
  }
  /// The same of all lights, in this order.
  template <class F>
  void visitAll(F&& f) const {
    for (int i = 0, n = directionalCount(); i < n; ++i) f(directional(i));
    for (int i = 0, n = pointCount(); i < n; ++i) f(point(i));
    for (int i = 0, n = spotCount(); i < n; ++i) f(spot(i));
    for (int i = 0, n = sphereCount(); i < n; ++i) f(sphere(i));
    for (int i = 0, n = diskCount(); i < n; ++i) f(disk(i));
  }

 private:
  using Floats = std::vector<float>;
  struct Directional {
    Floats dx, dy, dz, r, g, b;
  } directional_;
  struct Local {  // of each kind what a point light has; colour is intensity, or radiance for spheres and disks
    Floats x, y, z, radius, range, r, g, b;

    Vec3 position(int i) const noexcept { return {x[i], y[i], z[i]}; }
    Rgb colour(int i) const noexcept { return {r[i], g[i], b[i]}; }
    void push(Vec3 position, float sphereRadius, float windowRange, Rgb colour);
  } point_, spot_, sphere_, disk_;
  struct Cone {
    Floats dx, dy, dz, inner, outer;
  } cone_;
  struct Face {
    Floats dx, dy, dz;
    std::vector<std::uint8_t> twoSided;
  } face_;
  std::array<std::vector<std::uint32_t>, 5> groups_;  // per kind, in the order of visit
};

}  // namespace rigel
