#include "picture/shade_exact.h"

#include "parallel/parallel.h"
#include "shapes.h"

#include <rigel/exact.h>
#include <rigel/sh.h>

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>

namespace rigel::tools {
namespace {

TEST(ExactIrradiance, IsTheLibrarysAtEverySample) {
  LightSet lights;
  lights.add(DirectionalLight{{0, 0, -1}, {0.1f, 0.2f, 0.3f}});
  lights.add(SphereLight{{0.3f, 0.2f, 0.5f}, 0.2f, {1, 2, 3}});
  test::Shape square = test::makeSquare(1, 0);
  square.object.triangleWrap[1] = 0.5f;
  RayCaster caster;
  caster.add(square.object, square.posed);
  caster.addLight({{0.3f, 0.2f, 0.5f}, 0.2f, {1, 1, 1}, {}});
  const VisibleSurface surface = caster.cast(test::lookDownZ(64, 64, 2), 2);
  ASSERT_GT(surface.samples.size(), 1024u) << "more than one block of the parallel loop";
  const std::vector<Rgb> irradiance = exactIrradiance(surface, lights);
  int lightSamples = 0;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const VisibleSample& s = surface.samples[i];
    if (s.kind == SampleKind::light) {
      EXPECT_EQ(irradiance[i], Rgb{});
      ++lightSamples;
      continue;
    }
    const RgbD e = rigel::exactIrradiance(lights, s.position, s.normal, s.wrap);
    EXPECT_EQ(irradiance[i].g, static_cast<float>(e.g));
  }
  EXPECT_GT(lightSamples, 0);
}

TEST(Shade, IsLambertDimmedForSceneryAndScaledForLights) {
  VisibleSurface surface{3, 1, {}};
  VisibleSample sample;
  sample.baseColour = {0.5f, 0.25f, 1};
  sample.emission = {1, 2, 3};
  for (const SampleKind kind : {SampleKind::object, SampleKind::scenery, SampleKind::light}) {
    sample.kind = kind;
    surface.samples.push_back(sample);
  }
  const float e = 2 * static_cast<float>(kPi);
  const std::vector<Rgb> irradiance(3, Rgb{e, e, e});
  const std::vector<Rgb> radiance = shade(surface, irradiance, 10);
  EXPECT_FLOAT_EQ(radiance[0].r, 1);
  EXPECT_FLOAT_EQ(radiance[0].g, 0.5f);
  EXPECT_FLOAT_EQ(radiance[0].b, 2);
  EXPECT_FLOAT_EQ(radiance[1].b, 2 * kSceneryDimming);
  EXPECT_EQ(radiance[2], (Rgb{10, 20, 30}));
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int count : {0, 1, 2, 1000}) {
    std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
    parallelFor(count, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
    for (const auto& v : visits) EXPECT_EQ(v.load(), 1);
  }
}

}  // namespace
}  // namespace rigel::tools
