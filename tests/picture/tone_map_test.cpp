#include "picture/tone_map.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(SoftShoulder, IsIdentityThenRisesSmoothlyTowardsOne) {
  EXPECT_EQ(softShoulder(0.3f), 0.3f);
  EXPECT_EQ(softShoulder(0.7f), 0.7f);
  constexpr float kStep = 1e-3f;
  float last = 0, lastSlope = 1;
  for (float x = kStep; x < 4; x += kStep) {
    const float y = softShoulder(x), slope = (y - last) / kStep;
    EXPECT_GE(slope, 0);
    EXPECT_LT(std::abs(slope - lastSlope), 0.01f) << "a kink at " << x;
    EXPECT_LT(y, 1);
    last = y;
    lastSlope = slope;
  }
  EXPECT_LE(softShoulder(kInfinity), 1);
  EXPECT_EQ(softShoulder(-1), 0);
  EXPECT_EQ(softShoulder(kNan), 0);
}

TEST(EncodeSrgb, MatchesTheStandard) {
  EXPECT_EQ(encodeSrgb(0), 0);
  EXPECT_EQ(encodeSrgb(1), 255);
  EXPECT_EQ(encodeSrgb(2), 255);
  EXPECT_EQ(encodeSrgb(0.0031308f), 10);   // 12.92 x 0.0031308 = 0.04045
  EXPECT_EQ(encodeSrgb(0.2158605f), 128);  // 128/255 = 0.50196: ((0.50196 + 0.055)/1.055)^2.4
  EXPECT_EQ(encodeSrgb(0.18f), 118);       // a grey card
}

TEST(AutoExposure, ShowsThe99thPercentileAtEightTenths) {
  std::vector<Rgb> radiance;
  for (int i = 1; i <= 1001; ++i) radiance.push_back({0.1f, static_cast<float>(i), 0});
  EXPECT_NEAR(autoExposure(radiance) * 991, 0.8f, 1e-5f);
  radiance.push_back({kNan, kInfinity, 0});
  EXPECT_NEAR(autoExposure(radiance) * 991, 0.8f, 2e-3f) << "what is not finite does not count";
  EXPECT_EQ(autoExposure(std::span<const Rgb>{}), 1);
  EXPECT_EQ(autoExposure(std::vector<Rgb>(5)), 1);
}

TEST(AutoExposure, OfASurfaceSeesTheObjectAlone) {
  VisibleSurface surface{2, 1, {}};
  VisibleSample sample;
  surface.samples.push_back(sample);
  sample.kind = SampleKind::light;
  surface.samples.push_back(sample);
  EXPECT_FLOAT_EQ(autoExposure(surface, std::vector<Rgb>{{2, 2, 2}, {900, 900, 900}}), 0.4f);
}

TEST(ToneMap, BlendsOverTheBackdrop) {
  Image image(3, 1);
  image.rgb = {0.5f, 0.5f, 0.5f, 0, 0, 0, 0.25f, 0.25f, 0.25f};
  image.coverage = {1, 0, 0.5f};
  const Image8 shown = toneMap(image, 1, {0.2f, 0.2f, 0.2f});
  EXPECT_EQ(shown.at(0, 0).r, encodeSrgb(0.5f));
  EXPECT_EQ(shown.at(1, 0).r, encodeSrgb(0.2f));
  EXPECT_EQ(shown.at(2, 0).r, encodeSrgb(0.35f));
  EXPECT_EQ(toneMap(image, 0.5f).at(0, 0).r, encodeSrgb(0.25f));
}

}  // namespace
}  // namespace rigel::tools
