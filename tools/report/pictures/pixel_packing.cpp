#include "report/pictures/pixel_packing.h"

#include "report/formats/deflate.h"

#include <half.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel::tools {
namespace {

constexpr float kLargestHalf = 65504;

std::int16_t asSigned(std::uint16_t v) { return static_cast<std::int16_t>(v); }
std::uint16_t modulo(int v) { return static_cast<std::uint16_t>(v & 0xFFFF); }
std::uint16_t zigzag(std::uint16_t v) { return modulo((v << 1) ^ (asSigned(v) < 0 ? 0xFFFF : 0)); }

/// Where each pixel's value stands in a plane; -1 where it has none.
std::vector<int> placesOf(const PixelMask& mask) {
  std::vector<int> places(mask.covered.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (mask.covered[i]) places[i] = next++;
  return places;
}

std::uint16_t medianPrediction(std::uint16_t left, std::uint16_t up, std::uint16_t upLeft) {
  const std::int16_t a = asSigned(left), b = asSigned(up), c = asSigned(upLeft);
  if (c >= std::max(a, b)) return modulo(std::min(a, b));
  if (c <= std::min(a, b)) return modulo(std::max(a, b));
  return modulo(a + b - c);
}

/// What the prediction left over, in the order of the plane.
std::vector<std::uint16_t> residuals(std::span<const std::uint16_t> plane, const PixelMask& mask,
                                     std::span<const int> places) {
  std::vector<std::uint16_t> out;
  out.reserve(plane.size());
  const auto width = static_cast<std::size_t>(mask.width);
  const auto at = [&](int place) { return plane[static_cast<std::size_t>(place)]; };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] < 0) continue;
    const bool first = i % width == 0, top = i < width;
    const int left = first ? -1 : places[i - 1];
    const int up = top ? -1 : places[i - width];
    const int upLeft = first || top ? -1 : places[i - width - 1];
    const std::uint16_t predicted = left >= 0 && up >= 0 && upLeft >= 0 ? medianPrediction(at(left), at(up), at(upLeft))
                                    : left >= 0                         ? at(left)
                                    : up >= 0                           ? at(up)
                                                                        : std::uint16_t{0};
    out.push_back(zigzag(modulo(at(places[i]) - predicted)));
  }
  return out;
}

}  // namespace

std::size_t PixelMask::count() const { return static_cast<std::size_t>(std::ranges::count(covered, true)); }

float roundedToHalf(float v, float scale) { return static_cast<float>(half(v / scale)) * scale; }

float halfScale(float largest) {
  // From a sixteenth on, numbers down to a thousandth of the largest have all eleven binary digits.
  constexpr float kLeast = 1.0f / 16;
  if (!(largest > 0) || !std::isfinite(largest) || (largest >= kLeast && largest <= kLargestHalf)) return 1;
  constexpr int kUsual = 10;  // brings the largest near 1000
  return std::ldexp(1.0f, std::ilogb(largest) - kUsual);
}

HalfPlanes halfPlanes(const Image& image, const PixelMask& mask, float scale, int dropped) {
  assert(mask.covered.size() == image.pixelCount());
  const int rounding = dropped > 0 ? 1 << (dropped - 1) : 0;
  const int most = half(kLargestHalf).bits() >> dropped;
  HalfPlanes planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c].reserve(mask.count());
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
      if (!mask.covered[i]) continue;
      const int bits = half(image.rgb[3 * i + c] / scale).bits();
      planes[c].push_back(dropped > 0 ? modulo(std::min((bits + rounding) >> dropped, most)) : modulo(bits));
    }
  }
  return planes;
}

std::vector<std::uint8_t> packPlanes(const HalfPlanes& planes, const PixelMask& mask, const HalfPlanes* base) {
  constexpr std::size_t kRed = 0, kGreen = 1, kBlue = 2;
  const std::size_t count = planes[kGreen].size();
  assert(count == mask.count() && planes[kRed].size() == count && planes[kBlue].size() == count);
  HalfPlanes coded = planes;
  if (base)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i) coded[c][i] = modulo(planes[c][i] - (*base)[c][i]);
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t c : {kRed, kBlue}) coded[c][i] = modulo(coded[c][i] - coded[kGreen][i]);

  const std::vector<int> places = placesOf(mask);
  std::vector<std::uint8_t> bytes(6 * count);
  std::size_t at = 0;
  for (const std::size_t c : {kGreen, kRed, kBlue}) {
    for (const std::uint16_t v : residuals(coded[c], mask, places)) {
      bytes[at] = static_cast<std::uint8_t>(v >> 8);
      bytes[3 * count + at++] = static_cast<std::uint8_t>(v & 0xFF);
    }
  }
  return deflated(bytes);
}

}  // namespace rigel::tools
