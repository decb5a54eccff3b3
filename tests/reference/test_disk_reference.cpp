#include <gtest/gtest.h>

#include "lights/random.h"
#include "reference/disk_reference.h"
#include "reference/sh_reference.h"
#include "reference/worst.h"

namespace rigel::reference {
namespace {

constexpr int kBands = 5;
constexpr double kPatchTolerance = 6e-5;  // 100 rings, half a radius above the face and more
constexpr double kRounding = 1e-13;

double norm(const std::vector<double>& q) {
  double sum = 0;
  for (const double x : q) sum += x * x;
  return std::sqrt(sum);
}

double relative(const std::vector<double>& q, const std::vector<double>& expected) {
  std::vector<double> difference = q;
  for (std::size_t i = 0; i < q.size(); ++i) difference[i] -= expected[i];
  return norm(difference) / norm(expected);
}

/// A disk of radius 1 at the origin facing +z, seen from (rho, 0, z).
std::vector<double> project(double rho, double z, bool twoSided = false) {
  return projectDiskReference({{}, {0, 0, 1}, 1, {1, 1, 1}, twoSided}, {rho, 0, z}, kBands);
}

TEST(DiskReference, MatchesThePatchesOfTheDisk) {
  test::Random random(91);
  Worst worst("adaptive quadrature against patches");
  for (int k = 0; k < 12; ++k) {
    const DiskLight light{{1, 2, 3}, random.direction() * 3.0f, random.uniformf(0.1, 2), {1, 1, 1}, true};
    const Vec3 direction = random.direction();
    const double d = random.uniform(0.5, 10) * light.radius;
    const Point p{1 + d * direction.x, 2 + d * direction.y, 3 + d * direction.z};
    const double height = d * std::abs(dot(direction, light.direction)) / 3 / light.radius;
    if (height < 0.5) continue;
    worst.add(relative(projectDiskPatches(light, p, kBands, 100), projectDiskReference(light, p, kBands)),
              [&] { return std::to_string(d) + " m, height " + std::to_string(height) + " radii"; });
  }
  worst.expectWithin(kPatchTolerance);
}

// The basis is that of sh_reference: a tiny disk is a delta.
TEST(DiskReference, SmallDiskIsADelta) {
  const DiskLight light{{}, {0, 0, 1}, 1e-5f, {1, 1, 1}};
  const Point p{2, 3, 6};
  const double area = M_PI * 1e-10;
  const std::vector<double> q = projectDiskReference(light, p, kBands);
  const Vec50 w{Real50(-2) / 7, Real50(-3) / 7, Real50(-6) / 7};
  for (int l = 0; l < kBands; ++l) {
    for (int m = -l; m <= l; ++m) {
      const auto y = static_cast<double>(shReference(l, m, w));
      EXPECT_NEAR(q[static_cast<std::size_t>(l * (l + 1) + m)] / (area * 6 / 343), y, 1e-6) << l << ", " << m;
    }
  }
}

// On the axis the disk is a cap: solid angle and vector irradiance in closed form.
TEST(DiskReference, OnTheAxisIsACap) {
  for (const double z : {1e-9, 1e-3, 0.1, 1.0, 10.0, 1e3}) {
    const std::vector<double> q = project(0, z);
    const double c = z / std::hypot(1, z);
    EXPECT_NEAR(q[0] / (2 * M_PI / (1 + c) / (1 + z * z) * std::sqrt(0.25 / M_PI)), 1, kRounding) << z;
    EXPECT_NEAR(q[2] / (-M_PI / (1 + z * z) * std::sqrt(0.75 / M_PI)), 1, kRounding) << z;
    EXPECT_NEAR(q[6], M_PI / (1 + z * z) * std::sqrt(1.25 / M_PI) * c, kRounding * norm(q)) << z;
  }
}

// The vector irradiance off the axis: what falls on the plane of the disk (Naraghi's form factor).
TEST(DiskReference, IrradianceOfAParallelPlane) {
  for (const double rho : {0.2, 0.999, 1.0, 1.001, 3.0, 100.0}) {
    for (const double z : {1e-4, 1e-2, 1.0, 30.0}) {
      const double product = std::hypot(rho + 1, z) * std::hypot(rho - 1, z);
      const double expected = 0.5 * M_PI * (1 - ((rho - 1) * (rho + 1) + z * z) / product);
      const double actual = -project(rho, z)[2] / std::sqrt(0.75 / M_PI);
      EXPECT_NEAR(actual, expected, kRounding) << rho << ", " << z;
    }
  }
}

TEST(DiskReference, ContactIsAHemisphereAndThePlaneIsDark) {
  EXPECT_NEAR(project(0.5, 1e-12)[0], 2 * M_PI * std::sqrt(0.25 / M_PI), 1e-11);
  EXPECT_EQ(norm(project(0.5, 0)), 0);
  EXPECT_EQ(norm(project(0.5, -1)), 0);
  const std::vector<double> front = project(0.5, 1), back = project(0.5, -1, true);
  for (int l = 0; l < kBands; ++l) {
    for (int m = -l; m <= l; ++m) {
      const auto i = static_cast<std::size_t>(l * (l + 1) + m);
      EXPECT_NEAR(back[i], (l + m) % 2 == 0 ? front[i] : -front[i], 1e-14) << l << ", " << m;
    }
  }
}

}  // namespace
}  // namespace rigel::reference
