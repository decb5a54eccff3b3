// The one light that stands for all others in a specular term, which SH of a few bands are too smooth for.
//
// Band 1 of radiance SH holds, channel by channel, the vector irradiance V = int L(w) w dw = sqrt(4 pi/3) (L_11, L_1-1,
// L_10) (A. Gershun, "The Light Field", 1936; P.-P. Sloan, "Stupid Spherical Harmonics Tricks", GDC 2008, takes the
// direction from it too). The direction d is that of its luminance. The colour is V . d, the least-squares fit of
// directional light to band 1, negative channels held at 0 and the rest scaled so that the luminance stays |V|.
//
// Sloan also fits band 2, weighted as Lambert sees it, beside a constant. That comes closer to the brighter of two
// opposite lights, but does not vanish where they cancel and the direction flips: a highlight would jump. Here the
// colour goes to 0 with the vector that gives the direction, whatever the channels do, so that direction and colour
// together are continuous in the light; and three coefficients are all a shader has to fetch, however many bands.
#pragma once

#include <rigel/sh.h>

namespace rigel {

struct DominantLight {
  Vec3 direction{0, 1, 0};  // unit, towards the light; (0, 1, 0) where there is none
  Rgb irradiance;           // [W/m2] at normal incidence, not negative
};

/// A single directional light of any colour gives itself back, to 5e-7; a single sphere light its direction and its
/// irradiance at normal incidence; uniform light, light without luminance and a NaN give no light. Coefficients of any
/// finite size up to 1e37. About 40 flops, a square root and two divisions; no allocation.
template <int B>
DominantLight dominantLight(const RadianceSH<B>& radiance) noexcept;

}  // namespace rigel
