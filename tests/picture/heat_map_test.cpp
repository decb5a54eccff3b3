#include "picture/heat_map.h"

#include "picture/bitmap_font.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

/// CIE lightness L* of an sRGB colour, 0 to 100.
double lightness(Rgb8 c) {
  const auto linear = [](std::uint8_t v) {
    const double s = v / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(HeatColour, LightnessRisesEvenlyFromDarkToLight) {
  EXPECT_LT(lightness(heatColour(0)), 8);
  EXPECT_GT(lightness(heatColour(1)), 90);
  constexpr int kSteps = 64;
  double last = lightness(heatColour(0));
  const double mean = (lightness(heatColour(1)) - last) / kSteps;
  for (int i = 1; i <= kSteps; ++i) {
    const double here = lightness(heatColour(static_cast<float>(i) / kSteps));
    EXPECT_GT(here, last) << "step " << i;
    EXPECT_LT(here - last, 2.5 * mean) << "step " << i;
    last = here;
  }
}

TEST(HeatColour, ClampsAndShowsNanAsTheWorst) {
  EXPECT_EQ(heatColour(-1), heatColour(0));
  EXPECT_EQ(heatColour(7), heatColour(1));
  EXPECT_EQ(heatColour(std::numeric_limits<float>::quiet_NaN()), heatColour(1));
  EXPECT_EQ(heatColour(std::numeric_limits<float>::infinity()), heatColour(1));
}

/// A picture whose every pixel holds one sample; the left half scenery.
VisibleSurface halfAndHalf(int width, int height) {
  VisibleSurface surface{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    VisibleSample sample;
    sample.pixel = static_cast<std::uint32_t>(i);
    sample.kind = i % width < width / 2 ? SampleKind::scenery : SampleKind::object;
    surface.samples.push_back(sample);
  }
  return surface;
}

TEST(HeatMap, ColoursTheObjectAndGreysTheRest) {
  const VisibleSurface surface = halfAndHalf(320, 240);
  const std::vector<float> error(surface.samples.size(), 0.05f);
  const Image8 map = heatMap(surface, error, 0.1f);
  EXPECT_EQ(map.at(300, 20), heatColour(0.5f));
  const Rgb8 grey = map.at(10, 20);
  EXPECT_EQ(grey.r, grey.g);
  EXPECT_EQ(grey.g, grey.b);
}

TEST(HeatMap, DrawsItsScale) {
  const VisibleSurface surface = halfAndHalf(320, 240);
  const Image8 map = heatMap(surface, std::vector<float>(surface.samples.size(), 0.0f), 0.2f);
  // The bar runs through all colours in one row of the lower left corner.
  int row = -1;
  for (int y = 120; y < 240 && row < 0; ++y) {
    int found = 0;
    for (int x = 0; x < 160; ++x) found += map.at(x, y) == heatColour(1) || map.at(x, y) == heatColour(0);
    if (found >= 2) row = y;
  }
  ASSERT_GE(row, 0) << "no bar";
  // Its largest label, ">20%", is drawn somewhere below: compare with the text drawn alone.
  Image8 label(textWidth(">20%", 1), kGlyphHeight);
  drawText(label, 0, 0, ">20%", 1, {255, 255, 255});
  bool isFound = false;
  for (int y = row; y + kGlyphHeight <= 240 && !isFound; ++y) {
    for (int x = 0; x + label.width <= 160 && !isFound; ++x) {
      bool isSame = true;
      for (int v = 0; v < label.height && isSame; ++v)
        for (int u = 0; u < label.width && isSame; ++u)
          isSame = (label.at(u, v).r > 0) == (map.at(x + u, y + v).r > 200);
      isFound = isSame;
    }
  }
  EXPECT_TRUE(isFound);
}

TEST(HeatMap, TinyPicturesDoNotOverrun) {
  for (const int size : {1, 5, 20}) {
    const VisibleSurface surface = halfAndHalf(size, size);
    EXPECT_EQ(heatMap(surface, std::vector<float>(surface.samples.size(), 1.0f), 0.1f).pixels.size(),
              static_cast<std::size_t>(size * size));
  }
}

TEST(HeatScale, IsRoundAndHoldsNineTenthsOfTheObject) {
  const VisibleSurface surface = halfAndHalf(100, 100);
  std::vector<float> error(surface.samples.size(), 100.0f);  // scenery's does not count
  int n = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (surface.samples[i].kind == SampleKind::object) error[i] = 0.0001f * static_cast<float>(++n % 1000);
  }
  EXPECT_FLOAT_EQ(heatScale(surface, error), 0.1f);  // nine tenths lie below 0.09
  for (float& e : error) e *= 3;
  EXPECT_FLOAT_EQ(heatScale(surface, error), 0.5f);
  EXPECT_GT(heatScale(surface, std::vector<float>(error.size(), 0.0f)), 0);
  EXPECT_GT(heatScale(surface, std::vector<float>(error.size(), std::numeric_limits<float>::quiet_NaN())), 0);
}

TEST(BitmapFont, DrawsWithinThePictureAndScales) {
  Image8 small(12, 9), large(24, 18);
  drawText(small, 0, 0, "42", 1, {255, 255, 255});
  drawText(large, 0, 0, "42", 2, {255, 255, 255});
  int lit = 0;
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 24; ++x) {
      EXPECT_EQ(large.at(x, y), small.at(x / 2, y / 2));
      lit += large.at(x, y).r > 0;
    }
  EXPECT_GT(lit, 40);
  drawText(small, -3, -3, "0123456789.%-+> ?", 3, {1, 1, 1});  // over every border
  EXPECT_EQ(textWidth("", 2), 0);
  EXPECT_EQ(textWidth("10", 2), 22);
}

}  // namespace
}  // namespace rigel::tools
