// Lights evaluated one by one at every point shaded: the float runtime form of the exact irradiance, for the few lights
// that come too close for a rig.
#pragma once

#include <rigel/light.h>
#include <rigel/wrap.h>

namespace rigel {

/// A light of any kind as the near path reads it. Plain floats, so that it can be copied to a GPU as it is.
struct NearLight {
  enum class Kind : int { directional, point, spot, sphere };
  Kind kind = Kind::sphere;
  float share = 1;  // of the light that is evaluated here; the rest is in the rig
  Vec3 position;    // directional: unit vector towards the light
  float radius = 0;
  Rgb colour;  // as in the light's own struct, not yet multiplied by share
  float range = kNoRange;
  Vec3 axis;  // spot: unit, the way the light travels
  float cosOuter = -1, cosInner = 1;
};

/// `share` is held within [0, 1]. A light that contributes nothing by light.h (NaN, no direction, no radius, no range)
/// becomes black; colours are held within kMaxProjectionScale (project.h).
NearLight nearLight(const DirectionalLight& light, float share = 1) noexcept;
NearLight nearLight(const PointLight& light, float share = 1) noexcept;
NearLight nearLight(const SpotLight& light, float share = 1) noexcept;
NearLight nearLight(const SphereLight& light, float share = 1) noexcept;

/// What the near path needs to know of a wrap: made once a material.
struct NearWrap {
  float a = 0;
  std::array<float, kMaxBands> f{};  // wrapCoefficients
};
NearWrap nearWrap(float a) noexcept;

/// share * irradiance at `p`, unit normal `n`, wrap `a`: horizon clipped, the same special cases as exact.h.
Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept;
Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;

}  // namespace rigel
