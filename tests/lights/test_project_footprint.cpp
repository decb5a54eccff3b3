// Receivers that are patches rather than points (project with a footprint).
#include <gtest/gtest.h>
#include <rigel/project.h>

#include <algorithm>

#include "lights/describe.h"
#include "lights/random.h"

namespace rigel {
namespace {

using test::describe;
using test::Random;

constexpr float kPatch = 0.3f;  // m

LightSet setOf(const PointLight& light) {
  LightSet lights;
  lights.add(light);
  return lights;
}

double bandZero(const RadianceSH<3>& sh) { return static_cast<double>(sh[0].g); }

/// Band 0 of a point light averaged over a disc of radius kPatch around the origin with normal n.
double discAverage(const LightSet& lights, Vec3 n) {
  const Vec3 t = std::abs(n.x) < 0.5f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 u = cross(n, t);
  u = u * (1 / length(u));
  const Vec3 v = cross(n, u);
  constexpr int kPoints = 20000;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double r = kPatch * std::sqrt((i + 0.5) / kPoints);
    const double phi = i * 2.39996322972865332;
    sum += bandZero(
        project<3>(lights, u * static_cast<float>(r * std::cos(phi)) + v * static_cast<float>(r * std::sin(phi))));
  }
  return sum / kPoints;
}

TEST(ProjectFootprint, ZeroIsAPoint) {
  Random random(61);
  for (int i = 0; i < 1000; ++i) {
    const PointLight light{random.pointInCube(2), random.colour(), 0.02f};
    const RadianceSH<3> a = project<3>(setOf(light), {}, 0);
    const RadianceSH<3> b = project<3>(light, {});
    for (int k = 0; k < 9; ++k) EXPECT_EQ(a[k], b[k]) << describe(light);
  }
}

TEST(ProjectFootprint, LeavesDistantLightsAndLightsLargerThanThePatch) {
  Random random(62);
  for (int i = 0; i < 1000; ++i) {
    const SphereLight large{random.pointInCube(2), kPatch * 1.5f, random.colour()};
    LightSet lights;
    lights.add(large);
    EXPECT_EQ(project<3>(lights, {}, kPatch)[0], project<3>(large, {})[0]) << describe(large);

    const PointLight distant{random.direction() * (40 * kPatch), random.colour()};
    const double patch = bandZero(project<3>(setOf(distant), {}, kPatch));
    const double point = bandZero(project<3>(distant, {}));
    EXPECT_NEAR(patch, point, 1e-3 * point) << describe(distant);  // the sphere's s2/4 beyond s2: 1.6e-4 at 40 radii
  }
}

TEST(ProjectFootprint, IsAboutWhatThePatchReceivesOnAverage) {
  // Lights from a thousandth of the patch's radius away to ten of it, in all directions from the disc. The average over
  // a disc grows with the logarithm of 1/d, the footprint's value stays bounded: hence the lower limit.
  Random random(63);
  double lowest = 1e9, highest = 0, pointHighest = 0;
  for (int i = 0; i < 300; ++i) {
    const auto d = static_cast<float>(random.logUniform(1e-3, 10)) * kPatch;
    const PointLight light{random.direction() * d, {1, 1, 1}, 1e-3f * kPatch};
    const LightSet lights = setOf(light);
    const double average = discAverage(lights, random.direction());
    const double ratio = bandZero(project<3>(lights, {}, kPatch)) / average;
    lowest = std::min(lowest, ratio);
    highest = std::max(highest, ratio);
    pointHighest = std::max(pointHighest, bandZero(project<3>(lights, {})) / average);
  }
  std::cout << "footprint over disc average: " << lowest << " to " << highest << "; a point sample: up to "
            << pointHighest << std::endl;
  EXPECT_GT(lowest, 0.05);       // worst seen 0.11, edge on at d = 0.001
  EXPECT_LT(highest, 5);         // worst seen 3.2, face on at d about the patch's radius
  EXPECT_GT(pointHighest, 1e3);  // what footprints are for
}

TEST(ProjectFootprint, IsContinuousInTheLightsPosition) {
  double worst = 0;
  RadianceSH<3> before = project<3>(setOf({{-1, 0.01f, 0}, {1, 1, 1}}), {}, kPatch);
  const double peak = bandZero(project<3>(setOf({{}, {1, 1, 1}}), {}, kPatch));
  for (float x = -1; x <= 1; x += 1e-3f) {
    const RadianceSH<3> now = project<3>(setOf({{x, 0.01f, 0}, {1, 1, 1}}), {}, kPatch);
    for (int k = 0; k < 9; ++k) worst = std::max(worst, static_cast<double>(std::abs(now[k].g - before[k].g)) / peak);
    before = now;
  }
  EXPECT_LT(worst,
            0.08);  // worst seen 0.054 for a step of 1 mm, at d = patch radius, where c falls off as a square root
}

}  // namespace
}  // namespace rigel
