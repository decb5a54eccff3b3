#include "picture/tone_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel::tools {

float autoExposure(std::span<const Rgb> radiance) {
  constexpr double kPercentile = 0.99;
  constexpr float kShownAt = 0.8f;
  std::vector<float> brightest;
  brightest.reserve(radiance.size());
  for (const Rgb c : radiance) {
    const float v = std::max({c.r, c.g, c.b});
    if (std::isfinite(v)) brightest.push_back(v);
  }
  if (brightest.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(kPercentile * static_cast<double>(brightest.size() - 1));
  std::nth_element(brightest.begin(), brightest.begin() + rank, brightest.end());
  const float white = brightest[static_cast<std::size_t>(rank)];
  return white > 0 ? kShownAt / white : 1.0f;
}

float autoExposure(const VisibleSurface& surface, std::span<const Rgb> radiance) {
  assert(radiance.size() == surface.samples.size());
  std::vector<Rgb> onObject;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    if (surface.samples[i].kind == SampleKind::object) onObject.push_back(radiance[i]);
  }
  return autoExposure(onObject);
}

float softShoulder(float x) {
  constexpr float kKnee = 0.7f, kRoom = 1 - kKnee;
  if (!(x > 0)) return 0;
  return x <= kKnee ? x : kKnee + kRoom * (1 - std::exp(-(x - kKnee) / kRoom));
}

std::uint8_t encodeSrgb(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  const float s = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

Image8 toneMap(const Image& image, float exposure, Rgb backdrop) {
  Image8 out(image.width, image.height);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const Rgb c = image.pixel(i);
    const float free = 1 - image.coverage[i];
    const auto shown = [&](float radiance, float behind) {
      return encodeSrgb(softShoulder(radiance * exposure) + free * behind);
    };
    out.pixels[i] = {shown(c.r, backdrop.r), shown(c.g, backdrop.g), shown(c.b, backdrop.b)};
  }
  return out;
}

}  // namespace rigel::tools
