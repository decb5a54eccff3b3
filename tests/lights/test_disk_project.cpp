// SH of disk lights: the double form against brute force, quadrature in float against the double form, and what must
// hold whatever the numbers.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/project.h>
#include <rigel/sh_rotation.h>

#include <array>

#include "lights/describe.h"
#include "lights/random.h"
#include "lights/rotations.h"
#include "reference/disk_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Random;

// Relative to the norm of the vector.
constexpr double kExactTolerance = 1e-10;   // the reference's own, on the rim; measured 2e-12
constexpr double kFourNodes = 6e-5;         // rim 1e-2 radii away and more: 5.6e-5
constexpr double kFourNodesAtRim = 3.3e-4;  // 1e-3: 3.1e-4
constexpr double kSixNodes = 5e-7;          // 4.1e-7, mostly float's rounding
constexpr double kSixNodesAtRim = 2.5e-6;   // 1.7e-6
constexpr double kEightNodes = 5e-7;        // 3.4e-7: rounding, at the rim too
constexpr double kTurning = 2e-6;           // rounding of the turned vectors: 6e-7
constexpr double kRounding = 1e-6;          // two float computations of the same

struct Pose {
  DiskLight light;
  Vec3 p;
};

std::string describe(const Pose& pose) { return test::describe(pose.light) + ", p " + test::describe(pose.p); }

/// A receiver at distance `rho` from the axis and at `height` (both in radii), anywhere in the world.
Pose placeAt(Random& random, double rho, double height) {
  Pose pose;
  DiskLight& light = pose.light;
  light.radius = static_cast<float>(random.logUniform(1e-6, 1e6));
  light.radiance = {1, 1, 1};
  const Vec3 axis = random.direction();
  light.direction = axis * static_cast<float>(random.logUniform(1e-10, 1e10));
  Vec3 across = cross(axis, random.direction());
  across = across * (1 / length(across));
  const Vec3 offset = axis * static_cast<float>(height) + across * static_cast<float>(rho);
  // One of the two at the origin: what is between them is rounded, not their difference.
  if (random.index(2) == 0) {
    pose.p = offset * light.radius;
  } else {
    light.position = offset * -light.radius;
  }
  return pose;
}

/// A distance and an angle, both of any kind: along the axis, in the plane.
Pose placeAnywhere(Random& random) {
  const double d = random.logUniform(1e-3, 1e4);
  double grazing = std::asin(random.uniform());
  if (random.index(4) == 0) grazing = random.logUniform(1e-5, 1);
  if (random.index(4) == 0) grazing = 0.5 * M_PI - random.logUniform(1e-5, 1);
  return placeAt(random, d * std::cos(grazing), d * std::sin(grazing));
}

Pose placeAtRim(Random& random, double closest) {
  const double gap = random.logUniform(closest, 1);
  const double angle = random.index(4) == 0 ? M_PI - random.logUniform(1e-4, 1) : random.uniform(1e-4, M_PI);
  return placeAt(random, std::abs(1 + gap * std::cos(angle)), gap * std::sin(angle));
}

using Exact = std::array<double, 75>;

Exact exactly(const Pose& pose) {
  Exact q;
  projectDiskExact(pose.light, pose.p, 5, q);
  return q;
}

template <int B>
double relativeError(const RadianceSH<B>& q, const Exact& expected, int channel = 0) {
  double error = 0, norm = 0;
  for (int i = 0; i < shCount(B); ++i) {
    const double wanted = expected[static_cast<std::size_t>(3 * i + channel)];
    error += std::pow(static_cast<double>(q[i][channel]) - wanted, 2);
    norm += wanted * wanted;
  }
  return norm > 0 ? std::sqrt(error / norm) : std::sqrt(error);
}

template <int B>
double relativeError(const RadianceSH<B>& q, const RadianceSH<B>& expected) {
  Exact wide{};
  for (int i = 0; i < shCount(B); ++i) wide[static_cast<std::size_t>(3 * i)] = expected[i].r;
  return relativeError(q, wide);
}

double rimDistance(const Pose& pose) {
  const detail::LocalDisk disk = detail::localDisk(pose.light, pose.p);
  return std::hypot(disk.place.rho - 1, disk.place.z);
}

