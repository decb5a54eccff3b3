// A rendered frame against irradiance from elsewhere, where both see the same triangle.
#pragma once

#include "picture/raycast.h"
#include "render/rendered_frame.h"

namespace rigel::tools {

/// Over pixels that show an object (not scenery) in the ray-cast picture. Relative to the mean of the reference
/// irradiance over the pixels compared and channels; where that is black, to the RMS difference (or 1 without any).
struct Difference {
  double rms = 0;
  double max = 0;
  double p99 = 0;            // of the largest channel of each pixel
  double mean = 0;           // of the reference [W/m2]
  double apart = 0;          // largest distance of the points that the two saw, over the radius of what is framed
  std::size_t covered = 0;   // pixels that show an object in the ray-cast picture
  std::size_t compared = 0;  // of them, those where both see the same triangle
};

/// Puts the points that the GPU shaded in place of those that rays met, where both saw the same triangle, and returns
/// the largest distance between the two [m]. Interpolation in another order moves a point by a millionth of the
/// picture, and where a light touches the surface, light changes by a thousandth over that: what is to be compared is
/// shading.
double takePoints(const RenderedFrame& frame, const RenderedPoints& points, std::span<const std::uint32_t> partOf,
                  VisibleSurface& seen);

/// `seen` is cast with one sample a pixel; `reference` has an entry a sample. `partOf[i]` is the RenderedFrame::part of
/// the i-th object that `seen` was given.
Difference compare(const RenderedFrame& frame, const VisibleSurface& seen, std::span<const Rgb> reference,
                   std::span<const std::uint32_t> partOf);

}  // namespace rigel::tools
