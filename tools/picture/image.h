// Pictures in memory: linear float, and 8-bit sRGB as PNG holds it.
#pragma once

#include <rigel/vec3.h>

#include <cstdint>
#include <vector>

namespace rigel::tools {

/// Linear Rec.709 RGB, rows from the top, three floats a pixel. `coverage` in [0, 1] is the share of a pixel that shows
/// something; colours are premultiplied by it.
struct Image {
  int width = 0, height = 0;
  std::vector<float> rgb;
  std::vector<float> coverage;

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgb(3 * pixelCount(), 0.0f), coverage(pixelCount(), 0.0f) {}

  std::size_t pixelCount() const noexcept { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  Rgb pixel(std::size_t i) const noexcept { return {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]}; }
};

/// A colour as PNG stores it.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(Rgb8, Rgb8) = default;
};

/// 8-bit sRGB, opaque, rows from the top.
struct Image8 {
  int width = 0, height = 0;
  std::vector<Rgb8> pixels;

  Image8() = default;
  Image8(int w, int h, Rgb8 fill = {})
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

  Rgb8& at(int x, int y) noexcept { return pixels[static_cast<std::size_t>(y * width + x)]; }
  const Rgb8& at(int x, int y) const noexcept { return pixels[static_cast<std::size_t>(y * width + x)]; }
};

}  // namespace rigel::tools
