// The colours are a path in Oklab (B. Ottosson, "A perceptual color space for image processing", 2020): lightness rises
// linearly, hue turns from violet over red to yellow, chroma is as large as sRGB allows up to a limit.
#include "picture/heat_map.h"

#include "picture/bitmap_font.h"
#include "picture/tone_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>

namespace rigel::tools {
namespace {

constexpr Rgb8 kNeutral{112, 112, 112}, kPanel{38, 38, 40}, kInk{235, 235, 235};

struct LinearColour {
  double r, g, b;
  bool isInGamut() const { return std::min({r, g, b}) >= 0 && std::max({r, g, b}) <= 1; }
};

LinearColour fromOklab(double lightness, double a, double b) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Rgb8 pathColour(double t) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const double lightness = 0.14 + 0.83 * t;
  const double hue = (-70 + 178 * std::pow(t, 0.85)) * kDegree;
  // Shrink the chroma until the colour can be shown: bisection, the grey axis is always inside.
  double low = 0, high = 0.2;
  for (int i = 0; i < 30; ++i) {
    const double chroma = 0.5 * (low + high);
    const bool fits = fromOklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue)).isInGamut();
    (fits ? low : high) = chroma;
  }
  const LinearColour c = fromOklab(lightness, low * std::cos(hue), low * std::sin(hue));
  return {encodeSrgb(static_cast<float>(c.r)), encodeSrgb(static_cast<float>(c.g)),
          encodeSrgb(static_cast<float>(c.b))};
}

void fill(Image8& image, int x0, int y0, int x1, int y1, Rgb8 colour) {
  for (int y = std::max(y0, 0); y < std::min(y1, image.height); ++y)
    for (int x = std::max(x0, 0); x < std::min(x1, image.width); ++x) image.at(x, y) = colour;
}

std::string percent(const char* prefix, float value) {
  return fmt::format("{}{:.3g}%", prefix, 100 * static_cast<double>(value));
}

/// Panel, bar, five ticks, labels at the ends and in the middle.
void drawScale(Image8& image, float maxError) {
  const int scale = std::max(1, image.height / 240);
  const int pad = 5 * scale, barHeight = 7 * scale, tick = 2 * scale;
  const int width = std::min(image.width - 4 * pad, 120 * scale);
  const int left = 2 * pad, bottom = image.height - 2 * pad;
  const int textTop = bottom - kGlyphHeight * scale, barTop = textTop - 2 * tick - barHeight;
  fill(image, left - pad, barTop - pad, left + width + pad, bottom + pad, kPanel);
  for (int x = 0; x < width; ++x) {
    const Rgb8 colour = heatColour(static_cast<float>(x) / static_cast<float>(width - 1));
    fill(image, left + x, barTop, left + x + 1, barTop + barHeight, colour);
  }
  for (int i = 0; i <= 4; ++i) {
    const int x = left + (width - scale) * i / 4;
    fill(image, x, barTop + barHeight, x + scale, barTop + barHeight + tick, kInk);
  }
  const std::string middle = percent("", maxError / 2), top = percent(">", maxError);
  drawText(image, left, textTop, "0", scale, kInk);
  drawText(image, left + (width - textWidth(middle, scale)) / 2, textTop, middle, scale, kInk);
  drawText(image, left + width - textWidth(top, scale), textTop, top, scale, kInk);
}

}  // namespace

Rgb8 heatColour(float t) {
  constexpr int kSteps = 512;
  static const std::array<Rgb8, kSteps + 1> kTable = [] {
    std::array<Rgb8, kSteps + 1> table{};
    for (int i = 0; i <= kSteps; ++i) table[static_cast<std::size_t>(i)] = pathColour(static_cast<double>(i) / kSteps);
    return table;
  }();
  const float clamped = t < 1 ? std::max(t, 0.0f) : 1.0f;  // a NaN is not below 1
  return kTable[static_cast<std::size_t>(std::lround(clamped * kSteps))];
}

Image8 heatMap(const VisibleSurface& surface, std::span<const float> error, float maxError) {
  assert(error.size() == surface.samples.size());
  assert(maxError > 0);
  Image8 out(surface.width, surface.height, kNeutral);
  // Colours are averaged over a pixel, not errors: an edge pixel then fades into the grey.
  for (std::size_t s = 0; s < error.size();) {
    const std::uint32_t pixel = surface.samples[s].pixel;
    float r = 0, g = 0, b = 0, covered = 0;
    for (; s < error.size() && surface.samples[s].pixel == pixel; ++s) {
      const VisibleSample& sample = surface.samples[s];
      if (sample.kind != SampleKind::object) continue;
      const Rgb8 colour = heatColour(error[s] / maxError);
      r += sample.weight * colour.r;
      g += sample.weight * colour.g;
      b += sample.weight * colour.b;
      covered += sample.weight;
    }
    const float grey = std::max(0.0f, 1 - covered);
    const auto byte = [](float v) { return static_cast<std::uint8_t>(std::clamp(std::lround(v), 0l, 255l)); };
    out.pixels[pixel] = {byte(r + grey * kNeutral.r), byte(g + grey * kNeutral.g), byte(b + grey * kNeutral.b)};
  }
  drawScale(out, maxError);
  return out;
}

float heatScale(const VisibleSurface& surface, std::span<const float> error) {
  constexpr double kShare = 0.9;
  assert(error.size() == surface.samples.size());
  std::vector<float> onObject;
  for (std::size_t s = 0; s < error.size(); ++s) {
    if (surface.samples[s].kind == SampleKind::object && std::isfinite(error[s])) onObject.push_back(error[s]);
  }
  if (onObject.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(kShare * static_cast<double>(onObject.size() - 1)));
  std::nth_element(onObject.begin(), onObject.begin() + rank, onObject.end());
  const float needed = onObject[static_cast<std::size_t>(rank)];
  if (!(needed > 0)) return 0.01f;
  const double decade = std::pow(10.0, std::floor(std::log10(static_cast<double>(needed))));
  for (const double step : {1.0, 2.0, 5.0}) {
    const auto top = static_cast<float>(step * decade);
    if (needed <= top) return top;
  }
  return static_cast<float>(10 * decade);
}

}  // namespace rigel::tools
