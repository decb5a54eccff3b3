// What must hold of projections whatever the numbers: white furnace, linearity, continuity, symmetry, limits.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/project.h>
#include <rigel/wrap.h>

#include <limits>

#include "lights/describe.h"
#include "lights/random.h"
#include "lights/rotations.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Random;

constexpr double kRounding = 2e-6;  // a few float roundings, relative to the vector's norm
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double distance(const RadianceSH<5>& a, const RadianceSH<5>& b) {
  double error = 0, norm = 0;
  for (int i = 0; i < 25; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      error += std::pow(static_cast<double>(a[i][channel]) - b[i][channel], 2);
      norm += std::pow(static_cast<double>(b[i][channel]), 2);
    }
  }
  return norm > 0 ? std::sqrt(error / norm) : std::sqrt(error);
}

bool isZero(const RadianceSH<5>& sh) {
  for (const Rgb& c : sh.c) {
    if (!(c == Rgb{})) return false;
  }
  return true;
}

// At the centre of an enclosing sphere every normal sees radiance L everywhere: E = pi L f_0.
TEST(ProjectInvariants, WhiteFurnace) {
  const SphereLight light{{3, -2, 5}, 4, {1, 2, 3}};
  for (const float wrap : {-0.25f, 0.0f, 0.5f, 1.0f}) {
    const IrradianceSH<5> e = irradianceFromRadiance(project<5>(light, light.position), wrap);
    const double f0 = 2 * (1 + static_cast<double>(wrap)) / (2 + static_cast<double>(wrap));
    Random random(51);
    for (int k = 0; k < 20; ++k) {
      const Vec3 n = random.direction();
      const Rgb fromSh = evaluate(e, n);
      const RgbD exact = exactIrradiance(light, light.position, n, wrap);
      for (int channel = 0; channel < 3; ++channel) {
        const double expected = kPi * f0 * light.radiance[channel];
        EXPECT_NEAR(fromSh[channel], expected, kRounding * expected) << "wrap " << wrap << ", n " << describe(n);
        EXPECT_NEAR(exact[channel], expected, 1e-12 * expected) << "wrap " << wrap << ", n " << describe(n);
      }
    }
  }
}

// Band 1 is the vector irradiance, pi L s^2 towards the light at any distance, so that Lambert irradiance at a normal
// towards a light above the horizon is exact up to bands 2 and 4.
TEST(ProjectInvariants, Band1IsTheVectorIrradiance) {
  Random random(52);
  Worst worst("vector irradiance from band 1 against pi L (r/d)^2, relative");
  for (int k = 0; k < 1000; ++k) {
    const SphereLight light{random.pointInCube(10), random.uniformf(1e-3, 1), {1, 1, 1}};
    const double d = std::sqrt(std::pow(static_cast<double>(light.position.x), 2) +
                               std::pow(static_cast<double>(light.position.y), 2) +
                               std::pow(static_cast<double>(light.position.z), 2));
    if (d < static_cast<double>(light.radius)) continue;
    const RadianceSH<2> q = project<2>(light, {});
    const double magnitude = std::sqrt(4 * kPi / 3) * std::hypot(q[1].r, std::hypot(q[2].r, q[3].r));
    const double expected = kPi * std::pow(static_cast<double>(light.radius) / d, 2);
    worst.add(std::abs(magnitude / expected - 1),
              [&] { return describe(light) + ": " + describe(magnitude) + ", expected " + describe(expected); });
  }
  worst.expectWithin(kRounding);
}

TEST(ProjectInvariants, LinearInColour) {
  Random random(53);
  for (int k = 0; k < 200; ++k) {
    SphereLight light{random.pointInCube(3), random.uniformf(0.01, 3), random.colour()};
    const RadianceSH<5> once = project<5>(light, {});
    light.radiance = light.radiance * 4.0f;  // a power of two: exact
    const RadianceSH<5> four = project<5>(light, {});
    for (int i = 0; i < 25; ++i) EXPECT_EQ(four[i], once[i] * 4.0f) << describe(light) << ", coefficient " << i;
  }
}

TEST(ProjectInvariants, PointIsASphereOfItsRadiance) {
  Random random(54);
  Worst worst("point against the sphere of radiance I/(pi r^2), relative");
  for (int k = 0; k < 500; ++k) {
    const PointLight point{random.pointInCube(3), random.colour(), random.uniformf(0.01, 4)};
    const double radius = point.radius;
    const auto radiancePerIntensity = static_cast<float>(1 / (kPi * radius * radius));
    const SphereLight sphere{point.position, point.radius, point.intensity * radiancePerIntensity};
    worst.add(distance(project<5>(point, {}), project<5>(sphere, {})), [&] { return describe(point); });
  }
  worst.expectWithin(kRounding);
}

