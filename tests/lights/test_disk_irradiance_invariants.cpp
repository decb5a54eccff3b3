// What must hold of a disk's irradiance whatever its value is, and the poses that break formulas.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/near_light.h>

#include <bit>
#include <limits>

#include "lights/disk_poses.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::DiskFamily;
using test::DiskPose;
using test::Random;

constexpr float kWraps[] = {-0.25f, -0.1f, 0, 0.3f, 1};
constexpr double kRounding = 1e-11;  // of the result: double, over poses within 1e-5 of the rim; worst 7e-13

float near(const DiskLight& light, Vec3 p, Vec3 n, float wrap = 0) {
  return nearIrradiance(nearLight(light), p, n, wrap).r;
}

DiskFamily anyFamily(Random& random) { return static_cast<DiskFamily>(random.index(6)); }

/// A turn or mirror that floats do exactly: axes permuted, some of them negated.
Vec3 turned(Vec3 v, int which) {
  const int shift = which % 3;
  Vec3 out{v[shift], v[(shift + 1) % 3], v[(shift + 2) % 3]};
  for (int axis = 0; axis < 3; ++axis)
    if (which / 3 >> axis & 1) out[axis] = -out[axis];
  return out;
}

TEST(DiskInvariants, TurnsAndScalesDoNotMatter) {
  Random random(321);
  Worst worst("disk turned and scaled, exact");
  Worst worstNear("disk turned and scaled, near");
  for (int k = 0; k < 300; ++k) {
    const DiskPose pose = test::diskPose(random, anyFamily(random));
    const float wrap = kWraps[k % 5];
    const int which = random.index(24);
    const float scale = std::ldexp(1.0f, random.index(20) - 10);
    DiskLight light = pose.light;
    light.position = turned(light.position, which) * scale;
    light.direction = turned(light.direction, which);
    light.radius *= scale;
    const Vec3 p = turned(pose.p, which) * scale;
    const Vec3 n = turned(pose.n, which);
    const double before = exactIrradiance(pose.light, pose.p, pose.n, wrap).r;
    // The quadrature of a wrapped kernel stops where it is good enough.
    const double tolerance = wrap == 0 ? 0 : 1e-8;
    const double change = std::abs(exactIrradiance(light, p, n, wrap).r - before);
    worst.add(std::max(0.0, change - tolerance) / std::max(before, 1e-6), [&] { return describe(pose); });
    worstNear.add(std::abs(near(light, p, n) - near(pose.light, pose.p, pose.n)) / kPi, [&] { return describe(pose); });
  }
  worst.expectWithin(kRounding);
  worstNear.expectWithin(1e-6);
}

TEST(DiskInvariants, BothSidesOfATwoSidedDiskAreAlike) {
  Random random(322);
  for (int k = 0; k < 200; ++k) {
    DiskLight light{{}, {0, 0, 1}, random.uniformf(0.1, 3), {1, 1, 1}, true};
    const Vec3 p = random.direction();
    const Vec3 n = random.direction();
    const float wrap = kWraps[k % 5];
    const Vec3 behind{p.x, p.y, -p.z};
    const Vec3 mirrored{n.x, n.y, -n.z};
    EXPECT_NEAR(exactIrradiance(light, p, n, wrap).r, exactIrradiance(light, behind, mirrored, wrap).r, 1e-12);
    EXPECT_EQ(near(light, p, n, wrap), near(light, behind, mirrored, wrap));
    light.twoSided = false;
    const Vec3 dark = p.z < 0 ? p : behind;
    EXPECT_EQ(exactIrradiance(light, dark, n, wrap).r, 0);
    EXPECT_EQ(near(light, dark, n, wrap), 0);
    EXPECT_EQ(cheapIrradiance(nearLight(light), dark, n), Rgb{});
    EXPECT_EQ(correctorIrradiance(nearLight(light), dark, n, nearWrap(wrap)), Rgb{});
  }
}