TEST(ProjectDisk, ExactMatchesBruteForce) {
  Random random(101);
  Worst worst("exact against brute force, d/R 1e-3 to 1e4, rim to 1e-3");
  const int cases = test::fullRun() ? 20000 : 300;
  for (int k = 0; k < cases; ++k) {
    const Pose pose = k % 2 == 0 ? placeAnywhere(random) : placeAtRim(random, 1e-3);
    const Exact q = exactly(pose);
    const std::vector<double> expected = reference::projectDiskReference(pose.light, reference::pointOf(pose.p), 5);
    double error = 0, norm = 0;
    for (std::size_t i = 0; i < 25; ++i) {
      error += std::pow(q[3 * i] - expected[i], 2);
      norm += expected[i] * expected[i];
      ASSERT_EQ(q[3 * i], q[3 * i + 1]);
      ASSERT_EQ(q[3 * i], q[3 * i + 2]);
    }
    worst.add(std::sqrt(error / norm), [&] { return describe(pose); });
  }
  worst.expectWithin(kExactTolerance);
}

TEST(ProjectDisk, ExactOfFewerBandsIsTheStartOfMore) {
  Random random(102);
  const Pose pose = placeAnywhere(random);
  const Exact all = exactly(pose);
  for (int bands = 2; bands < 5; ++bands) {
    std::vector<double> q(static_cast<std::size_t>(3 * shCount(bands)));
    projectDiskExact(pose.light, pose.p, bands, q);
    EXPECT_TRUE(std::equal(q.begin(), q.end(), all.begin())) << bands;
  }
}

/// Worst errors with four, six and eight nodes, 5 and 3 bands.
struct Errors {
  explicit Errors(const std::string& where)
      : four("four nodes, " + where), six("six nodes, " + where), eight("eight nodes, " + where) {}
  Worst four, six, eight;

  void add(const Pose& pose) {
    const Exact expected = exactly(pose);
    const auto text = [&] { return describe(pose); };
    const auto nodes = [&](Worst& worst, DiskNodes n) {
      worst.add(relativeError(projectDisk<5>(pose.light, pose.p, n), expected), text);
      worst.add(relativeError(projectDisk<3>(pose.light, pose.p, n), expected), text);
    };
    nodes(four, DiskNodes::four);
    nodes(six, DiskNodes::six);
    nodes(eight, DiskNodes::eight);
  }
};

TEST(ProjectDisk, QuadratureAtAllDistances) {
  Random random(103);
  Errors errors("d/R 1e-3 to 1e4, rim 1e-2 radii away and more");
  const int cases = test::fullRun() ? 1'000'000 : 20'000;
  for (int k = 0; k < cases; ++k) {
    const Pose pose = k % 2 == 0 ? placeAnywhere(random) : placeAtRim(random, 1e-2);
    if (rimDistance(pose) >= 1e-2) errors.add(pose);
  }
  errors.four.expectWithin(kFourNodes);
  errors.six.expectWithin(kSixNodes);
  errors.eight.expectWithin(kEightNodes);
}

TEST(ProjectDisk, QuadratureAtTheRim) {
  Random random(104);
  Errors errors("rim 1e-3 to 1e-2 radii away");
  const int cases = test::fullRun() ? 500'000 : 10'000;
  for (int k = 0; k < cases; ++k) {
    const Pose pose = placeAtRim(random, 1e-3);
    const double rim = rimDistance(pose);
    if (rim >= 1e-3 && rim <= 1e-2) errors.add(pose);
  }
  errors.four.expectWithin(kFourNodesAtRim);
  errors.six.expectWithin(kSixNodesAtRim);
  errors.eight.expectWithin(kEightNodes);
}

