// Derivatives of many lights' SH in vectors, on every instruction set of this machine, against the scalar functions.
#include <gtest/gtest.h>
#include <rigel/project_batch.h>

#include "lights/batch_points.h"
#include "lights/describe.h"
#include "lights/every_target.h"
#include "lights/lights_for_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::BatchPoints;
using test::describe;
using test::onEveryTarget;
using test::Placement;
using test::Random;

template <int B>
struct Both {
  std::vector<float> sums;
  std::size_t count;

  Both(const LightSet& lights, const BatchPoints& points)
      : sums(12 * B * B * points.size(), -12345.0f), count(points.size()) {
    PreparedLights prepared;
    prepared.set(lights);
    projectBatchWithGradient<B>(prepared, prepared.all(), points.rows(), sums);
  }
  float operator()(int part, int i, int colour, std::size_t point) const {
    return sums[static_cast<std::size_t>(part * 3 * B * B + 3 * i + colour) * count + point];
  }
};

PointLight whole(const PointLight& light) { return {light.position, light.intensity, light.radius}; }
PointLight whole(const SpotLight& light) { return {light.position, light.intensity, light.radius}; }
const SphereLight& whole(const SphereLight& light) { return light; }
const DiskLight& whole(const DiskLight& light) { return light; }

double coneWidth(const SpotLight& light) {
  const double width =
      std::cos(static_cast<double>(light.innerAngle)) - std::cos(static_cast<double>(light.outerAngle));
  return std::max<double>(width, kMinConeWidth);
}
double coneWidth(const auto&) { return 1e9; }

/// Errors over the largest component of value and gradient, of the light without window and cone if that is larger;
/// what a cone's edge leaves is taken off before.
template <int B, class Light>
void compare(Worst& value, Worst& slope, const Light& light, Vec3 p, std::size_t lane) {
  BatchPoints points;
  for (std::size_t k = 0; k < 20; ++k)
    points.add(k == lane ? p : p + (p + light.position * -1) * (0.1f * static_cast<float>(k)));
  LightSet set;
  set.add(light);
  const Both<B> q(set, points);
  const ProjectionWithGradient<B> expected = projectWithGradient<B>(light, p),
                                  scale = projectWithGradient<B>(whole(light), p);
  double largest = 0, largestSlope = 0, error = 0, slopeError = 0;
  for (int i = 0; i < B * B; ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(scale.value[i].g)));
    error = std::max(error, std::abs(static_cast<double>(q(0, i, 1, lane)) - expected.value[i].g));
    for (int axis = 0; axis < 3; ++axis) {
      largestSlope = std::max({largestSlope, std::abs(static_cast<double>(scale.gradient.d[axis][i].g)),
                               std::abs(static_cast<double>(expected.gradient.d[axis][i].g))});
      slopeError =
          std::max(slopeError, std::abs(static_cast<double>(q(1 + axis, i, 1, lane)) - expected.gradient.d[axis][i].g));
    }
  }
  const double width = coneWidth(light);
  const auto text = [&] { return describe(light) + ", p " + describe(p); };
  value.add(std::max(0.0, error / largest - 3e-7 / width), text);
  slope.add(std::max(0.0, slopeError / largestSlope - 1e-6 / (width * width)), text);
}

int count(int usual) { return test::fullRun() ? 100 * usual : usual; }