TEST(ProjectInvariants, TinyRadiiChangeNothing) {
  const Vec3 position{1, -2, 2};
  const RadianceSH<5> usual = project<5>(PointLight{position, {1, 1, 1}, 1e-4f}, {});
  for (const float radius : {0.0f, -1.0f, 1e-30f, 1e-6f}) {
    EXPECT_LT(distance(project<5>(PointLight{position, {1, 1, 1}, radius}, {}), usual), kRounding) << radius;
  }
  // Coincident with the light, a radius of 0 is one of kMinPointRadius: the white furnace of radiance I/(pi r^2).
  const double expected = 4 * kPi * 0.28209479177387814 / (kPi * std::pow(static_cast<double>(kMinPointRadius), 2));
  EXPECT_NEAR(project<5>(PointLight{position, {1, 1, 1}, 0}, position)[0].r, expected, kRounding * expected);
}

TEST(ProjectInvariants, ContinuousThroughTheSurface) {
  // A step of h radii to either side moves c by 2 sqrt(2h); the bands' slopes at c = 0 make 1.4 of it (the cone, where
  // it is steep, a little more).
  constexpr float kStep = 1e-6f;
  const double tolerance = 2 * 2 * std::sqrt(2 * static_cast<double>(kStep));
  Random random(55);
  for (int k = 0; k < 200; ++k) {
    const Vec3 w = random.direction();
    const SphereLight sphere{w, 1, {1, 1, 1}};
    const SpotLight spot{w, random.direction(), {1, 1, 1}, 0.5f, 3.0f, 1, 5};
    const RadianceSH<5> inSphere = project<5>(sphere, w * kStep), outSphere = project<5>(sphere, w * -kStep);
    const RadianceSH<5> inSpot = project<5>(spot, w * kStep), outSpot = project<5>(spot, w * -kStep);
    EXPECT_LT(distance(inSphere, outSphere), tolerance) << describe(sphere);
    EXPECT_LT(distance(inSpot, outSpot), tolerance) << describe(spot);
    for (const float wrap : {0.0f, 0.5f, 1.0f}) {
      const Vec3 n = random.direction();
      const double in = exactIrradiance(sphere, w * kStep, n, wrap).r;
      const double out = exactIrradiance(sphere, w * -kStep, n, wrap).r;
      EXPECT_NEAR(in, out, kPi * tolerance) << describe(sphere) << ", n " << describe(n) << ", wrap " << wrap;
    }
  }
}

TEST(ProjectInvariants, ContinuousThroughTheCentre) {
  Random random(56);
  for (int k = 0; k < 200; ++k) {
    const SpotLight spot{{}, random.direction(), {1, 1, 1}, 1.2f, 2.0f, 0.5f, 5};
    const Vec3 step = random.direction() * 1e-6f;
    EXPECT_LT(distance(project<5>(spot, step), project<5>(spot, -step)), 1e-4) << describe(spot);
    EXPECT_LT(distance(project<5>(spot, {}), project<5>(spot, -step)), 1e-4) << describe(spot);
  }
}

TEST(ProjectInvariants, WindowAndConeMeetZeroWithoutAKink) {
  // One millimetre inside the edge, value and slope have fallen with the square and the first power of the gap.
  const PointLight point{{}, {1, 1, 1}, 0.01f, 10};
  const ProjectionWithGradient<5> nearRange = projectWithGradient<5>(point, {9.999f, 0, 0});
  const double full = project<5>(PointLight{{}, {1, 1, 1}, 0.01f}, {9.999f, 0, 0})[0].r;
  EXPECT_NEAR(nearRange.value[0].r / full, 16e-8, 0.01 * 16e-8);           // (4 gap/R)^2
  EXPECT_NEAR(nearRange.gradient.d[0][0].r / full, -32e-5, 0.01 * 32e-5);  // 2 (4/R)^2 gap
  EXPECT_TRUE(isZero(project<5>(point, {10.001f, 0, 0})));

  const SpotLight spot{{0, 0, 0}, {0, -1, 0}, {1, 1, 1}, 0.2f, 0.5f};
  const auto at = [](double angle) {
    return Vec3{static_cast<float>(std::sin(angle)), static_cast<float>(-std::cos(angle)), 0};
  };
  const double lit = project<5>(spot, {0, -1, 0})[0].r;
  const double width = std::cos(0.2) - std::cos(0.5);
  const double t = std::sin(0.5) * 1e-3 / width;
  EXPECT_NEAR(project<5>(spot, at(0.499))[0].r / lit, 3 * t * t, 0.01 * 3 * t * t);
  EXPECT_TRUE(isZero(project<5>(spot, at(0.501))));
}

