// Irradiance of a light's first bands in double, against 50 digits (disks: brute force in double), relative to pi
// ||q||.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/exact_bands.h>
#include <rigel/project.h>

#include <limits>

#include "lights/compare_sh.h"
#include "lights/lights_for_reference.h"
#include "reference/disk_reference.h"
#include "reference/sh_reference.h"
#include "reference/worst.h"
#include "reference/wrap_reference.h"

namespace rigel {
namespace {

using reference::Real50;
using reference::Worst;
using test::describe;
using test::Placement;
using test::Random;

// Worst measured 3.5e-15, of a spot: its cone steepens the rounding of the cosine.
constexpr double kTolerance = 2e-14;
constexpr double kDiskTolerance = 1e-12;  // worst measured 4.7e-16, off the rim; both are quadratures
constexpr float kWraps[] = {-0.25f, 0, 0.3f, 1};

/// pi sum f_l sum q_lm Y_lm(n) and pi ||q||, of bands^2 coefficients.
struct Expected {
  double value = 0, size = 0;

  template <class Coefficients>
  Expected(const Coefficients& q, Vec3 n, float wrap, int bands) {
    const reference::Vec50 normal = reference::exactly(n);
    const reference::Vec50 unit = normal * (1 / length(normal));
    Real50 sum = 0, squares = 0;
    for (int l = 0; l < bands; ++l) {
      const Real50 f = reference::wrapCoefficientReference(l, static_cast<double>(wrap));
      for (int m = -l; m <= l; ++m) {
        const Real50 c = q[static_cast<std::size_t>(shIndex(l, m))];
        sum += f * c * reference::shReference(l, m, unit);
        squares += c * c;
      }
    }
    value = kPi * static_cast<double>(sum);
    size = kPi * static_cast<double>(sqrt(squares));
  }
};

template <class Light, class Coefficients>
void compare(Worst& worst, const Light& light, const Coefficients& q, Vec3 p, Vec3 n, float wrap, int bands) {
  const Expected expected(q, n, wrap, bands);
  if (!(expected.size > 0)) return;
  const double actual = exactBandIrradiance(light, p, n, wrap, bands).r;
  worst.add(std::abs(actual - expected.value) / expected.size, [&] {
    return describe(light) + ", p " + describe(p) + ", n " + describe(n) + ", wrap " + describe(wrap) + ", bands " +
           std::to_string(bands) + ": " + describe(actual) + ", expected " + describe(expected.value);
  });
}

TEST(ExactBands, LocalLights) {
  Random random(71);
  Worst worst("irradiance of bands, spheres, points, spots");
  const auto check = [&](const auto& light, Vec3 p, int k) {
    const int bands = kMinBands + k % 4;
    compare(worst, light, reference::projectReference(light, reference::exactly(p), bands), p,
            random.direction() * 0.7f, kWraps[k / 4 % 4], bands);
  };
  for (int k = 0; k < 160; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e3));
    check(test::sphereAt(at, test::hardRatio(random)), at.receiver, k);
    check(test::pointAt(random, at, test::hardRatio(random)), at.receiver, k);
    check(test::spotAt(random, at, random.uniform(0.001, 0.9)), at.receiver, k);
  }
  worst.expectWithin(kTolerance);
}

TEST(ExactBands, DirectionalLights) {
  Random random(72);
  Worst worst("irradiance of bands, directional");
  for (int k = 0; k < 64; ++k) {
    const DirectionalLight light{random.direction() * 3.0f, {1, 1, 1}};
    compare(worst, light, reference::projectReference(light, {}, 5), {}, random.direction(), kWraps[k % 4],
            2 + k / 4 % 4);
  }
  worst.expectWithin(kTolerance);
}

TEST(ExactBands, Disks) {
  Random random(73);
  Worst worst("irradiance of bands, disks");
  for (int k = 0; k < 48; ++k) {
    const Placement at = test::place(random, random.logUniform(0.1, 10));
    const DiskLight light{at.centre, random.direction(), random.uniformf(0.2, 2), {1, 1, 1}, k % 3 == 0};
    compare(worst, light, reference::projectDiskReference(light, reference::pointOf(at.receiver), 5), at.receiver,
            random.direction(), kWraps[k % 4], 2 + k / 4 % 4);
  }
  worst.expectWithin(kDiskTolerance);
}

TEST(ExactBands, AllBandsOfHalfLambertAreThree) {
  Random random(74);
  Worst worst("half-Lambert");
  for (int k = 0; k < 200; ++k) {
    const Placement at = test::place(random, 1);
    const SphereLight light = test::sphereAt(at, test::hardRatio(random));
    const Vec3 n = random.direction();
    const double exact = exactIrradiance(light, at.receiver, n, 1).r;
    const double peak = std::max(exact, exactIrradiance(light, at.receiver, at.centre - at.receiver, 1).r);
    worst.add(std::abs(exactBandIrradiance(light, at.receiver, n, 1, 3).r - exact) / peak,
              [&] { return describe(light) + ", n " + describe(n); });
  }
  worst.expectWithin(kTolerance);
}

TEST(ExactBands, NothingWhereNoLightArrives) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto dark = [](const auto& light, Vec3 p, Vec3 n) {
    const RgbD e = exactBandIrradiance(light, p, n, 0.3f, 3);
    EXPECT_EQ(e.r, 0);
    EXPECT_EQ(e.g, 0);
    EXPECT_EQ(e.b, 0);
  };
  dark(SphereLight{{1, 0, 0}, 0, {1, 1, 1}}, {}, {1, 0, 0});
  dark(SphereLight{{1, 0, 0}, 1, {kNan, 1, 1}}, {}, {1, 0, 0});
  dark(SphereLight{{1, 0, 0}, 1, {1, 1, 1}}, {}, {});
  dark(PointLight{{1, 0, 0}, {1, 1, 1}, 0.01f, 0.5f}, {}, {1, 0, 0});
  dark(SpotLight{{1, 0, 0}, {1, 0, 0}, {1, 1, 1}, 0, 0.5f}, {}, {1, 0, 0});
  dark(DirectionalLight{{}, {1, 1, 1}}, {}, {1, 0, 0});
  dark(DiskLight{{1, 0, 0}, {1, 0, 0}, 1, {1, 1, 1}, false}, {}, {1, 0, 0});
  dark(DiskLight{{1, 0, 0}, {-1, 0, 0}, 1, {1, 1, 1}, false}, {kNan, 0, 0}, {1, 0, 0});
}

}  // namespace
}  // namespace rigel
