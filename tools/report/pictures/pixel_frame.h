// One frame of one object as the page's gallery draws it: numbers, not pictures.
#pragma once

#include "picture/image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace rigel::tools {

/// Low bits that the half floats of surroundings always lack: they are looked at, never read out, and no colour changes
/// by more than a step.
inline constexpr int kSurroundingsDropped = 2;

/// Streams are zlib's. Planes as packPlanes() writes them; radiance leaving a pixel towards the camera is
/// reflectance * irradiance + surroundings, premultiplied by coverage.
struct PixelFrame {
  int frame = 0;
  double time = 0;  // s
  int width = 0, height = 0;
  bool exact = false;   // irradiance is that of the OpenEXR files, bit for bit
  int dropped = 0;      // low bits left out of each half float
  float scale = 1;      // W/m2 of a stored 1: a power of two
  float exposure = 1;   // that shows the object best in this frame
  float heatScale = 1;  // relative error at the top of a scale of false colours; one for all rigs

  using Stream = std::vector<std::uint8_t>;
  Stream coverage;      // a byte a pixel: the object's share, 0 to 255; then the same of all that is seen
  Stream reflectance;   // base colour / pi times the object's share, where that is not 0
  Stream surroundings;  // radiance of scenery and lights, where all that is seen exceeds the object's share
  Stream truth;         // irradiance of the object, the mean over its share of the pixel

  struct Rig {
    double rms = 0;     // over the object's pixels, relative to the mean irradiance of the run
    Stream irradiance;  // minus truth
  };
  std::vector<Rig> rigs;  // in the order of ObjectReport::rigs

  std::size_t bytes() const {
    std::size_t sum = coverage.size() + reflectance.size() + surroundings.size() + truth.size();
    for (const Rig& rig : rigs) sum += rig.irradiance.size();
    return sum;
  }
};

/// What a frame is packed from. Coverage of `truth` is the object's share of a pixel, that of `surroundings` all that
/// is seen; irradiance is that of half floats (roundedToHalf), so that nothing is lost with dropped = 0.
struct FrameImages {
  const Image& reflectance;
  const Image& surroundings;
  const Image& truth;
  std::span<const Image> rigs;
};

/// Fills the size, the streams and what decoding needs; all cores.
PixelFrame packFrame(const FrameImages& images, float scale, int dropped);

}  // namespace rigel::tools