// On the axis the disk looks as the sphere of the same angular size: r = d sin(ax).
TEST(ProjectDisk, OnTheAxisIsASphere) {
  Random random(105);
  Worst worst("disk on its axis against the sphere of its size");
  for (int k = 0; k < 500; ++k) {
    const double height = random.logUniform(1e-3, 1e4);
    const DiskLight disk{{0, 0, static_cast<float>(height)}, {0, 0, -2}, 1, {1, 1, 1}};
    const double d = disk.position.z;
    const SphereLight sphere{disk.position, static_cast<float>(d / std::hypot(1, d)), {1, 1, 1}};
    // The sphere's radius is rounded: relative to it that is worse by (d/r)^2/c of the gap. Away from contact it is
    // not.
    if (d < 0.1) continue;
    worst.add(relativeError(project<5>(disk, {}), project<5>(sphere, {})), [&] { return describe(disk); });
  }
  worst.expectWithin(kRounding);
}

TEST(ProjectDisk, OnTheFaceIsTheHemisphere) {
  Random random(106);
  const SphereLight touching{{0, 0, 1}, 1, {1, 1, 1}};
  const RadianceSH<5> hemisphere = project<5>(touching, {});
  for (int k = 0; k < 200; ++k) {
    const double rho = 0.99 * std::sqrt(random.uniform());
    const float phi = random.uniformf(0, 6.28);
    const Vec3 p{static_cast<float>(rho) * std::cos(phi), static_cast<float>(rho) * std::sin(phi), 0};
    const auto height = static_cast<float>(random.logUniform(1e-30, 1e-9));
    const DiskLight disk{{0, 0, height}, {0, 0, -1}, 1, {1, 1, 1}};
    EXPECT_LE(relativeError(project<5>(disk, p), hemisphere), kRounding) << describe(Pose{disk, p});
  }
}

TEST(ProjectDisk, TurnsWithTheWorld) {
  Random random(107);
  Worst worst("rotated scene against rotated SH");
  for (int k = 0; k < 500; ++k) {
    const Pose pose = k % 2 == 0 ? placeAnywhere(random) : placeAtRim(random, 1e-2);
    // Where rounding the turned vectors is little felt: off the rim and the plane.
    const detail::DiskPlace<double> place = detail::localDisk(pose.light, pose.p).place;
    if (rimDistance(pose) < 0.1 || place.z < 0.1 * std::hypot(place.rho, place.z)) continue;
    const Rotation r = test::randomRotation(random);
    DiskLight turned = pose.light;
    turned.position = test::rotate(r, turned.position);
    turned.direction = test::rotate(r, turned.direction);
    const RadianceSH<5> expected = ShRotation<5>(r)(project<5>(pose.light, pose.p));
    worst.add(relativeError(project<5>(turned, test::rotate(r, pose.p)), expected), [&] { return describe(pose); });
  }
  worst.expectWithin(kTurning);
}

TEST(ProjectDisk, IsLinearInRadiance) {
  Random random(108);
  for (int k = 0; k < 200; ++k) {
    Pose pose = placeAnywhere(random);
    const RadianceSH<5> unit = project<5>(pose.light, pose.p);
    const Exact exactUnit = exactly(pose);
    pose.light.radiance = random.colour() * static_cast<float>(random.logUniform(1e-6, 1e6));
    const RadianceSH<5> coloured = project<5>(pose.light, pose.p);
    const Exact exactColoured = exactly(pose);
    for (int i = 0; i < 25; ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const float colour = pose.light.radiance[channel];
        EXPECT_NEAR(coloured[i][channel], unit[i].r * colour, std::abs(3e-7f * unit[i].r * colour)) << describe(pose);
        const auto at = static_cast<std::size_t>(3 * i);
        EXPECT_NEAR(exactColoured[at + static_cast<std::size_t>(channel)], exactUnit[at] * colour,
                    1e-14 * std::abs(exactUnit[at] * colour));
      }
    }
  }
}

template <int B>
bool isZero(const RadianceSH<B>& sh) {
  return std::all_of(sh.c.begin(), sh.c.end(), [](const Rgb& c) { return c == Rgb{}; });
}

TEST(ProjectDisk, BehindAndInThePlaneIsDark) {
  Random random(109);
  for (int k = 0; k < 200; ++k) {
    Pose pose = placeAnywhere(random);
    pose.light.direction = -pose.light.direction;
    EXPECT_TRUE(isZero(project<5>(pose.light, pose.p))) << describe(pose);
    EXPECT_EQ(exactly(pose), Exact{}) << describe(pose);
  }
  for (const bool twoSided : {false, true}) {
    const DiskLight disk{{0, 2, 0}, {0, -3, 0}, 1, {1, 1, 1}, twoSided};
    for (const float x : {0.0f, 0.5f, 1.0f, 2.0f}) EXPECT_TRUE(isZero(project<5>(disk, {x, 2, 0}))) << x;
  }
}

