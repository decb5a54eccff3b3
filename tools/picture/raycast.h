// What a camera sees of a posed scene: a list of surface samples to be shaded by whoever wants to (exact irradiance,
// one rig after another), and the sum of shaded samples as a picture. CPU, Embree.
#pragma once

#include "picture/camera.h"
#include "picture/image.h"
#include "scene/pose.h"

#include <memory>
#include <span>
#include <vector>

namespace rigel::tools {

enum class SampleKind : std::uint8_t {
  object,   // what the picture is about: shaded by rig or truth
  scenery,  // shaded by the truth in every picture
  light     // a light source itself: `emission` is its colour
};

/// A point that a pixel shows. `weight` is its share of the pixel; the weights of a pixel sum to its coverage.
struct VisibleSample {
  std::uint32_t pixel = 0;  // row major from the top left
  float weight = 1;
  SampleKind kind = SampleKind::object;
  std::uint32_t part = 0;      // how many objects, or lights, were added before the one hit
  std::uint32_t triangle = 0;  // of that object
  float b1 = 0, b2 = 0;        // barycentrics of the triangle's second and third corner
  Vec3 position;               // world
  Vec3 normal;                 // world, unit: interpolated, or the triangle's own where the mesh has none
  Rgb baseColour;
  float wrap = 0;
  Rgb emission;
};

/// Samples ordered by pixel.
struct VisibleSurface {
  int width = 0, height = 0;
  std::vector<VisibleSample> samples;
};

/// How a light is shown in a picture: a ball of one colour, or a disk that is black from behind.
struct LightMarker {
  Vec3 centre;
  float radius = 0;
  Rgb emission;
  Vec3 axis;              // disk: unit, the way it emits; zero for a ball
  bool twoSided = false;  // disk: of one colour from behind too

  bool isDisk() const { return !(axis == Vec3{}); }
};

/// Neither copied nor shared between threads while it is filled. Objects are copied: they may go once added.
class RayCaster {
 public:
  RayCaster();
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  void add(const SceneObject& object, const PosedObject& posed, SampleKind kind = SampleKind::object);

  /// Shows a light. Rays that start inside a ball do not see it.
  void addLight(const LightMarker& light);

  /// One sample a pixel; perSide x perSide where neighbouring pixels show other surfaces, so that edges come out
  /// smooth at little more than the cost of one. Uses all cores.
  VisibleSurface cast(const Camera& camera, int perSide = 3) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Every light of the set that has a place, at least `minRadius` large so that points can be seen; its colour is the
/// light's, scaled to a largest channel of `brightness`.
std::vector<LightMarker> lightMarkers(const LightSet& lights, float minRadius, float brightness);
void addLights(RayCaster& caster, const LightSet& lights, float minRadius, float brightness);

/// Radiance that leaves a sample towards the camera: Lambert's base colour E/pi, or a light's own.
Rgb outgoingRadiance(const VisibleSample& sample, Rgb irradiance);

/// The picture of one colour a sample.
Image resolve(const VisibleSurface& surface, std::span<const Rgb> colours);

}  // namespace rigel::tools