TEST(ProjectInvariants, EqualAnglesAreASteepEdgeNotAJump) {
  const SpotLight spot{{0, 0, 0}, {0, -1, 0}, {1, 1, 1}, 0.5f, 0.5f};
  const auto share = [&](double cosine) {
    const double sine = std::sqrt(1 - cosine * cosine);
    const Vec3 p{static_cast<float>(sine), static_cast<float>(-cosine), 0};
    return project<5>(spot, p)[0].r / project<5>(PointLight{{}, {1, 1, 1}}, p)[0].r;
  };
  const double edge = std::cos(0.5);
  const double width = kMinConeWidth;
  EXPECT_EQ(share(edge - 0.01 * width), 0);
  EXPECT_NEAR(share(edge + 0.5 * width), 0.5, 0.01);
  EXPECT_FLOAT_EQ(share(edge + 1.01 * width), 1);
}

TEST(ProjectInvariants, TurnsWithTheScene) {
  Random random(57);
  Worst worst("spot turned with its receiver against the turned projection, relative to the point's norm");
  for (int k = 0; k < 300; ++k) {
    const Rotation r = test::randomRotation(random);
    SpotLight spot{random.pointInCube(2), random.direction(), random.colour(), 0.3f, 2.5f, random.uniformf(0.01, 2), 6};
    const Vec3 p = random.pointInCube(1);
    const double size = distance(project<5>(PointLight{spot.position, spot.intensity, spot.radius}, p), {});
    const RadianceSH<5> turned = ShRotation<5>(r)(project<5>(spot, p));
    const std::string where = describe(spot) + ", p " + describe(p);
    spot.position = test::rotate(r, spot.position);
    spot.direction = test::rotate(r, spot.direction);
    RadianceSH<5> gap = project<5>(spot, test::rotate(r, p));
    gap += turned * -1.0f;
    worst.add(distance(gap, {}) / size, [&] { return where; });
  }
  worst.expectWithin(2e-5);  // the turned positions are rounded, and the cone is steep
}

TEST(ProjectInvariants, LightsWithoutMeaningGiveNothing) {
  const Vec3 p{0.5f, 0, 0};
  for (const float bad : {kNan, kInfinity}) {
    EXPECT_TRUE(isZero(project<5>(SphereLight{{bad, 0, 0}, 1, {1, 1, 1}}, p))) << bad;
    EXPECT_TRUE(isZero(project<5>(PointLight{{0, bad, 0}, {1, 1, 1}}, p))) << bad;
    EXPECT_TRUE(isZero(project<5>(SpotLight{{0, 0, 0}, {1, bad, 0}, {1, 1, 1}}, p))) << bad;
    EXPECT_TRUE(isZero(project<5>(DirectionalLight{{bad, 0, 0}, {1, 1, 1}}, p))) << bad;
    EXPECT_TRUE(isZero(project<5>(SphereLight{{0, 0, 0}, 1, {1, 1, 1}}, {bad, 0, 0}))) << bad;
  }
  EXPECT_TRUE(isZero(project<5>(SphereLight{{}, kNan, {1, 1, 1}}, p)));
  EXPECT_TRUE(isZero(project<5>(SphereLight{{}, 1, {1, kNan, 1}}, p)));
  EXPECT_TRUE(isZero(project<5>(PointLight{{}, {1, 1, kNan}}, p)));
  EXPECT_TRUE(isZero(project<5>(PointLight{{}, {1, 1, 1}, kNan}, p)));
  EXPECT_TRUE(isZero(project<5>(PointLight{{}, {1, 1, 1}, 1, kNan}, p)));
  EXPECT_TRUE(isZero(project<5>(SpotLight{{}, {1, 0, 0}, {1, 1, 1}, kNan}, p)));
  EXPECT_TRUE(isZero(project<5>(SpotLight{{}, {1, 0, 0}, {1, 1, 1}, 0, kNan}, p)));
  EXPECT_TRUE(isZero(project<5>(SphereLight{{}, 0, {1, 1, 1}}, p)));
  EXPECT_TRUE(isZero(project<5>(SphereLight{{}, 0, {1, 1, 1}}, {})));
  EXPECT_TRUE(isZero(project<5>(SphereLight{{}, -1, {1, 1, 1}}, p)));
  EXPECT_TRUE(isZero(project<5>(PointLight{{}, {1, 1, 1}, 1, 0}, p)));
  EXPECT_TRUE(isZero(project<5>(PointLight{{}, {1, 1, 1}, 1, -3}, p)));
  EXPECT_TRUE(isZero(project<5>(SpotLight{{}, {0, 0, 0}, {1, 1, 1}}, p)));
  EXPECT_TRUE(isZero(project<5>(DirectionalLight{{0, 0, 0}, {1, 1, 1}}, p)));
}

}  // namespace
}  // namespace rigel