template <int B>
void compareKinds() {
  onEveryTarget([] {
    Random random(91);
    Worst spheres("spheres, r/d 1e-8 to 0.9"), sphereSlopes("their slopes");
    Worst close("spheres touching and inside"), closeSlopes("their slopes");
    Worst points("points and spots"), pointSlopes("their slopes");
    Worst disks("disks"), diskSlopes("their slopes");
    for (int k = 0; k < count(200); ++k) {
      const auto lane = static_cast<std::size_t>(random.index(20));
      Placement at = test::place(random, random.logUniform(1e-6, 1e6));
      SphereLight sphere = test::sphereAt(at, k % 2 == 0 ? random.logUniform(1e-8, 0.9) : random.uniform(0.01, 0.9));
      sphere.radiance = random.colour();
      compare<B>(spheres, sphereSlopes, sphere, at.receiver, lane);
      const double gap = random.logUniform(1e-5, 0.1);
      sphere = test::sphereAt(at, k % 3 == 0 ? 1 - gap : k % 3 == 1 ? 1 + gap : 1 / random.logUniform(1e-6, 0.9));
      compare<B>(close, closeSlopes, sphere, at.receiver, lane);
      at = test::place(random, random.logUniform(1e-2, 1e4));
      const double ratio = k % 5 == 0 ? random.uniform(1.2, 20) : random.logUniform(1e-8, 0.9);
      compare<B>(points, pointSlopes, test::pointAt(random, at, ratio), at.receiver, lane);
      compare<B>(points, pointSlopes, test::spotAt(random, at, ratio), at.receiver, lane);
      if (k % 10 != 0) continue;
      const DiskLight disk{at.centre,
                           at.receiver + at.centre * -1 + random.direction() * static_cast<float>(at.distance * 0.5),
                           static_cast<float>(at.distance * random.uniform(0.1, 0.8)), random.colour()};
      compare<B>(disks, diskSlopes, disk, at.receiver, lane);
    }
    spheres.expectWithin(1.5e-6);
    sphereSlopes.expectWithin(3e-6);
    close.expectWithin(1.5e-6);
    closeSlopes.expectWithin(3e-6);
    points.expectWithin(1.5e-6);
    pointSlopes.expectWithin(3e-6);
    disks.expectWithin(1e-6);
    diskSlopes.expectWithin(1e-6);
  });
}

TEST(ProjectBatchGradient, EveryKind2Bands) { compareKinds<2>(); }
TEST(ProjectBatchGradient, EveryKind3Bands) { compareKinds<3>(); }
TEST(ProjectBatchGradient, EveryKind4Bands) { compareKinds<4>(); }
TEST(ProjectBatchGradient, EveryKind5Bands) { compareKinds<5>(); }

// Where float holds a sphere's area, where it does not, and between.
TEST(ProjectBatchGradient, SpheresOfAnySize) {
  onEveryTarget([] {
    Random random(93);
    Worst value("spheres of 1e-12 to 1e14 m"), slope("their slopes");
    for (double decade = -12; decade <= 14; decade += 0.5)
      for (const double share : {1e-6, 1e-3, 0.5, 1.5, 30.0, 1e4}) {
        const auto radius = static_cast<float>(std::pow(10, decade));
        const Vec3 p = random.direction() * (radius * static_cast<float>(share));
        compare<3>(value, slope, SphereLight{{}, radius, random.colour()}, p, 3);
      }
    value.expectWithin(1.5e-6);
    slope.expectWithin(3e-6);
  });
}

// Many lights of all kinds at many points, values those of projectBatch to its errors.
TEST(ProjectBatchGradient, ManyLightsAtManyPoints) {
  onEveryTarget([] {
    Random random(92);
    LightSet lights;
    for (int k = 0; k < 40; ++k) {
      const auto place = [&] { return random.pointInCube(8); };
      lights.add(DirectionalLight{random.direction(), random.colour()});
      lights.add(PointLight{place(), random.colour(), 0.02f, k % 2 == 0 ? kNoRange : random.uniformf(4, 12)});
      const Vec3 p = place();
      lights.add(SpotLight{p, random.pointInCube(1) - p, random.colour(), random.uniformf(0, 0.4), 0.8f, 0.01f, 20});
      lights.add(SphereLight{place(), random.uniformf(0.01, 0.5), random.colour()});
    }
    BatchPoints points;
    for (int k = 0; k < 75; ++k) points.add(random.pointInCube(1));
    const Both<3> q(lights, points);
    const auto sums = test::sumsOf<3>(lights, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ProjectionWithGradient<3> expected = projectWithGradient<3>(lights, points[k]);
      double scale = 0, slopeScale = 0;
      for (int i = 0; i < 9; ++i) {
        scale = std::max(scale, std::abs(static_cast<double>(expected.value[i].r)));
        for (const auto& d : expected.gradient.d)
          slopeScale = std::max(slopeScale, std::abs(static_cast<double>(d[i].r)));
      }
      for (int i = 0; i < 9; ++i) {
        EXPECT_NEAR(q(0, i, 0, k), sums[static_cast<std::size_t>(3 * i) * points.size() + k], 2e-6 * scale);
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(q(1 + axis, i, 0, k), expected.gradient.d[axis][i].r, 2e-5 * slopeScale) << axis << " " << i;
      }
    }
  });
}

}  // namespace
}  // namespace rigel
