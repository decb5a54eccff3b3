#include "report/pictures/pixel_packing.h"

#include "unpacked_pixels.h"

#include <cmath>
#include <limits>
#include <random>

namespace rigel::tests {
namespace {

using tools::HalfPlanes;
using tools::PixelMask;

PixelMask randomMask(int width, int height, double share, std::mt19937& random) {
  PixelMask mask{width, height, {}};
  std::bernoulli_distribution covered(share);
  for (int i = 0; i < width * height; ++i) mask.covered.push_back(covered(random));
  return mask;
}

HalfPlanes randomPlanes(std::size_t count, int largest, std::mt19937& random) {
  std::uniform_int_distribution<int> bits(0, largest);
  HalfPlanes planes;
  for (auto& plane : planes)
    for (std::size_t i = 0; i < count; ++i) plane.push_back(static_cast<std::uint16_t>(bits(random)));
  return planes;
}

TEST(PixelPacking, EveryBitSurvives) {
  std::mt19937 random(7);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 19}, {23, 1}, {31, 17}}) {
    for (const double share : {0.0, 0.2, 0.9, 1.0}) {
      for (const int largest : {0, 40, 0x7BFF, 0xFFFF}) {  // NaN, infinity and negative numbers too
        const PixelMask mask = randomMask(width, height, share, random);
        const HalfPlanes base = randomPlanes(mask.count(), largest, random);
        const HalfPlanes planes = randomPlanes(mask.count(), largest, random);
        EXPECT_EQ(unpackPlanes(tools::packPlanes(planes, mask), mask), planes) << width << " " << share;
        EXPECT_EQ(unpackPlanes(tools::packPlanes(planes, mask, &base), mask, &base), planes) << width << " " << share;
      }
    }
  }
}

TEST(PixelPacking, SmoothPicturesBecomeSmall) {
  constexpr int kSide = 64;
  tools::Image image(kSide, kSide);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const double x = static_cast<double>(i / 3 % kSide) / kSide, y = static_cast<double>(i / 3 / kSide) / kSide;
    image.rgb[i] = static_cast<float>(1 + 0.5 * std::sin(3 * x) * std::cos(2 * y));
  }
  const PixelMask mask{kSide, kSide, std::vector<bool>(image.pixelCount(), true)};
  const std::size_t packed = tools::packPlanes(tools::halfPlanes(image, mask, 1), mask).size();
  EXPECT_LT(packed, image.pixelCount() * 6 / 6) << "a byte a pixel, of six";
}

TEST(HalfFloats, RoundToTheNearest) {
  EXPECT_EQ(tools::roundedToHalf(0), 0);
  EXPECT_EQ(tools::roundedToHalf(1 + 0x1p-11f), 1) << "ties go to even digits";
  EXPECT_EQ(tools::roundedToHalf(1 + 3 * 0x1p-11f), 1 + 0x1p-9f);
  EXPECT_EQ(tools::roundedToHalf(65504), 65504);
  EXPECT_TRUE(std::isinf(tools::roundedToHalf(70000)));
  EXPECT_TRUE(std::isnan(tools::roundedToHalf(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_EQ(tools::roundedToHalf(70000, 256), 256 * tools::roundedToHalf(70000.0f / 256));
}

TEST(HalfFloats, ScaleKeepsTheDigitsOfAnyBrightness) {
  for (const float usual : {0.07f, 1.0f, 300.0f, 65504.0f}) EXPECT_EQ(tools::halfScale(usual), 1) << usual;
  EXPECT_EQ(tools::halfScale(0), 1);
  EXPECT_EQ(tools::halfScale(std::numeric_limits<float>::infinity()), 1);
  constexpr float kHalfStep = 0x1p-11f;
  for (float largest = 1e-30f; largest < 1e30f; largest *= 7.3f) {
    const float scale = tools::halfScale(largest);
    int exponent = 0;
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5f) << "a power of two";
    for (const float share : {1.0f, 0.37f, 0.0011f})
      EXPECT_NEAR(tools::roundedToHalf(share * largest, scale), share * largest, kHalfStep * share * largest);
  }
}

TEST(HalfFloats, FewerDigitsStayNear) {
  tools::Image image(64, 1);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = 0.01f * std::pow(1.08f, static_cast<float>(i));
  image.rgb.back() = 65504;
  const PixelMask mask{64, 1, std::vector<bool>(64, true)};
  const HalfPlanes exact = tools::halfPlanes(image, mask, 1), rough = tools::halfPlanes(image, mask, 1, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < 64; ++i) {
      const int back = rough[c][i] << 3;
      EXPECT_LE(std::abs(back - exact[c][i]), c == 2 && i == 63 ? 7 : 4);
      EXPECT_LT(back, 0x7C00) << "not infinite";
    }
  }
}

}  // namespace
}  // namespace rigel::tests
