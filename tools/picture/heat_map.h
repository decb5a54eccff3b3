// False-colour pictures of relative error, with their scale drawn in.
#pragma once

#include "picture/image.h"
#include "picture/raycast.h"

#include <span>

namespace rigel::tools {

/// Colour of t in [0, 1] (clamped; NaN counts as 1): dark violet over red to pale yellow, of evenly rising lightness,
/// so that it reads the same in grey print and with colour-blind eyes.
Rgb8 heatColour(float t);

/// One error a sample (relative: 0.1 is 10 %); only samples of the object count, everything else is neutral grey.
/// `maxError` is the top of the scale drawn in the lower left corner; larger errors show the top colour.
Image8 heatMap(const VisibleSurface& surface, std::span<const float> error, float maxError);

/// A round top of the scale (1, 2 or 5 times a power of ten) that at most a tenth of the object's samples exceed.
float heatScale(const VisibleSurface& surface, std::span<const float> error);

}  // namespace rigel::tools