// E(n) - E(-n) = n . V: linear in n.
TEST(DiskInvariants, DifferenceOfOppositeNormalsIsTheVectorIrradiance) {
  Random random(323);
  Worst worst("opposite normals against the vector irradiance, of its length");
  for (int k = 0; k < 500; ++k) {
    const DiskPose pose = test::diskPose(random, anyFamily(random));
    const auto difference = [&](Vec3 n) {
      return exactIrradiance(pose.light, pose.p, n).r - exactIrradiance(pose.light, pose.p, -n).r;
    };
    const double v[3] = {difference({1, 0, 0}), difference({0, 1, 0}), difference({0, 0, 1})};
    double expected = 0;
    double length = 0;
    double normal = 0;
    for (int axis = 0; axis < 3; ++axis) {
      expected += v[axis] * static_cast<double>(pose.n[axis]);
      length += v[axis] * v[axis];
      normal += static_cast<double>(pose.n[axis]) * static_cast<double>(pose.n[axis]);
    }
    if (length > 0) {
      worst.add(std::abs(difference(pose.n) - expected / std::sqrt(normal)) / std::sqrt(length),
                [&] { return describe(pose); });
    }
  }
  worst.expectWithin(1e-9);  // slivers: what doubles leave of a difference; worst 3e-11
}

TEST(DiskInvariants, OnTheFaceIsTheHemisphere) {
  Random random(324);
  Worst worst("a millionth above the face against pi (1 + cos)/2");
  for (int k = 0; k < 500; ++k) {
    const DiskLight light{{}, {0, 0, 1}, 1, {1, 1, 1}};
    const Vec3 p{random.uniformf(-0.6, 0.6), random.uniformf(-0.6, 0.6), 1e-6f};
    const Vec3 n = random.direction();
    const double expected = kPi * (1 - static_cast<double>(n.z)) / 2;
    worst.add(std::abs(exactIrradiance(light, p, n).r - expected), [&] { return test::describe(n); });
    worst.add(std::abs(near(light, p, n) - expected), [&] { return test::describe(n); });
  }
  worst.expectWithin(1e-5);  // the millionth: the rim is 2.5e-6 below the horizon at most
}

TEST(DiskInvariants, OnTheAxisIsTheSphereOfThatSize) {
  // Seen from its axis a disk is what a sphere is that fills the same cone.
  Random random(325);
  Worst worst("exact disk on its axis against a sphere");
  Worst worstNear("near disk on its axis against a sphere");
  for (int k = 0; k < 400; ++k) {
    const auto z = static_cast<float>(random.logUniform(1e-2, 1e3));
    const DiskLight disk{{0, z, 0}, {0, -1, 0}, 1, {1, 1, 1}};
    const double distance = std::sqrt(1 + static_cast<double>(z) * static_cast<double>(z));
    const SphereLight sphere{{0, static_cast<float>(distance), 0}, 1, {1, 1, 1}};
    const Vec3 n = k % 2 == 0 ? random.direction() : test::normalAcross(random, disk, {});
    const float wrap = kWraps[k % 5];
    const double peak = kPi / (distance * distance);
    const double expected = exactIrradiance(sphere, {}, n, wrap).r;
    // The sphere's distance is rounded to float, which near the face counts as its root.
    const double allowed = 1e-6 / static_cast<double>(std::min(z, 1.0f));
    const auto text = [&] {
      return "z " + test::describe(z) + ", n " + test::describe(n) + ", " + test::describe(wrap);
    };
    worst.add(std::abs(exactIrradiance(disk, {}, n, wrap).r - expected) / peak / allowed, text);
    if (wrap == 0) worstNear.add(std::abs(near(disk, {}, n) - expected) / peak / allowed, text);
  }
  worst.expectWithin(1);
  worstNear.expectWithin(2);
}

