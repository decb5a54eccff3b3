// A rendered frame against irradiance from elsewhere, where both see the same triangle.
#pragma once

#include "picture/raycast.h"
#include "render/rendered_frame.h"

namespace rigel::tools {

/// Over pixels that show an object (not scenery) in the ray-cast picture. Relative to the mean of the reference
/// irradiance over the pixels compared and channels; all 0 where there is no light.
struct Difference {
  double rms = 0;
  double max = 0;
  double p99 = 0;            // of the largest channel of each pixel
  double mean = 0;           // of the reference [W/m2]
  std::size_t covered = 0;   // pixels that show an object in the ray-cast picture
  std::size_t compared = 0;  // of them, those where both see the same triangle
};

/// `seen` is cast with one sample a pixel; `reference` has an entry a sample. `partOf[i]` is the RenderedFrame::part of
/// the i-th object that `seen` was given.
Difference compare(const RenderedFrame& frame, const VisibleSurface& seen, std::span<const Rgb> reference,
                   std::span<const std::uint32_t> partOf);

}  // namespace rigel::tools
