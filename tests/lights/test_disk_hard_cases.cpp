// Disk lights in hard poses, any finite or infinite or NaN input: on the axis, in the plane, on the rim, behind,
// touching, of zero or enormous radius, at scales of 1e-30 to 1e30. SH, gradient and the exact form stay finite, and
// what is not there gives nothing. RIGEL_FULL=1: ten million poses.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/project.h>

#include <array>
#include <cstdint>
#include <limits>

#include "lights/describe.h"
#include "lights/random.h"

namespace rigel {
namespace {

using test::describe;
using test::Random;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();

/// A length in radii that formulas stumble over.
double hardLength(Random& random) {
  switch (random.index(6)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return 1 + random.logUniform(1e-9, 1e-2) * (random.index(2) == 0 ? 1 : -1);
    case 3:
      return random.logUniform(1e-30, 1);
    case 4:
      return random.logUniform(1, 1e30);
    default:
      return random.uniform(0, 3);
  }
}

float hardValue(Random& random) {
  constexpr float kValues[] = {0.0f, -0.0f, 1e-45f, 1e-38f, 1e38f, kLargest, -kLargest, kInfinity, -kInfinity, kNan};
  return kValues[random.index(10)];
}

struct Pose {
  DiskLight light;
  Vec3 p;
};

Pose hardPose(Random& random) {
  Pose pose;
  DiskLight& light = pose.light;
  // Along a coordinate axis what should be zero is zero to the last bit.
  const int axis = random.index(4);
  Vec3 across;
  if (axis < 3) {
    light.direction[axis] = random.index(2) == 0 ? 1.0f : -1.0f;
    across[(axis + 1) % 3] = 1;
  } else {
    light.direction = random.direction();
    across = cross(light.direction, random.direction());
  }
  light.radius = static_cast<float>(random.logUniform(1e-30, 1e30));
  light.radiance = random.colour() * static_cast<float>(random.logUniform(1e-30, 1e30));
  light.twoSided = random.index(2) == 0;
  const float side = random.index(4) == 0 ? -1.0f : 1.0f;
  const Vec3 offset = light.direction * (side * static_cast<float>(hardLength(random)) * light.radius) +
                      across * (static_cast<float>(hardLength(random)) * light.radius);
  if (random.index(2) == 0) light.position = random.pointInCube(1) * light.radius;
  pose.p = light.position + offset;
  if (random.index(8) == 0) light.direction = light.direction * static_cast<float>(random.logUniform(1e-37, 1e37));
  if (random.index(8) == 0) {
    float* const places[] = {&pose.p.x,         &pose.p.y,          &light.position.x,
                             &light.position.z, &light.direction.x, &light.direction.y,
                             &light.radius,     &light.radiance.r,  &light.radiance.b};
    *places[random.index(9)] = hardValue(random);
  }
  return pose;
}

bool allFinite(const float* values, int count) {
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += values[i] * 0.0f;
  return sum == 0;
}

template <int B>
bool isZero(const RadianceSH<B>& sh) {
  for (const Rgb& c : sh.c) {
    if (!(c == Rgb{})) return false;
  }
  return true;
}

bool infinite(Rgb c) { return std::isinf(c.r) || std::isinf(c.g) || std::isinf(c.b); }

/// A NaN anywhere, or an infinite place: nothing must come of it.
bool isNowhere(const Pose& pose) {
  const DiskLight& l = pose.light;
  const auto sum = [](Vec3 v) { return static_cast<double>(v.x) + v.y + v.z; };
  const double place = sum(pose.p) + sum(l.position), direction = sum(l.direction);
  const Rgb c = l.radiance;
  return !(place - place == 0) || !(direction - direction == 0) || c.r != c.r || c.b != c.b || l.radius != l.radius;
}

TEST(DiskHardCases, EveryMethodStaysFinite) {
  Random random(131);
  const int cases = test::fullRun() ? 10'000'000 : 60'000;
  int failures = 0;
  int lit = 0;
  for (int k = 0; k < cases && failures < 5; ++k) {
    const Pose pose = hardPose(random);
    const ProjectionWithGradient<5> both = projectWithGradient<5>(pose.light, pose.p);
    const float footprint = pose.light.radius * random.uniformf(0, 3);
    const RadianceSH<3> patch = projectDisk<3>(pose.light, pose.p, DiskNodes::four, footprint);
    bool holds = allFinite(both.value.data(), 75) && allFinite(patch.data(), 27);
    for (const RadianceSH<5>& slope : both.gradient.d) holds = holds && allFinite(slope.data(), 75);
    if (k % 8 == 0 && !infinite(pose.light.radiance)) {  // which the double form hands on
      std::array<double, 75> exact;
      projectDiskExact(pose.light, pose.p, 5, exact);
      for (const double value : exact) holds = holds && value - value == 0;
    }
    if (isNowhere(pose)) {
      holds = holds && isZero(both.value) && isZero(patch);
      for (const RadianceSH<5>& slope : both.gradient.d) holds = holds && isZero(slope);
    }
    EXPECT_TRUE(holds) << describe(pose.light) << ", p " << describe(pose.p) << ", footprint " << describe(footprint)
                       << "\n  q0 " << describe(both.value[0]) << ", gradient of it " << describe(both.gradient.d[0][0])
                       << describe(both.gradient.d[1][0]) << describe(both.gradient.d[2][0]);
    failures += holds ? 0 : 1;
    lit += isZero(both.value) ? 0 : 1;
  }
  EXPECT_EQ(failures, 0);
  EXPECT_GT(lit, cases / 5);
}

// Energy: radiance 1 gives no more than the hemisphere in band 0, and a vector irradiance of at most pi.
TEST(DiskHardCases, StayWithinTheHemisphere) {
  Random random(132);
  const int cases = test::fullRun() ? 1'000'000 : 20'000;
  int failures = 0;
  for (int k = 0; k < cases && failures < 5; ++k) {
    Pose pose = hardPose(random);
    pose.light.radiance = {1, 1, 1};
    const RadianceSH<2> q = project<2>(pose.light, pose.p);
    const double vector =
        std::hypot(static_cast<double>(q[1].r), static_cast<double>(q[2].r), static_cast<double>(q[3].r));
    const bool holds =
        q[0].r >= 0 && q[0].r <= 2 * kPi * kRigelY00 * (1 + 1e-6) && vector <= kPi * kRigelY1 * (1 + 1e-6);
    EXPECT_TRUE(holds) << describe(pose.light) << ", p " << describe(pose.p) << ": " << describe(q[0].r) << ", "
                       << describe(vector);
    failures += holds ? 0 : 1;
  }
  EXPECT_EQ(failures, 0);
}

TEST(DiskHardCases, WithoutRadiusDirectionOrPlaceIsDark) {
  const DiskLight disk{{0, 2, 0}, {0, -1, 0}, 1, {1, 2, 3}, true};
  const auto dark = [](const DiskLight& light, Vec3 p) {
    std::array<double, 75> exact;
    projectDiskExact(light, p, 5, exact);
    return isZero(project<5>(light, p)) && isZero(projectWithGradient<3>(light, p).gradient.d[1]) &&
           exact == std::array<double, 75>{};
  };
  EXPECT_FALSE(dark(disk, {}));
  for (const float radius : {0.0f, -1.0f, kNan}) {
    DiskLight light = disk;
    light.radius = radius;
    EXPECT_TRUE(dark(light, {})) << radius;
  }
  for (const Vec3 direction : {Vec3{}, Vec3{kNan, 1, 0}, Vec3{kInfinity, 0, 0}}) {
    DiskLight light = disk;
    light.direction = direction;
    EXPECT_TRUE(dark(light, {})) << describe(direction);
  }
  for (const Vec3 p : {Vec3{kNan, 0, 0}, Vec3{0, kInfinity, 0}, Vec3{0, 0, -kInfinity}}) {
    EXPECT_TRUE(dark(disk, p)) << describe(p);
    DiskLight light = disk;
    light.position = p;
    EXPECT_TRUE(dark(light, {})) << describe(p);
  }
}

// An infinite disk is a plane: the hemisphere, from any distance.
TEST(DiskHardCases, InfiniteRadiusIsAHemisphere) {
  const RadianceSH<3> q = project<3>(DiskLight{{0, 2, 0}, {0, -1, 0}, kInfinity, {1, 1, 1}}, {3, 0, 1});
  EXPECT_NEAR(q[0].r, 2 * kPi * kRigelY00, 1e-6);
  EXPECT_NEAR(q[1].r, kPi * kRigelY1, 1e-6);
}

}  // namespace
}  // namespace rigel