TEST(DiskInvariants, LightFadesTowardsThePlaneOutsideTheRim) {
  // The one way past the disk without a jump.
  const DiskLight light{{}, {0, 0, 1}, 1, {1, 1, 1}};
  for (const float wrap : kWraps) {
    double last = 0;
    for (int i = -200; i <= 200; ++i) {
      const Vec3 p{1.1f, 0, static_cast<float>(i) * 1e-3f};
      const Vec3 n = test::unit({-1, 0.2f, -0.3f});
      const double actual = near(light, p, n, wrap);
      if (i > -200) {
        EXPECT_LT(std::abs(actual - last), 0.02) << p.z;
      }
      if (i <= 0) {
        EXPECT_EQ(actual, 0);
      }
      last = actual;
    }
    EXPECT_GT(last, 0.3);
  }
}

TEST(DiskInvariants, ShareGainAndRadianceScale) {
  const DiskLight light{{1, 2, 0.5f}, {-0.6f, -0.8f, 0}, 0.7f, {1, 2, 4}};
  const Vec3 n{0.6f, 0.8f, 0};
  for (const float wrap : {-0.2f, 0.0f, 0.5f, 1.0f}) {
    const Rgb whole = nearIrradiance(nearLight(light), {}, n, wrap);
    EXPECT_GT(whole.r, 0);
    EXPECT_EQ(nearIrradiance(nearLight(light, 0.25f), {}, n, wrap), whole * 0.25f);
    EXPECT_EQ(nearIrradiance(nearLight(light), {}, n, gpuWrap(wrap, 0.5f)), whole * 0.5f);
    EXPECT_EQ(whole.b, 4 * whole.r);
    EXPECT_NEAR(exactIrradiance(light, {}, n, wrap).g, 2 * exactIrradiance(light, {}, n, wrap).r, 1e-12);
  }
}

TEST(DiskInvariants, GpuStructure) {
  const DiskLight light{{1, 2, 0.5f}, {0, -2, 0}, 0.5f, {1, 2, 4}};
  GpuNearLight gpu = gpuNearLight(nearLight(light, 0.5f));
  EXPECT_EQ(gpu.kind, shader_types::kGpuDisk);
  EXPECT_EQ(gpu.axis.y, -1);
  EXPECT_EQ(gpu.radius, 0.5f);
  EXPECT_EQ(gpu.extent, 0.5f);
  EXPECT_EQ(gpu.cosOuter, 0);
  EXPECT_EQ(gpu.inverseRange, 0);
  EXPECT_EQ(gpu.inverseConeWidth, 1);
  EXPECT_NEAR(gpu.colour.y, kPi, 1e-6);
  EXPECT_EQ(gpuNearLight(nearLight(DiskLight{{}, {0, 1, 0}, 1, {1, 1, 1}, true})).cosOuter, -1);
}

TEST(DiskInvariants, NothingComesFromDisksThatAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const Vec3 n{0, 1, 0};
  const DiskLight good{{0, 2, 0}, {0, -1, 0}, 1, {1, 1, 1}};
  const DiskLight none[] = {{{0, 2, 0}, {}, 1, {1, 1, 1}},
                            {{0, 2, 0}, {kNan, -1, 0}, 1, {1, 1, 1}},
                            {{0, 2, 0}, {0, -1, 0}, 0, {1, 1, 1}},
                            {{0, 2, 0}, {0, -1, 0}, -1, {1, 1, 1}},
                            {{0, 2, 0}, {0, -1, 0}, kNan, {1, 1, 1}},
                            {{0, kNan, 0}, {0, -1, 0}, 1, {1, 1, 1}},
                            {{0, kInf, 0}, {0, -1, 0}, 1, {1, 1, 1}},
                            {{0, 2, 0}, {0, -1, 0}, 1, {1, kNan, 1}}};
  for (const float wrap : kWraps) {
    for (const DiskLight& light : none) {
      EXPECT_EQ(exactIrradiance(light, {}, n, wrap).r, 0);
      EXPECT_EQ(nearIrradiance(nearLight(light), {}, n, wrap), Rgb{});
    }
    for (const Vec3 p : {Vec3{kNan, 0, 0}, Vec3{0, -kInf, 0}}) {
      EXPECT_EQ(exactIrradiance(good, p, n, wrap).r, 0);
      EXPECT_EQ(nearIrradiance(nearLight(good), p, n, wrap), Rgb{});
      EXPECT_EQ(correctorIrradiance(nearLight(good), p, n, nearWrap(wrap)), Rgb{});
    }
    EXPECT_EQ(exactIrradiance(good, {}, {kNan, 0, 0}, wrap).r, 0);
    EXPECT_EQ(exactIrradiance(good, {}, {}, wrap).r, 0);
    EXPECT_EQ(nearIrradiance(nearLight(good), {}, {kNan, 0, 0}, wrap), Rgb{});
  }
  EXPECT_EQ(cheapIrradiance(nearLight(good), {}, {kNan, 0, 0}), Rgb{});
}

