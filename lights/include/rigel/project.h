// Projection of lights into radiance SH at a receiver point, with analytic spatial gradient: the float runtime path.
//
// q_lm = 2 pi L g_l Y_lm(w), s2 = (r/d)^2, c = sqrt(1-s2), g_l = s2 P_l'(c)/(l(l+1)), in a form that neither cancels
// for small r/d nor near contact. Inside a sphere (d < r) the continuous extension: hemisphere at d = r, full sphere at
// d = 0. Distances are formed in double from the float positions, the rest is float. Total functions: input of any
// scale gives finite output (see kMaxProjectionScale); a light contributes 0 where it or p holds a NaN or is infinitely
// far (a directional light looks at no p).
//
// Disks: six nodes of quadrature, see disk.h for their formula, their error and other methods.
#pragma once

#include <rigel/light.h>
#include <rigel/sh.h>
#include <rigel/shader_constants.h>

namespace rigel {

/// The magnitude a light's scale (flux 2 pi L min(1,(r/d)^2), and its derivative) is held to. Far above any physical
/// light, and so far below the largest float that a hundred thousand lights at the limit still sum to a finite value.
inline constexpr float kMaxProjectionScale = static_cast<float>(kRigelMaxScale);

/// SH of one light at `p` (world, metres). No pi, no f_l. B in 2..5. About 50 flops + 6 B^2; no allocation.
/// `footprint` [m] > 0: p stands for a patch of that radius, not for a point. The light is then taken to be at least
/// that large, at equal power, so that a light which nearly touches p counts with about what the patch receives on
/// average and not with the peak under it.
template <int B>
RadianceSH<B> project(const DirectionalLight& light, Vec3 p, float footprint = 0) noexcept;
template <int B>
RadianceSH<B> project(const PointLight& light, Vec3 p, float footprint = 0) noexcept;
template <int B>
RadianceSH<B> project(const SpotLight& light, Vec3 p, float footprint = 0) noexcept;
template <int B>
RadianceSH<B> project(const SphereLight& light, Vec3 p, float footprint = 0) noexcept;
template <int B>
RadianceSH<B> project(const DiskLight& light, Vec3 p, float footprint = 0) noexcept;

/// SH and its derivative by p. Range window and spot cone enter by the product rule. The true derivative is unbounded
/// at a sphere's surface (1/c): c is held >= kMinGradientCosine there; and at a disk's rim, where it is the true one
/// times min(1, distance / (kMinGradientRim radius)). The slope of a disk's light jumps at the disk's plane: it comes
/// in with min(1, sine / kMinGradientSine), sine the height over the plane per distance from the centre, so that
/// gradient rigs which pass the plane do not. Error of the largest component: 1e-6, disks 2e-6 outside of that.
inline constexpr float kMinGradientCosine = 0.1f;
inline constexpr float kMinGradientRim = 0.01f;
inline constexpr float kMinGradientSine = 0.1f;

template <int B>
struct ProjectionWithGradient {
  RadianceSH<B> value;
  RadianceShGradient<B> gradient;
};
template <int B>
ProjectionWithGradient<B> projectWithGradient(const DirectionalLight& light, Vec3 p) noexcept;
template <int B>
ProjectionWithGradient<B> projectWithGradient(const PointLight& light, Vec3 p) noexcept;
template <int B>
ProjectionWithGradient<B> projectWithGradient(const SpotLight& light, Vec3 p) noexcept;
template <int B>
ProjectionWithGradient<B> projectWithGradient(const SphereLight& light, Vec3 p) noexcept;
template <int B>
ProjectionWithGradient<B> projectWithGradient(const DiskLight& light, Vec3 p) noexcept;

/// Sum over all lights of the set.
template <int B>
RadianceSH<B> project(const LightSet& lights, Vec3 p, float footprint = 0) noexcept;
template <int B>
ProjectionWithGradient<B> projectWithGradient(const LightSet& lights, Vec3 p) noexcept;

}  // namespace rigel
