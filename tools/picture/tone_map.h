// From linear radiance to what a screen shows: one exposure for all pictures of a comparison, a soft shoulder, sRGB.
#pragma once

#include "picture/image.h"
#include "picture/raycast.h"

#include <span>

namespace rigel::tools {

/// The exposure that shows the 99th percentile (of each colour's largest channel) at 0.8 of white. 1 where all is
/// black.
float autoExposure(std::span<const Rgb> radiance);

/// The same over the samples of the object alone: neither scenery nor lights in view change it.
float autoExposure(const VisibleSurface& surface, std::span<const Rgb> radiance);

/// Linear [0, inf) to linear [0, 1): the identity up to 0.7, then an exponential approach with continuous slope.
/// Negative and NaN give 0.
float softShoulder(float x);

/// Linear [0, 1] to 8-bit sRGB (IEC 61966-2-1).
std::uint8_t encodeSrgb(float linear);

/// Shown where nothing is hit; display-referred linear.
inline constexpr Rgb kBackdrop{0.0040f, 0.0044f, 0.0056f};

Image8 toneMap(const Image& image, float exposure, Rgb backdrop = kBackdrop);

}  // namespace rigel::tools