float hardValue(Random& random) {
  switch (random.index(6)) {
    case 0:
      return 0;
    case 1:
      return (random.index(2) == 0 ? 1.0f : -1.0f) * std::numeric_limits<float>::max();
    case 2: {
      const auto bits = static_cast<std::uint32_t>(random.index(1 << 16)) << 16 | 0x1234u;
      const auto value = std::bit_cast<float>(bits);
      return std::isfinite(value) ? value : 1.0f;
    }
    default:
      return random.uniformf(-2, 2);
  }
}

TEST(DiskInvariants, FiniteAndNotNegativeWhateverComes) {
  Random random(326);
  const int count = test::fullRun() ? 10'000'000 : 100'000;
  long lit = 0;
  for (int k = 0; k < count; ++k) {
    DiskPose pose = test::diskPose(random, anyFamily(random));
    if (k % 2 == 0) {
      pose.light.position = {hardValue(random), hardValue(random), hardValue(random)};
      pose.light.direction = {hardValue(random), hardValue(random), hardValue(random)};
      pose.light.radius = std::abs(hardValue(random));
      pose.p = {hardValue(random), hardValue(random), hardValue(random)};
      if (k % 4 == 0) pose.p[random.index(3)] = pose.light.position[random.index(3)];
    } else if (k % 8 == 1) {
      // In the plane, on the axis, at the centre, on the rim, to the last bit.
      pose.light.direction = {0, 0, 1};
      pose.p = pose.light.position;
      if (random.index(2) == 0) pose.p.x += pose.light.radius;
      if (random.index(2) == 0) pose.p.z = std::nextafter(pose.p.z, 1e30f);
      if (random.index(4) == 0) pose.n = {0, 0, random.index(2) == 0 ? 1.0f : -1.0f};
    }
    const float wrap = kWraps[random.index(5)];
    const NearLight light = nearLight(pose.light);
    const double values[] = {
        exactIrradiance(pose.light, pose.p, pose.n, k % 16 == 0 ? wrap : 0).r,
        nearIrradiance(light, pose.p, pose.n).r,
        nearIrradiance(light, pose.p, pose.n, wrap).r,
        cheapIrradiance(light, pose.p, pose.n).r,
    };
    for (const double value : values) ASSERT_TRUE(value >= 0 && value < 4.3) << describe(pose) << ", wrap " << wrap;
    ASSERT_TRUE(std::abs(correctorIrradiance(light, pose.p, pose.n, nearWrap(wrap)).r) < 4) << describe(pose);
    // Wild directions do not survive being stored as unit floats, and 1e-16 radii from the rim doubles know no better.
    if (k % 2 == 1 && k % 8 != 1) {
      ASSERT_NEAR(values[0], values[1], 4e-6) << describe(pose);
    }
    lit += values[1] > 0 ? 1 : 0;
  }
  EXPECT_GT(lit, count / 4);
}

}  // namespace
}  // namespace rigel
