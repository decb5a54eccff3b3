#include "report/pictures/pixel_frame.h"

#include "parallel/parallel.h"
#include "report/formats/deflate.h"
#include "report/pictures/pixel_packing.h"

#include <algorithm>
#include <cmath>

namespace rigel::tools {

PixelFrame packFrame(const FrameImages& images, float scale, int dropped) {
  PixelFrame out;
  out.width = images.truth.width;
  out.height = images.truth.height;
  out.exact = dropped == 0;
  out.dropped = dropped;
  out.scale = scale;

  const std::size_t count = images.truth.pixelCount();
  std::vector<std::uint8_t> coverage;
  coverage.reserve(2 * count);
  for (const Image* image : {&images.truth, &images.surroundings})
    for (const float share : image->coverage) coverage.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
  PixelMask object{out.width, out.height, std::vector<bool>(count)}, others = object;
  for (std::size_t i = 0; i < count; ++i) {
    object.covered[i] = coverage[i] > 0;
    others.covered[i] = coverage[count + i] > coverage[i];
  }
  out.coverage = deflated(coverage);
  out.reflectance = packPlanes(halfPlanes(images.reflectance, object, 1, dropped), object);
  out.surroundings =
      packPlanes(halfPlanes(images.surroundings, others, 1, std::max(kSurroundingsDropped, dropped)), others);
  const HalfPlanes truth = halfPlanes(images.truth, object, scale, dropped);
  out.truth = packPlanes(truth, object);
  out.rigs.resize(images.rigs.size());
  parallelFor(static_cast<int>(out.rigs.size()), [&](int r) {
    const auto i = static_cast<std::size_t>(r);
    out.rigs[i].irradiance = packPlanes(halfPlanes(images.rigs[i], object, scale, dropped), object, &truth);
  });
  return out;
}

}  // namespace rigel::tools