TEST(ProjectDisk, TwoSidedIsTheSameFromBothSides) {
  Random random(110);
  for (int k = 0; k < 200; ++k) {
    Pose pose = placeAnywhere(random);
    const RadianceSH<5> front = project<5>(pose.light, pose.p);
    pose.light.twoSided = true;
    EXPECT_EQ(project<5>(pose.light, pose.p).c, front.c) << describe(pose);
    pose.light.direction = -pose.light.direction;
    EXPECT_LE(relativeError(project<5>(pose.light, pose.p), front), kRounding) << describe(pose);
  }
}

TEST(ProjectDisk, FewerBandsAreTheStartOfMore) {
  Random random(111);
  for (int k = 0; k < 200; ++k) {
    const Pose pose = placeAnywhere(random);
    const RadianceSH<5> all = project<5>(pose.light, pose.p);
    const auto same = [&](const auto& sh) {
      for (std::size_t i = 0; i < sh.c.size(); ++i) EXPECT_EQ(sh.c[i], all.c[i]) << describe(pose) << ", " << i;
    };
    same(project<2>(pose.light, pose.p));
    same(project<3>(pose.light, pose.p));
    same(project<4>(pose.light, pose.p));
  }
}

// A patch sees a small disk as one of its own size and the same power.
TEST(ProjectDisk, FootprintSpreadsThePower) {
  Random random(112);
  for (int k = 0; k < 200; ++k) {
    const Pose pose = placeAnywhere(random);
    const float footprint = pose.light.radius * random.uniformf(0, 5);
    DiskLight large = pose.light;
    large.radius = std::max(large.radius, footprint);
    const float share = pose.light.radius / large.radius;
    large.radiance = large.radiance * (share * share);
    EXPECT_LE(relativeError(project<5>(pose.light, pose.p, footprint), project<5>(large, pose.p)), kRounding)
        << describe(pose) << ", footprint " << footprint;
  }
}

// Beyond kRigelDiskReach the light is seen from there at equal power: no seam, and a delta's inverse square.
TEST(ProjectDisk, FarAwayIsADelta) {
  const DiskLight disk{{}, {0, 0, 1}, 1e-3f, {1, 1, 1}};
  for (const float d : {900.0f, 999.99f, 1000.01f, 1100.0f, 1e6f, 1e12f}) {
    const RadianceSH<5> q = project<5>(disk, {0.6f * d, 0, 0.8f * d});
    const double expected = M_PI * 1e-6 * 0.8 / d / d;
    EXPECT_NEAR(q[0].r / (expected * 0.28209479177), 1, 1e-6) << d;
    EXPECT_NEAR(q[2].r / (expected * 0.48860251190 * -0.8), 1, 1e-6) << d;
    EXPECT_NEAR(q[3].r / (expected * 0.48860251190 * -0.6), 1, 1e-6) << d;
  }
}

TEST(ProjectDisk, SetsAddTheirDisks) {
  Random random(113);
  LightSet lights;
  const Vec3 p{0.1f, -0.2f, 0.3f};
  RadianceSH<4> sum;
  RadianceShGradient<4> slope;
  for (int k = 0; k < 5; ++k) {
    const DiskLight disk{random.pointInCube(2), random.direction(), 0.5f, random.colour(), true};
    lights.add(disk);
    sum += project<4>(disk, p, 0.7f);
    for (int axis = 0; axis < 3; ++axis) slope.d[axis] += projectWithGradient<4>(disk, p).gradient.d[axis];
  }
  EXPECT_LE(relativeError(project<4>(lights, p, 0.7f), sum), kRounding);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(relativeError(projectWithGradient<4>(lights, p).gradient.d[axis], slope.d[axis]), kRounding);
  }
}

}  // namespace
}  // namespace rigel
