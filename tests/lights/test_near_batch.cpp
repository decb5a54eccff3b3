// Near lights at many points in vectors, on every instruction set of this machine, against exact irradiance in double,
// relative to the light's peak over normals as in test_near_light.cpp and test_disk_irradiance.cpp.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/near_batch.h>
#include <rigel/project.h>

#include <limits>

#include "lights/batch_points.h"
#include "lights/describe.h"
#include "lights/disk_poses.h"
#include "lights/every_target.h"
#include "lights/lights_for_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::BatchPoints;
using test::describe;
using test::onEveryTarget;
using test::Random;

// The scalar tests' own: rounding of float. Worst measured (10^6 points of each kind, on each instruction set): spheres
// 5.4e-7, points 5.0e-7, disks 9.5e-7, directional lights 1.4e-7; a spot's cone adds 1.5e-7 over its width.
constexpr double kLambertTolerance = 1e-6;
constexpr double kDiskTolerance = 2e-6;
constexpr double kConeTolerance = 3e-7;
// Between vectors and scalars where both approximate; worst measured 2.1e-6 at a = -0.25, whose peak is the least, 9e-7
// elsewhere.
constexpr double kTwinTolerance = 4e-6;

struct WrapTolerance {
  float lo, hi;
  double sphere, disk;
};
constexpr WrapTolerance kWraps[] = {
    {-0.25f, -0.1f, 0.022, 0.04}, {-0.1f, -1e-3f, 0.0115, 0.025}, {1e-3f, 0.999f, 0.008, 0.015}, {1, 1, 1e-6, 5e-4}};

constexpr float kUntouched = -12345;

/// One light, points around it, and what they receive of each unit of its colour.
struct Lit {
  NearLight light;
  std::string text;
  float wrap = 0;
  BatchPoints points, normals;
  std::vector<double> expected, peak;
  double toleranceScale = 1;  // of a cone

  Lit() = default;
  Lit(const NearLight& by, std::string description, float wrapped)
      : light(by), text(std::move(description)), wrap(wrapped) {}

  void add(Vec3 p, Vec3 n) {
    points.add(p);
    normals.add(n);
  }
  std::vector<float> evaluate() const {
    std::vector<float> out(3 * points.size(), kUntouched);
    nearIrradianceBatch({&light, 1}, points.rows(), normals.rows(), nearWrap(wrap), out);
    return out;
  }
  void compare(Worst& worst, std::span<const double> wanted) const {
    const std::vector<float> out = evaluate();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double error = std::abs(static_cast<double>(out[k]) - wanted[k]) / peak[k] / toleranceScale;
      worst.add(error, [&] {
        return text + ", p " + describe(points[k]) + ", n " + describe(normals[k]) + ", wrap " + describe(wrap) + ": " +
               describe(out[k]) + ", expected " + describe(wanted[k]);
      });
    }
  }
};

/// A unit normal that makes `angle` with unit vector w.
Vec3 normalAt(Random& random, Vec3 w, double angle) {
  const Vec3 side = cross(w, random.direction());
  const Vec3 n = w * static_cast<float>(std::cos(angle)) + side * static_cast<float>(std::sin(angle) / length(side));
  return n * (1 / length(n));
}

/// Points at every ratio of radius to distance, inside too, half of them with the horizon across the light.
template <class Light>
void addPointsAround(Lit& lit, Random& random, const Light& light) {
  for (int k = 20 + random.index(60); k > 0; --k) {
    const double distance = static_cast<double>(light.radius) / test::hardRatio(random);
    const Vec3 w = random.direction(), p = light.position - w * static_cast<float>(distance);
    const double alpha = std::asin(std::min(1.0, static_cast<double>(light.radius) / distance));
    const double crossing = std::acos(-static_cast<double>(lit.wrap)) + alpha * random.uniform(-1.05, 1.05);
    lit.add(p, k % 2 == 0 ? random.direction() : normalAt(random, w, std::clamp(crossing, 0.0, M_PI)));
  }
}

