// What test_light_bound.cpp does not say of ProbedBounds: where they are the same as LightBounds, and that they are as
// well-behaved.
#include "largest_jump.h"
#include "lights/describe.h"
#include "lights/random.h"
#include "probe_patch.h"
#include "random_lights.h"
#include "rig_fixture.h"

#include <rigel/probed_bounds.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace rigel::test {
namespace {

const RigBox kBox{{-1, -0.5f, -0.4f}, {1, 0.5f, 0.4f}};
const std::vector<std::string> kSampled = {
    "poly:1", "poly:6", "poly:20", "invquad:6", "rbf:6", "lattice:3x2x2@lsq", "lattice:3x2x2@gauss"};

Rig boxRig(const std::string& spec) {
  const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
  return *Rig::create(specOf(spec), {kBox, surface, true});
}

Eigen::Vector3d anywhere(Random& random) {
  const Vec3 d = random.direction();
  return Eigen::Vector3d(d.x, d.y, d.z) * random.logUniform(0.1, 3);
}

Eigen::Matrix3d anyShape(Random& random) {
  Eigen::Matrix3d half;
  for (int a = 0; a < 3; ++a) half.col(a) = anywhere(random);
  return half * half.transpose() + 1e-2 * Eigen::Matrix3d::Identity();
}

/// A point of the patch's surface.
Eigen::Vector3d onPatch(const Eigen::LLT<Eigen::Matrix3d>& half, Random& random) {
  const Vec3 d = random.direction();
  return half.matrixL() * Eigen::Vector3d(d.x, d.y, d.z);
}

TEST(ProbePatch, IsNoFartherThanItsPoints) {
  Random random(1);
  double closest = 10;
  for (int i = 0; i < 400; ++i) {
    const ProbePatch patch(anyShape(random));
    const Eigen::LLT<Eigen::Matrix3d> half(patch.shape());
    const Eigen::Vector3d x = anywhere(random);
    const double distance = patch.distance(x);
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2000; ++k) nearest = std::min(nearest, (onPatch(half, random) - x).norm());
    if (x.dot(half.solve(x)) < 1) nearest = 0;
    ASSERT_LE(distance, nearest * (1 + 1e-9));
    ASSERT_LE(patch.distanceAlong(x), distance * (1 + 1e-9) + 1e-12);
    if (distance > 0) closest = std::min(closest, nearest / distance);
  }
  EXPECT_LT(closest, 1.01);
}

TEST(ProbePatch, HoldsWhatItIsAskedTo) {
  Random random(2);
  for (int i = 0; i < 400; ++i) {
    ProbePatch patch(anyShape(random));
    const Eigen::Vector3d x = anywhere(random);
    patch.hold(x);
    EXPECT_LT(x.dot(patch.shape().llt().solve(x)), 1 + 1e-6);
  }
}

TEST(ProbePatch, KnowsTheLeastOfAQuadratic) {
  Random random(3);
  double tightest = 10;
  for (int i = 0; i < 400; ++i) {
    const ProbePatch patch(anyShape(random));
    const Eigen::LLT<Eigen::Matrix3d> half(patch.shape());
    const Eigen::Matrix3d curvature = anyShape(random);
    const Eigen::Vector3d slope = anywhere(random);
    // Positive everywhere.
    const double value = random.uniform(1, 2) * slope.dot(curvature.llt().solve(slope)) / 4;
    const double least = patch.least(value, slope, curvature);
    double found = value;
    for (int k = 0; k < 2000; ++k) {
      const Eigen::Vector3d x = onPatch(half, random) * std::cbrt(random.uniform(0, 1));
      found = std::min(found, value + slope.dot(x) + x.dot(curvature * x));
    }
    ASSERT_LE(least, found * (1 + 1e-9));
    if (least > 0) tightest = std::min(tightest, found / least);
  }
  EXPECT_LT(tightest, 1.05);
}

