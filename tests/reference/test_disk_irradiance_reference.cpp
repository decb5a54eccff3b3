#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lights/random.h"
#include "reference/disk_irradiance_reference.h"
#include "reference/worst.h"

namespace rigel::reference {
namespace {

std::string describe(double value) { return std::to_string(value); }
std::string describe(Vec3 v) {
  const auto text = [](float x) { return std::to_string(static_cast<double>(x)); };
  return "(" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ")";
}

constexpr double kTolerance = 1e-9;     // of the peak
constexpr double kRayTolerance = 5e-6;  // of the peak: 200,000 rays, half a radius off and more; worst 8e-7

DiskLight unitDisk() { return {{}, {0, 0, 1}, 1, {1, 1, 1}, false}; }

TEST(DiskIrradianceReference, OnTheAxisIsTheTextbookForm) {
  // pi R^2/(R^2+z^2) facing the disk, and where its centre stands at the horizon half the cap's clipped value.
  Worst worst("reference on the axis, Lambert");
  for (const float z : {1e-3f, 0.1f, 1.0f, 10.0f}) {
    const double s2 = 1 / (1 + static_cast<double>(z) * static_cast<double>(z));
    const auto add = [&](double actual, double expected) {
      worst.add(std::abs(actual - expected) / (M_PI * s2), [&] { return "z " + std::to_string(z); });
    };
    add(diskIrradianceReference(unitDisk(), {0, 0, z}, {0, 0, -1}, 0), M_PI * s2);
    add(diskIrradianceReference(unitDisk(), {0, 0, z}, {0, 0, 1}, 0), 0);
    add(diskIrradianceReference(unitDisk(), {0, 0, z}, {1, 0, 0}, 0),
        std::asin(std::sqrt(s2)) - std::sqrt(s2 * (1 - s2)));
    add(diskIrradianceReference(unitDisk(), {0, 0, z}, {0.6f, 0, -0.8f}, 0) -
            diskIrradianceReference(unitDisk(), {0, 0, z}, {-0.6f, 0, 0.8f}, 0),
        M_PI * s2 * 0.8);
  }
  worst.expectWithin(1e-7);  // the normals' float components
}

TEST(DiskIrradianceReference, OnTheFaceIsTheHemisphere) {
  Worst worst("reference a millionth above the face, against the hemisphere");
  for (const double a : {-0.25, 0.0, 0.5, 1.0}) {
    const double facing = diskIrradianceReference(unitDisk(), {0.3f, 0, 1e-7f}, {0, 0, -1}, a);
    const double away = diskIrradianceReference(unitDisk(), {0.3f, 0, 1e-7f}, {0, 0, 1}, a);
    worst.add(std::abs(facing + away - M_PI * 2 * (1 + a) / (2 + a)) / M_PI, [&] { return "a " + describe(a); });
  }
  worst.expectWithin(1e-6);
}

TEST(DiskIrradianceReference, MatchesRays) {
  test::Random random(51);
  Worst worst("reference against 200,000 rays");
  for (const double a : {-0.25, 0.0, 0.5, 1.0}) {
    for (int k = 0; k < 4; ++k) {
      DiskLight light{random.pointInCube(1), random.direction(), random.uniformf(0.5, 2), {1, 1, 1}, k % 2 == 0};
      const Vec3 p =
          light.position + (light.direction * random.uniformf(0.5, 2) + random.direction() * 0.4f) * light.radius;
      const Vec3 n = random.direction();
      const double expected = diskIrradianceByRays(light, p, n, a, 200'000);
      const double peak = diskIrradianceByRays(light, p, light.position - p, a, 1000);
      worst.add(std::abs(diskIrradianceReference(light, p, n, a) - expected) / peak, [&] {
        return describe(light.position) + " " + describe(light.direction) + ", p " + describe(p) + ", n " +
               describe(n) + ", a " + describe(a);
      });
    }
  }
  worst.expectWithin(kRayTolerance);
}

TEST(DiskIrradianceReference, BehindAndInThePlaneIsDark) {
  DiskLight light = unitDisk();
  EXPECT_EQ(diskIrradianceReference(light, {0.2f, 0, -1}, {0, 0, 1}, 0), 0);
  EXPECT_EQ(diskIrradianceReference(light, {0.2f, 0, 0}, {0, 0, 1}, 0), 0);
  light.twoSided = true;
  EXPECT_NEAR(diskIrradianceReference(light, {0.2f, 0, -1}, {0, 0, 1}, 0),
              diskIrradianceReference(light, {0.2f, 0, 1}, {0, 0, -1}, 0), kTolerance);
}

}  // namespace
}  // namespace rigel::reference