/// What `light` gives, and what `plain`, the same without window and cone, gives at most.
template <class Light, class Plain>
Lit litBy(Random& random, const Light& light, const Plain& plain, float wrap) {
  Lit lit(nearLight(light), describe(light), wrap);
  addPointsAround(lit, random, light);
  for (std::size_t k = 0; k < lit.points.size(); ++k) {
    const Vec3 p = lit.points[k];
    lit.expected.push_back(exactIrradiance(light, p, lit.normals[k], wrap).r);
    const Vec3 w = light.position - p;
    lit.peak.push_back(exactIrradiance(plain, p, w, wrap).r);
  }
  return lit;
}

Lit litBySphere(Random& random, float wrap) {
  const double size = random.index(2) == 0 ? random.logUniform(1e-2, 10) : random.logUniform(1e-10, 1e10);
  const SphereLight light{random.pointInCube(size), static_cast<float>(size), {1, 1, 1}};
  return litBy(random, light, light, wrap);
}

PointLight randomPoint(Random& random) {
  PointLight light{random.pointInCube(1), {1, 1, 1}, static_cast<float>(random.logUniform(1e-3, 3))};
  if (random.index(2) == 0) light.range = light.radius * static_cast<float>(random.logUniform(0.5, 300));
  return light;
}

Lit litByPoint(Random& random, float wrap) {
  const PointLight light = randomPoint(random);
  return litBy(random, light, PointLight{light.position, light.intensity, light.radius}, wrap);
}

Lit litBySpot(Random& random, float wrap) {
  const PointLight p = randomPoint(random);
  SpotLight light{p.position, random.direction() * random.uniformf(0.2, 3), p.intensity, 0, 0, p.radius, p.range};
  light.outerAngle = random.uniformf(0.3, 3.1);
  light.innerAngle = light.outerAngle * random.uniformf(0, 0.95);
  Lit lit = litBy(random, light, PointLight{p.position, p.intensity, p.radius}, wrap);
  const double width = std::max<double>(lit.light.cosInner - lit.light.cosOuter, kMinConeWidth);
  lit.toleranceScale = 1 + kConeTolerance / width / kLambertTolerance;
  return lit;
}

Lit litByDisk(Random& random, float wrap) {
  const DiskLight light{random.pointInCube(1), random.direction(), 1, {1, 1, 1}, random.index(2) == 0};
  Lit lit(nearLight(light), "disk", wrap);
  const Vec3 axis = lit.light.axis;
  for (int k = 20 + random.index(40); k > 0; --k) {
    // A pose around another disk, brought to this one.
    const auto pose = test::diskPose(random, static_cast<test::DiskFamily>(random.index(6)));
    const Vec3 apart = (pose.p - pose.light.position) * (1 / pose.light.radius);
    const float height = dot(apart, pose.light.direction) / length(pose.light.direction);
    const float rho = std::sqrt(std::max(0.0f, dot(apart, apart) - height * height));
    const Vec3 p = light.position + axis * height + test::perpendicular(random, axis) * rho;
    const Vec3 n = k % 2 == 0 ? random.direction() : test::normalAcross(random, light, p);
    const double peak = test::peakOf(light, p);
    if (!(peak > 0)) continue;
    lit.add(p, n);
    lit.expected.push_back(exactIrradiance(light, p, n, wrap).r);
    lit.peak.push_back(peak);
  }
  return lit;
}

Lit litByDirectional(Random& random, float wrap) {
  const DirectionalLight light{random.direction() * 3.0f, {1, 1, 1}};
  Lit lit(nearLight(light), describe(light), wrap);
  for (int k = 0; k < 40; ++k) {
    lit.add(random.pointInCube(10), random.direction());
    lit.expected.push_back(exactIrradiance(light, {}, lit.normals[static_cast<std::size_t>(k)], wrap).r);
    lit.peak.push_back(1);
  }
  return lit;
}

struct KindOfLight {
  const char* name;
  Lit (*lit)(Random&, float wrap);
  double tolerance;
};
constexpr KindOfLight kKinds[] = {{"spheres", litBySphere, kLambertTolerance},
                                  {"points", litByPoint, kLambertTolerance},
                                  {"spots", litBySpot, kLambertTolerance},
                                  {"disks", litByDisk, kDiskTolerance},
                                  {"directional lights", litByDirectional, kLambertTolerance}};

