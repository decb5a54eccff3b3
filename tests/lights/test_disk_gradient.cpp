// Analytic spatial gradients of disk lights against differences of the brute-force projection.
#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/project.h>

#include <array>
#include <utility>

#include "lights/describe.h"
#include "lights/random.h"
#include "reference/disk_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Random;

// Of the largest component.
constexpr double kTolerance = 4e-6;      // the slope of what six nodes leave: 2.1e-6, at the rim too
constexpr double kAxisTolerance = 5e-7;  // 1.6e-7: kMinRho of disk_gradient.cpp, and float
constexpr int kCount = 25;

using Gradient = std::array<std::vector<double>, 3>;

/// Five-point differences; `step` a few thousandths of the distance to the rim and the plane, and of the distance.
Gradient differences(const DiskLight& light, Vec3 p, double step) {
  Gradient out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out[axis].resize(kCount);
    for (const auto& [k, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      reference::Point at = reference::pointOf(p);
      at[axis] += k * step;
      const std::vector<double> q = reference::projectDiskReference(light, at, 5);
      for (std::size_t i = 0; i < kCount; ++i) out[axis][i] += weight / (12 * step) * q[i];
    }
  }
  return out;
}

void compare(Worst& worst, const DiskLight& light, Vec3 p) {
  const detail::DiskPlace<double> place = detail::localDisk(light, p).place;
  const double rim = std::hypot(place.rho - 1, place.z);
  const double distance = std::hypot(place.rho, place.z);
  const double near = std::min({rim, place.z, std::max(1.0, 0.1 * distance)});
  const Gradient expected = differences(light, p, 4e-3 * near * static_cast<double>(light.radius));
  const double held = std::min(1.0, place.z / distance / static_cast<double>(kMinGradientSine));
  const ProjectionWithGradient<5> actual = projectWithGradient<5>(light, p);
  double largest = 0;
  for (const auto& slope : expected) {
    for (const double x : slope) largest = std::max(largest, std::abs(x));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const double value = actual.gradient.d[axis][static_cast<int>(i)].g;
      worst.add(std::abs(value - held * expected[axis][i]) / largest, [&] {
        return describe(light) + ", p " + describe(p) + ", rho " + describe(place.rho) + ", z " + describe(place.z) +
               ", axis " + std::to_string(axis) + ", coefficient " + std::to_string(i) + ": " + describe(value) +
               ", expected " + describe(expected[axis][i]) + ", largest " + describe(largest);
      });
    }
  }
}

/// A disk at the origin and a receiver at (rho, height) radii, turned anyhow.
struct Pose {
  DiskLight light;
  Vec3 p;
};

Pose placeAt(Random& random, double rho, double height) {
  Pose pose;
  pose.light = {{}, random.direction(), static_cast<float>(random.logUniform(1e-3, 1e3)), {1, 1, 1}, true};
  Vec3 across = cross(pose.light.direction, random.direction());
  across = across * (1 / length(across));
  const float side = random.index(2) == 0 ? -1.0f : 1.0f;
  pose.p = (pose.light.direction * (side * static_cast<float>(height)) + across * static_cast<float>(rho)) *
           pose.light.radius;
  return pose;
}

TEST(ProjectDiskGradient, MatchesDifferences) {
  Random random(121);
  Worst worst("gradient of a disk, d/R 0.1 to 1e3, rim 0.1 radii away and more");
  for (int k = 0; k < 50; ++k) {
    const double d = random.logUniform(0.1, 1e3);
    const double angle = std::asin(random.uniform(0.02, 1));
    const double rho = d * std::cos(angle), z = d * std::sin(angle);
    if (std::hypot(rho - 1, z) < 0.1) continue;
    const Pose pose = placeAt(random, rho, z);
    compare(worst, pose.light, pose.p);
  }
  worst.expectWithin(kTolerance);
}

TEST(ProjectDiskGradient, MatchesDifferencesAtTheRim) {
  Random random(122);
  Worst worst("gradient of a disk, rim 1e-2 to 0.1 radii away");
  for (int k = 0; k < 20; ++k) {
    const double gap = random.logUniform(1.02e-2, 0.1);
    const double angle = random.uniform(0.1, M_PI - 0.1);
    const Pose pose = placeAt(random, 1 + gap * std::cos(angle), gap * std::sin(angle));
    compare(worst, pose.light, pose.p);
  }
  worst.expectWithin(kTolerance);
}

TEST(ProjectDiskGradient, MatchesDifferencesOnTheAxis) {
  Worst worst("gradient of a disk on and next to its axis");
  for (const float z : {0.02f, 0.3f, 1.0f, 20.0f}) {
    for (const float rho : {0.0f, 1e-12f, 1e-9f, 1e-6f, 1e-4f, 1e-2f}) {
      compare(worst, {{}, {0, 0, 1}, 1, {1, 1, 1}}, {0.6f * rho, 0.8f * rho, z});
      compare(worst, {{}, {0, -3, 0}, 1, {1, 1, 1}}, {rho, -z, 0});
    }
  }
  worst.expectWithin(kAxisTolerance);
}

TEST(ProjectDiskGradient, ValueIsThatOfProject) {
  Random random(123);
  for (int k = 0; k < 200; ++k) {
    const Pose pose = placeAt(random, random.logUniform(1e-3, 1e3), random.logUniform(1e-3, 1e3));
    EXPECT_EQ(projectWithGradient<3>(pose.light, pose.p).value.c, project<3>(pose.light, pose.p).c);
  }
}

// On the face, in the plane and on the rim the slope is finite and no larger than the hold at the rim lets it be.
TEST(ProjectDiskGradient, StaysBoundedAtFaceAndRim) {
  const DiskLight disk{{}, {0, 0, 1}, 1, {1, 1, 1}};
  const double most = kPi / static_cast<double>(kMinGradientRim);
  for (const float z : {1e-38f, 1e-20f, 1e-9f, 1e-4f, 1e-2f}) {
    for (const float rho : {0.0f, 0.5f, 0.9999999f, 1.0f, 1.0000001f, 1.001f, 3.0f, 1e9f}) {
      const ProjectionWithGradient<5> both = projectWithGradient<5>(disk, {rho, 0, z});
      for (const RadianceSH<5>& slope : both.gradient.d) {
        for (const Rgb& c : slope.c) EXPECT_LE(std::abs(c.r), most) << "rho " << rho << ", z " << z;
      }
    }
  }
}

TEST(ProjectDiskGradient, BehindHasNone) {
  const ProjectionWithGradient<5> both = projectWithGradient<5>(DiskLight{{}, {0, 0, 1}, 1, {1, 1, 1}}, {0.5f, 0, -1});
  for (const RadianceSH<5>& slope : both.gradient.d) {
    for (const Rgb& c : slope.c) EXPECT_EQ(c, Rgb{});
  }
}

}  // namespace
}  // namespace rigel
