// Lights evaluated one by one at every point shaded: the float runtime form of the exact irradiance, for the few lights
// that come too close for a rig. Shaders mirror these functions.
#pragma once

#include <rigel/light.h>
#include <rigel/wrap.h>

namespace rigel {

/// A light of any kind as the near path reads it.
struct NearLight {
  enum class Kind : int { directional, point, spot, sphere, disk };
  Kind kind = Kind::sphere;
  float share = 1;  // of the light that is evaluated here; the rest is in the rig
  Vec3 position;    // directional: unit vector towards the light
  float radius = 0;
  Rgb colour;  // as in the light's own struct, not yet multiplied by share
  float range = kNoRange;
  Vec3 axis;                          // spot, disk: unit, the way the light travels
  float cosOuter = -1, cosInner = 1;  // spot; disk: cosOuter 0 where it is one-sided, -1 where both faces emit
};

/// `share` is held within [0, 1] (NaN: 0). A light that by light.h contributes nothing (NaN, no direction, no radius,
/// no range) gets share 0 and no colour.
NearLight nearLight(const DirectionalLight& light, float share = 1) noexcept;
NearLight nearLight(const PointLight& light, float share = 1) noexcept;
NearLight nearLight(const SpotLight& light, float share = 1) noexcept;
NearLight nearLight(const SphereLight& light, float share = 1) noexcept;
NearLight nearLight(const DiskLight& light, float share = 1) noexcept;

/// The light as shaders read it, what they would have to divide divided.
GpuNearLight gpuNearLight(const NearLight& light) noexcept;

/// What the near path needs of a wrap: the same here and on the GPU (wrap.h).
using NearWrap = GpuWrap;
inline NearWrap nearWrap(float a = 0) noexcept { return gpuWrap(a); }

/// share * wrap.gain * irradiance [W/m2] at `p` with unit normal `n`: horizon clipped, window and cone at p, and inside
/// a sphere the continuous extension, as exact.h. Largest error relative to the light's peak over normals, at any
/// distance, touching and inside: Lambert (a = 0) 7e-7; wrap 0.8 % for a in (0, 1), 1.1 % from -0.1 and 2.1 % from
/// -0.25; a = 1 7e-7. A spot's cone adds what float leaves of it, 2e-7 / (cosInner - cosOuter). Wrap takes one power,
/// as a polynomial (none where r/d > 0.6); Lambert takes two inverse functions where the light crosses the horizon and
/// nothing elsewhere. Disks, per vector irradiance pi L sx sy (shader_disk.h): Lambert 1.0e-6 everywhere, on the face,
/// the rim and in grazing light too; wrap 1.5 % for a in (0, 1), 2.8 % from -0.1, 3.8 % from -0.25; a = 1 2e-4, what
/// its six nodes leave. A disk whose direction is not unit turns by a rounding of float, which counts within 1e-3 radii
/// of the rim. NaN in p or n gives 0; every result is finite, held to kMaxProjectionScale (project.h). No allocation;
/// any number of threads.
Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept;

/// The same, for a wrap that is not kept.
Rgb nearIrradiance(const NearLight& light, Vec3 p, Vec3 n, float wrap = 0) noexcept;

/// Lambert without inverse function or branch: within 0.5 % of the peak for r/d <= 0.7, 1.3 % at any distance. The
/// clamped cosine blurred into a parabola between x = -s and x = s, corrected so that a sphere that touches is exact.
/// Disks take the parabola of a sphere as large as they are along the normal: within 12 % of the peak, 20 % closer than
/// 0.1 radii to the rim, 4 % on the face, 0.04 % beyond 20 radii.
Rgb cheapIrradiance(const NearLight& light, Vec3 p, Vec3 n) noexcept;

/// What 3-band SH leave out of the light: to be added at p where the light itself is in a rig. The kernel less its own
/// 3 bands, f(x) - sum_{l<3} (2l+1)/4 f_l P_l(x), times the irradiance, faded out where the light is so large that SH
/// hold it. Of the truncation, up to 9.4 % of the peak for Lambert (18 % for a = -0.25, 2.9 % for 0.5), it leaves 3.3 %
/// (7.3, 1.6); of a distant light's, nothing. May be negative. Where a light is far off, a directional light with the
/// direction and irradiance at the object's centre will do, and costs 18 flops.
Rgb correctorIrradiance(const NearLight& light, Vec3 p, Vec3 n, const NearWrap& wrap) noexcept;

}  // namespace rigel