TEST(ProbedBounds, AreLightBoundsWhereTheseAreTheoremsOrNothingElseIsKnown) {
  const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
  // The last two are not, and were not asked for.
  for (const std::string spec :
       {"constant", "gradient", "gradient@numeric", "lattice:3x2x2", "mixed:l3,g,c", "poly:6", "lattice:3x2x2@lsq"}) {
    const Rig rig = *Rig::create(specOf(spec), {kBox, surface});
    const LightBounds bounds(rig, {});
    ProbedBounds probed(rig, {});
    EXPECT_FALSE(probed.tight()) << spec;
    EXPECT_EQ(boxRig(spec).anchors().empty(), !ProbedBounds(boxRig(spec), {}).tight()) << spec;
    RandomLights lights(kBox, 4);
    for (int i = 0; i < 50; ++i) {
      const DiskLight disk = lights.disk();
      const SpotLight spot = lights.spot();
      EXPECT_EQ(probed(disk).error, bounds(disk).error) << spec;
      EXPECT_EQ(probed(spot).error, bounds(spot).error) << spec;
    }
  }
}

TEST(ProbedBounds, WhatGivesNothingIsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const std::string& spec : kSampled) {
    const Rig rig = boxRig(spec);
    ProbedBounds bounds(rig, {});
    const auto zero = [&](auto light) {
      const LightBound bound = bounds(light);
      return bound.error == 0 && bound.peak == 0;
    };
    EXPECT_TRUE(zero(SphereLight{{0, nan, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(SphereLight{{0, infinite, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, -1, 0}, nan, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, nan}, {0, -1, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, nan, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, 1, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_FALSE(zero(DiskLight{{0, 3, 0}, {0, -1, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(PointLight{{0, 3, 0}, {1, 1, 1}, 0.01f, 2.4f})) << spec;
    EXPECT_TRUE(zero(SpotLight{{0, 3, 0}, {0, 1, 0}, {1, 1, 1}, 0.2f, 0.5f})) << spec;
    EXPECT_EQ(bounds(DirectionalLight{{0, -1, 0}, {1, 1, 1}}).error, 0) << spec;
    // The light's own colour does not count.
    EXPECT_EQ(bounds(SphereLight{{0, 3, 0}, 1, {}}).error, bounds(SphereLight{{0, 3, 0}, 1, {1, 2, 3}}).error) << spec;
  }
}

TEST(ProbedBounds, AreFiniteForAnyFiniteLightAndNoLargerThanLightBounds) {
  Random random(5);
  for (const std::string& spec : kSampled) {
    const Rig rig = boxRig(spec);
    const LightBounds bounds(rig, {});
    ProbedBounds probed(rig, {});
    for (int i = 0; i < 500; ++i) {
      const auto scale = static_cast<float>(random.logUniform(1e-30, 1e30));
      const Vec3 p = random.direction() * scale;
      const auto radius = static_cast<float>(random.logUniform(1e-30, 1e18));
      const auto range = static_cast<float>(random.logUniform(1e-20, 1e30));
      const auto check = [&](const auto& light) {
        const LightBound b = probed(light);
        ASSERT_TRUE(std::isfinite(b.error) && std::isfinite(b.peak)) << spec << ' ' << describe(light);
        ASSERT_GE(b.error, 0) << spec << ' ' << describe(light);
        ASSERT_LE(b.error, bounds(light).error) << spec << ' ' << describe(light);
      };
      check(SphereLight{p, radius, {1, 1, 1}});
      check(PointLight{p, {1, 1, 1}, radius, range});
      check(SpotLight{p, random.direction(), {1, 1, 1}, 0.1f, 0.1f, radius, range});
      check(DiskLight{p, random.direction(), radius, {1, 1, 1}, i % 2 == 0});
    }
  }
}

// Of 2e-7 of a path: as a square root next to a light's surface, and through a face that comes out of the box.
constexpr double kAllowed = 6e-3;

TEST(ProbedBounds, AreContinuousInTheLight) {
  for (const std::string& spec : kSampled) {
    const Rig rig = boxRig(spec);
    ProbedBounds bounds(rig, {});
    const auto path = [](float t) { return Vec3{-3 + 6 * t, 0.2f + 0.5f * t, 0.1f - 0.6f * t}; };
    const auto check = [&](const char* name, auto make) {
      const auto error = [&](double t) { return double{bounds(make(static_cast<float>(t))).error}; };
      EXPECT_LT(largestJump(1000, error), kAllowed) << spec << ' ' << name;
    };
    check("sphere through the box", [&](float t) { return SphereLight{path(t), 0.3f, {1, 1, 1}}; });
    check("point with window", [&](float t) { return PointLight{path(t), {1, 1, 1}, 0.2f, 1.5f}; });
    check("spot through the box", [&](float t) {
      return SpotLight{path(t), {0.3f, -1, 0.2f}, {1, 1, 1}, 0.3f, 0.6f, 0.2f};
    });
    check("disk through the box", [&](float t) { return DiskLight{path(t), {1, 0.3f, 0.2f}, 0.6f, {1, 1, 1}}; });
    check("two-sided disk, edge on", [&](float t) {
      return DiskLight{path(t), {0.1f, 1, 0.2f}, 0.3f, {1, 1, 1}, true};
    });
    check("turning disk", [&](float t) {
      return DiskLight{{0.5f, 1, 0.7f}, {std::sin(6 * t), -std::cos(6 * t), 0.2f}, 0.4f, {1, 1, 1}};
    });
    check("growing disk", [&](float t) { return DiskLight{{1.2f, 1, 0.3f}, {-1, -0.5f, 0.2f}, 3 * t, {1, 1, 1}}; });
  }
}

TEST(ProbedBounds, AreContinuousInThePose) {
  const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
  for (const std::string spec : {"poly:6", "invquad:6", "lattice:3x2x2@lsq", "lattice:3x2x2@gauss"}) {
    Rig rig = boxRig(spec);
    std::vector<Vec3> anchors(rig.anchors().size());
    // Grows along x, sways along y, bends the anchors, and is nearly flat at t = 1/2.
    const auto posed = [&](double t) {
      const Vec3 scale{static_cast<float>(1 + t), 1, static_cast<float>(0.02 + std::abs(2 * t - 1))};
      const Vec3 shift{0, static_cast<float>(0.5 * std::sin(6 * t)), 0};
      const auto moved = [&](Vec3 p) { return Vec3{p.x * scale.x, p.y * scale.y, p.z * scale.z} + shift; };
      const auto bend = static_cast<float>(0.8 * t);
      for (std::size_t i = 0; i < anchors.size(); ++i) {
        const Vec3 p = surface[rig.anchors()[i]];
        anchors[i] = moved({p.x * (1 - bend * p.y * p.y), p.y, p.z});
      }
      rig.setPose({{moved(kBox.lo), moved(kBox.hi)}, anchors});
      return ProbedBounds(rig, {});
    };
    const auto check = [&](const char* name, auto light) {
      EXPECT_LT(largestJump(200, [&](double t) { return double{posed(t)(light).error}; }), kAllowed)
          << spec << ' ' << name;
    };
    check("sphere that touches", SphereLight{{1.5f, 0.6f, 0.1f}, 0.3f, {1, 1, 1}});
    check("far point", PointLight{{5, 4, -3}, {1, 1, 1}});
    check("disk", DiskLight{{0.5f, 0.6f, 0.7f}, {0.1f, -1, -0.3f}, 0.5f, {1, 1, 1}});
  }
}

TEST(ProbedBounds, FollowTheFrame) {
  const float co = std::cos(0.7f), si = std::sin(0.7f);
  const RigFrame turned{{co, 0, -si}, {0, 1, 0}, {si, 0, co}, {5, -2, 3}};
  for (const std::string& spec : kSampled) {
    const Rig rig = boxRig(spec);
    ProbedBounds here(rig, {});
    ProbedBounds there(rig, {});
    there.place(turned);
    RandomLights lights(kBox, 3);
    for (int i = 0; i < 50; ++i) {
      const SpotLight light = lights.spot();
      SpotLight moved = light;
      moved.position = turned.point(light.position);
      moved.direction = turned.vector(light.direction);
      const float distance = length(light.position);
      if (distance < 3 || distance > 30) continue;  // where rounding is more than 1e-2 of the error
      EXPECT_NEAR(there(moved).error, here(light).error, 1e-2 * std::abs(here(light).error)) << spec;
    }
  }
}

}  // namespace
}  // namespace rigel::test
