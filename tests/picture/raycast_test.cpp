#include "picture/raycast.h"

#include "shapes.h"

#include <rigel/sh.h>

#include <gmock/gmock.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>

namespace rigel::tools {
namespace {

using test::lookDownZ;
using test::makeSquare;
using test::Shape;

constexpr float kHit = 2e-6f;  // m, of a hit point at 2 m in float

const VisibleSample* at(const VisibleSurface& surface, int x, int y) {
  for (const VisibleSample& s : surface.samples) {
    if (s.pixel == static_cast<std::uint32_t>(y * surface.width + x)) return &s;
  }
  return nullptr;
}

TEST(RayCaster, HitsAPlaneWhereGeometrySays) {
  const Shape square = makeSquare(1, 0);
  RayCaster caster;
  caster.add(square.object, square.posed);
  const Camera camera = lookDownZ(64, 64, 2);  // the square fills the middle half
  const VisibleSurface surface = caster.cast(camera, 1);
  ASSERT_EQ(surface.samples.size(), 32u * 32u);
  float worst = 0;
  for (const VisibleSample& s : surface.samples) {
    const float x = static_cast<float>(s.pixel % 64) + 0.5f, y = static_cast<float>(s.pixel / 64) + 0.5f;
    const glm::vec3 expected{(x - 32) / 16, (32 - y) / 16, 0};
    worst = std::max(worst, glm::distance(expected, glm::vec3(s.position.x, s.position.y, s.position.z)));
    // Barycentrics rebuild the position.
    const glm::uvec3 t = square.object.triangles[s.triangle];
    const auto& p = square.posed.positions;
    const glm::vec3 rebuilt = (1 - s.b1 - s.b2) * p[t.x] + s.b1 * p[t.y] + s.b2 * p[t.z];
    worst = std::max(worst, glm::distance(expected, rebuilt));
    // Which triangle: the square is cut along the diagonal x = y.
    if (std::abs(expected.x - expected.y) > 0.01f) {
      EXPECT_EQ(s.triangle, expected.x > expected.y ? 0u : 1u);
    }
    EXPECT_EQ(s.kind, SampleKind::object);
    EXPECT_EQ(s.weight, 1);
  }
  EXPECT_LE(worst, kHit);
}

TEST(RayCaster, HitsASphereLightWhereGeometrySays) {
  RayCaster caster;
  caster.addLight({{0, 0, 0}, 1, {1, 2, 3}, {}});
  const Camera camera = lookDownZ(101, 101, 3);
  const VisibleSurface surface = caster.cast(camera, 1);
  ASSERT_FALSE(surface.samples.empty());
  float worst = 0;
  for (const VisibleSample& s : surface.samples) {
    worst = std::max(worst, std::abs(length(s.position) - 1));
    worst = std::max(worst, length(s.normal - s.position));
    EXPECT_EQ(s.kind, SampleKind::light);
    EXPECT_EQ(s.emission, (Rgb{1, 2, 3}));
  }
  EXPECT_LE(worst, 2e-4f) << "near the outline a ray meets the sphere at a grazing angle";
  ASSERT_NE(at(surface, 50, 50), nullptr);
  EXPECT_NEAR(at(surface, 50, 50)->position.z, 1, 1e-5f);
}

TEST(RayCaster, HitsADiskLightWhichIsBlackFromBehind) {
  // Tilted by 60 degrees about x: half as high as wide.
  const float c = 0.5f, s = std::sqrt(0.75f);
  for (const float side : {1.0f, -1.0f}) {
    for (const bool twoSided : {false, true}) {
      RayCaster caster;
      caster.addLight({{0, 0, 0}, 1, {1, 2, 3}, {0, side * s, side * c}, twoSided});
      const VisibleSurface surface = caster.cast(lookDownZ(101, 101, 3), 1);
      ASSERT_FALSE(surface.samples.empty());
      float worst = 0, widest = 0, highest = 0;
      for (const VisibleSample& sample : surface.samples) {
        const Vec3 p = sample.position;
        worst = std::max(worst, std::abs(p.y * s + p.z * c));
        widest = std::max(widest, std::abs(p.x));
        highest = std::max(highest, std::abs(p.y));
        EXPECT_EQ(sample.kind, SampleKind::light);
        EXPECT_EQ(sample.emission, (side > 0 || twoSided ? Rgb{1, 2, 3} : Rgb{}));
      }
      EXPECT_LE(worst, 1e-5f) << "in the plane of the disk";
      constexpr float kPixel = 0.03f;
      EXPECT_NEAR(widest, 1, kPixel);
      EXPECT_NEAR(highest, 0.5, kPixel);
    }
  }
}

TEST(RayCaster, NormalsAreInterpolatedOrTheTrianglesOwn) {
  const glm::vec3 tilted = glm::normalize(glm::vec3(0.5f, 0, 1));
  for (const bool isFlat : {false, true}) {
    Shape square = makeSquare(1, 0, isFlat ? glm::vec3(0) : tilted);
    RayCaster caster;
    caster.add(square.object, square.posed);
    const VisibleSurface surface = caster.cast(lookDownZ(16, 16, 2), 1);
    ASSERT_FALSE(surface.samples.empty());
    const glm::vec3 expected = isFlat ? glm::vec3(0, 0, 1) : tilted;
    for (const VisibleSample& s : surface.samples) {
      EXPECT_LT(glm::distance(expected, glm::vec3(s.normal.x, s.normal.y, s.normal.z)), 1e-6f);
    }
  }
}

TEST(RayCaster, BackFacesKeepTheMeshsNormal) {
  Shape square = makeSquare(1, 0, {0, 0, -1});
  for (glm::uvec3& t : square.object.triangles) std::swap(t.y, t.z);
  RayCaster caster;
  caster.add(square.object, square.posed);
  const VisibleSurface surface = caster.cast(lookDownZ(8, 8, 2), 1);
  ASSERT_FALSE(surface.samples.empty());
  for (const VisibleSample& s : surface.samples) EXPECT_EQ(s.normal.z, -1);
}

TEST(RayCaster, NearestSurfaceWinsAndPartsAreCountedPerKind) {
  const Shape behind = makeSquare(1, 0, {0, 0, 1}, {0.1f, 0.2f, 0.3f});
  Shape front = makeSquare(0.25f, 0.5f, {0, 0, 1}, {0.7f, 0.8f, 0.9f});
  front.object.triangleWrap.assign(2, 0.25f);
  RayCaster caster;
  caster.add(behind.object, behind.posed, SampleKind::scenery);
  caster.add(front.object, front.posed);
  caster.addLight({{0.8f, 0.8f, 0.2f}, 0.1f, {1, 1, 1}, {}});
  const VisibleSurface surface = caster.cast(lookDownZ(64, 64, 2), 1);
  const VisibleSample* middle = at(surface, 32, 32);
  ASSERT_NE(middle, nullptr);
  EXPECT_EQ(middle->kind, SampleKind::object);
  EXPECT_EQ(middle->part, 1u);
  EXPECT_EQ(middle->baseColour, (Rgb{0.7f, 0.8f, 0.9f}));
  EXPECT_EQ(middle->wrap, 0.25f);
  const VisibleSample* corner = at(surface, 18, 46);
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->kind, SampleKind::scenery);
  EXPECT_EQ(corner->part, 0u);
  const Camera camera = lookDownZ(64, 64, 2);
  const glm::vec2 ball = camera.project({0.8f, 0.8f, 0.2f});
  const VisibleSample* light = at(surface, static_cast<int>(ball.x), static_cast<int>(ball.y));
  ASSERT_NE(light, nullptr);
  EXPECT_EQ(light->kind, SampleKind::light);
}

TEST(RayCaster, SupersamplingMeasuresTheDisc) {
  // The outline of a unit ball seen from 3 m: a disc of tan(asin(1/3)) at distance 1.
  const Camera camera = lookDownZ(200, 200, 3);
  const double radius = 100 * std::tan(std::asin(1.0 / 3));
  const double area = kPi * radius * radius;
  RayCaster caster;
  caster.addLight({{0, 0, 0}, 1, {1, 1, 1}, {}});
  double error[2];
  for (const int perSide : {1, 4}) {
    const VisibleSurface surface = caster.cast(camera, perSide);
    double sum = 0;
    for (const VisibleSample& s : surface.samples) sum += static_cast<double>(s.weight);
    error[perSide > 1] = std::abs(sum - area) / area;
    if (perSide > 1) {
      EXPECT_LT(surface.samples.size(), 2.2 * area) << "only the outline asks for more samples";
    }
  }
  constexpr double kOutline = 1e-3;  // worst seen: 3e-4 at 4 x 4
  EXPECT_LT(error[1], kOutline);
  EXPECT_LT(error[0], 1e-2);
}

TEST(RayCaster, SamplesAreOrderedAndNoPixelIsMoreThanCovered) {
  const Shape square = makeSquare(0.77f, 0.1f);
  RayCaster caster;
  caster.add(square.object, square.posed);
  caster.addLight({{0.5f, 0.5f, 0.6f}, 0.2f, {1, 1, 1}, {}});
  const VisibleSurface surface = caster.cast(lookDownZ(90, 70, 2), 3);
  ASSERT_GT(surface.samples.size(), 1000u);
  std::map<std::uint32_t, float> coverage;
  std::uint32_t last = 0;
  for (const VisibleSample& s : surface.samples) {
    EXPECT_GE(s.pixel, last);
    last = s.pixel;
    coverage[s.pixel] += s.weight;
  }
  bool hasPartial = false;
  for (const auto& [pixel, sum] : coverage) {
    EXPECT_LE(sum, 1 + 1e-6f);
    hasPartial = hasPartial || sum < 0.99f;
  }
  EXPECT_TRUE(hasPartial);
}

TEST(RayCaster, EmptySceneShowsNothing) {
  const RayCaster caster;
  EXPECT_TRUE(caster.cast(lookDownZ(8, 8, 2)).samples.empty());
}

TEST(Resolve, AveragesByWeightAndKeepsCoverage) {
  VisibleSurface surface{2, 1, {}};
  VisibleSample sample;
  sample.weight = 0.25f;
  for (int i = 0; i < 3; ++i) surface.samples.push_back(sample);
  const std::vector<Rgb> colours{{4, 0, 0}, {0, 4, 0}, {0, 0, 8}};
  const Image image = resolve(surface, colours);
  EXPECT_EQ(image.pixel(0), (Rgb{1, 1, 2}));
  EXPECT_EQ(image.coverage[0], 0.75f);
  EXPECT_EQ(image.coverage[1], 0);
}

TEST(AddLights, ShowsEveryPlacedLightWithItsColour) {
  LightSet lights;
  lights.add(DirectionalLight{{0, -1, 0}, {1, 1, 1}});
  lights.add(PointLight{{-0.6f, 0, 0}, {2, 1, 0}});
  SpotLight spot;
  spot.position = {0, 0, 0};
  spot.intensity = {0, 3, 0};
  lights.add(spot);
  lights.add(SphereLight{{0.6f, 0, 0}, 0.2f, {0, 0, 5}});
  lights.add(DiskLight{{0, 0.6f, 0}, {0, 0, 2}, 0.2f, {3, 0, 3}, false});    // faces the camera
  lights.add(DiskLight{{0, -0.6f, 0}, {0, 0, -2}, 0.2f, {3, 0, 3}, false});  // its back
  RayCaster caster;
  addLights(caster, lights, 0.1f, 2);
  const VisibleSurface surface = caster.cast(lookDownZ(63, 63, 1), 1);
  std::map<std::uint32_t, Rgb> seen;
  for (const VisibleSample& s : surface.samples) seen[s.part] = s.emission;
  ASSERT_EQ(seen.size(), 5u) << "a directional light has no place";
  EXPECT_EQ(seen[0], (Rgb{2, 1, 0}));
  EXPECT_EQ(seen[1], (Rgb{0, 2, 0}));
  EXPECT_EQ(seen[2], (Rgb{0, 0, 2}));
  EXPECT_EQ(seen[3], (Rgb{2, 0, 2}));
  EXPECT_EQ(seen[4], Rgb{});
}

}  // namespace
}  // namespace rigel::tools