TEST(NearBatch, LambertOfEveryKind) {
  for (const KindOfLight& kind : kKinds) {
    Random random(501);
    std::vector<Lit> all;
    for (int k = 0; k < (test::fullRun() ? 20'000 : 100); ++k) all.push_back(kind.lit(random, 0));
    Worst worst(std::string("near ") + kind.name + " in vectors");
    onEveryTarget([&] {
      for (const Lit& lit : all) lit.compare(worst, lit.expected);
    });
    worst.expectWithin(kind.tolerance);
  }
}

TEST(NearBatch, Wrap) {
  for (const KindOfLight& kind : kKinds)
    for (const WrapTolerance& range : kWraps) {
      Random random(502);
      std::vector<Lit> all;
      for (int k = 0; k < (test::fullRun() ? 400 : 4); ++k)
        all.push_back(kind.lit(random, random.uniformf(range.lo, range.hi)));
      const std::string name = std::string("near ") + kind.name + " in vectors, wrap from " + describe(range.lo);
      Worst worst(name), twin(name + ", against scalars");
      onEveryTarget([&] {
        for (const Lit& lit : all) {
          lit.compare(worst, lit.expected);
          std::vector<double> scalar;
          for (std::size_t k = 0; k < lit.points.size(); ++k)
            scalar.push_back(nearIrradiance(lit.light, lit.points[k], lit.normals[k], lit.wrap).r);
          lit.compare(twin, scalar);
        }
      });
      worst.expectWithin(kind.lit == litByDisk ? range.disk : range.sphere);
      twin.expectWithin(kTwinTolerance);
    }
}

TEST(NearBatch, SpheresThatTouchToTheLastBit) {
  onEveryTarget([] {
    Random random(503);
    Worst worst("near spheres in vectors, touching");
    for (int k = 0; k < 60; ++k) {
      const test::Placement at = test::place(random, random.logUniform(1e-3, 1e3));
      SphereLight light = test::sphereAt(at, 1);
      for (int step = random.index(4); step > 0; --step) light.radius = std::nextafter(light.radius, 1e9f);
      Lit lit(nearLight(light), describe(light), 0);
      for (int i = 0; i < 17; ++i) {
        lit.add(at.receiver, random.direction());
        lit.expected.push_back(exactIrradiance(light, at.receiver, lit.normals[lit.points.size() - 1]).r);
        lit.peak.push_back(exactIrradiance(light, at.receiver, light.position - at.receiver).r);
      }
      lit.compare(worst, lit.expected);
    }
    worst.expectWithin(kLambertTolerance);
  });
}

/// Lights of all kinds with shares and colours, and a body between them.
struct Scene {
  std::vector<NearLight> lights;
  BatchPoints points, normals;

  explicit Scene(int count, int offset = 0) : points(offset), normals(offset) {
    lights = {nearLight(SphereLight{{0.4f, 1.2f, 0.1f}, 0.3f, {3, 2, 1}}, 0.7f),
              nearLight(SpotLight{{0.1f, 2, 0.3f}, {0, -1, 0}, {5, 6, 7}, 0.3f, 0.8f, 0.02f, 5}, 0.25f),
              nearLight(DiskLight{{-0.5f, 1.1f, 0.2f}, {0.4f, -1, 0}, 0.4f, {2, 4, 3}}, 0.9f),
              nearLight(PointLight{{0.2f, 0.4f, 0.6f}, {1, 2, 3}, 0.05f, 3}),
              nearLight(DirectionalLight{{1, -2, 1}, {1, 0.5f, 0.25f}}, 0.5f)};
    Random random(504);
    for (int k = 0; k < count; ++k) {
      points.add(random.pointInCube(1));
      normals.add(random.direction());
    }
  }
  std::vector<float> evaluate(const NearWrap& wrap) const {
    std::vector<float> out(3 * points.size(), kUntouched);
    nearIrradianceBatch(lights, points.rows(), normals.rows(), wrap, out);
    return out;
  }
};

TEST(NearBatch, SumsColoursSharesAndGain) {
  onEveryTarget([] {
    const Scene scene(150);
    for (const float a : {0.0f, 0.4f})
      for (const float gain : {1.0f, 0.5f}) {
        const NearWrap wrap = gpuWrap(a, gain);
        const std::vector<float> out = scene.evaluate(wrap);
        for (std::size_t k = 0; k < scene.points.size(); ++k) {
          Rgb expected;
          for (const NearLight& light : scene.lights)
            expected += nearIrradiance(light, scene.points[k], scene.normals[k], wrap);
          for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(out[static_cast<std::size_t>(c) * scene.points.size() + k], expected[c],
                        1e-5f * (1 + expected[c]))
                << "point " << k << ", wrap " << a;
        }
      }
    std::vector<float> none(3, kUntouched);
    const Scene one(1);
    nearIrradianceBatch({}, one.points.rows(), one.normals.rows(), nearWrap(), none);
    EXPECT_EQ(none, std::vector<float>(3, 0.0f));
  });
}

TEST(NearBatch, AnyCountAndAlignmentGivesTheSame) {
  onEveryTarget([] {
    const Scene all(150);
    for (const float a : {0.0f, 0.4f}) {
      const NearWrap wrap = nearWrap(a);
      const std::vector<float> whole = all.evaluate(wrap);
      for (int count = 0; count <= 150; count += count < 20 ? 1 : 13) {
        const Scene some(count, 1 + count % 5);
        const std::size_t n = some.points.size();
        std::vector<float> out(3 * n + 2, kUntouched);
        nearIrradianceBatch(some.lights, some.points.rows(), some.normals.rows(), wrap,
                            std::span(out).subspan(1, 3 * n));
        ASSERT_EQ(out.front(), kUntouched);
        ASSERT_EQ(out.back(), kUntouched);
        for (std::size_t k = 0; k < 3 * n; ++k)
          ASSERT_EQ(out[1 + k], whole[k / n * all.points.size() + k % n]) << k << " of " << count << ", wrap " << a;
      }
    }
  });
}

TEST(NearBatch, WhatIsNowhereAndWhatIsTooMuch) {
  onEveryTarget([] {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    Lit lit;
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0, kNan, 0}, Vec3{kInf, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 3e38f, -3e38f}})
      for (const Vec3 n : {Vec3{0, 1, 0}, Vec3{0, kNan, 0}}) lit.add(p, n);
    const NearLight lights[] = {nearLight(SphereLight{{0, 1, 0}, 0.3f, {1, 1, 1}}),
                                nearLight(SphereLight{{0, 1, 0}, 1e30f, {1, 1, 1}}),
                                nearLight(SphereLight{{0, 1e-25f, 0}, 1e-26f, {1e30f, 1, 1}}),
                                nearLight(PointLight{{0, 1, 0}, {1e38f, 1, 1}, 1e-6f}),
                                nearLight(SpotLight{{0, 1, 0}, {0, -1, 0}, {1, 1, 1}}),
                                nearLight(DiskLight{{0, 1, 0}, {0, -1, 0}, 0.3f, {1, 1, 1}}),
                                nearLight(DirectionalLight{{0, -1, 0}, {1, 1, 1}}),
                                nearLight(SphereLight{{0, kNan, 0}, 1, {1, 1, 1}}),
                                nearLight(SphereLight{{kInf, 1, 0}, 1, {1, 1, 1}}),
                                nearLight(DiskLight{{0, 1, 0}, {}, 0.3f, {1, 1, 1}}),
                                NearLight{}};
    for (const NearLight& light : lights)
      for (const float wrap : {0.0f, 0.5f}) {
        lit.light = light;
        lit.wrap = wrap;
        const std::vector<float> out = lit.evaluate();
        for (std::size_t k = 0; k < lit.points.size(); ++k) {
          const Rgb expected = nearIrradiance(light, lit.points[k], lit.normals[k], wrap);
          EXPECT_NEAR(out[k], expected.r, 2e-6f * (1 + expected.r))
              << static_cast<int>(light.kind) << ", p " << describe(lit.points[k]) << ", n " << describe(lit.normals[k])
              << ", wrap " << wrap;
        }
      }
  });
}

}  // namespace
}  // namespace rigel
