// Exact irradiance against brute force, relative to its peak over normals.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/project.h>
#include <rigel/wrap.h>

#include <limits>

#include "lights/describe.h"
#include "lights/lights_for_reference.h"
#include "lights/rotations.h"
#include "reference/irradiance_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Placement;
using test::Random;

// The issue asks for 1e-6; what exact.h promises for itself.
constexpr double kTolerance = 1e-8;

constexpr float kWraps[] = {-0.25f, -0.1f, 0, 0.2f, 0.5f, 0.9f, 1};

/// Angles of the cap a sphere fills, in long double from the float inputs.
struct CapAngles {
  double alpha = 0;
  double normalAngle = 0;
  double peak = 0;  // pi min(1, (r/d)^2)
};

CapAngles capAngles(const SphereLight& light, Vec3 p, Vec3 n) {
  using Wide = long double;
  const Wide d[3] = {Wide(light.position.x) - p.x, Wide(light.position.y) - p.y, Wide(light.position.z) - p.z};
  const Wide m[3] = {n.x, n.y, n.z};
  const Wide d2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const Wide r2 = Wide(light.radius) * light.radius;
  const Wide cross[3] = {m[1] * d[2] - m[2] * d[1], m[2] * d[0] - m[0] * d[2], m[0] * d[1] - m[1] * d[0]};
  const Wide sine = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
  CapAngles out;
  out.normalAngle = static_cast<double>(std::atan2(sine, m[0] * d[0] + m[1] * d[1] + m[2] * d[2]));
  out.alpha = static_cast<double>(d2 >= r2 ? std::atan2(std::sqrt(r2), std::sqrt(d2 - r2))
                                           : Wide(M_PIl) - std::atan2(std::sqrt(d2), std::sqrt(r2 - d2)));
  out.peak = static_cast<double>(Wide(M_PIl) * std::min(Wide(1), r2 / d2));
  return out;
}

void compare(Worst& worst, const SphereLight& light, Vec3 p, Vec3 n, float wrap) {
  const CapAngles angles = capAngles(light, p, n);
  const double expected = reference::capIrradianceReference(angles.alpha, angles.normalAngle, wrap);
  const double actual = exactIrradiance(light, p, n, wrap).r;
  worst.add(std::abs(actual - expected) / angles.peak, [&] {
    return describe(light) + ", p " + describe(p) + ", n " + describe(n) + ", wrap " + describe(wrap) + ": " +
           describe(actual) + ", expected " + describe(expected) + ", peak " + describe(angles.peak) + ", alpha " +
           describe(angles.alpha) + ", angle to the normal " + describe(angles.normalAngle);
  });
}

/// A normal that makes about `angle` with the direction from receiver to light.
Vec3 normalAt(Random& random, const Placement& at, double angle) {
  const Vec3 w = (at.centre - at.receiver) * static_cast<float>(1 / at.distance);
  Vec3 side = cross(w, random.direction());
  side = side * (1 / length(side));
  return w * static_cast<float>(std::cos(angle)) + side * static_cast<float>(std::sin(angle));
}

TEST(Exact, SphereAnywhere) {
  Random random(61);
  Worst worst("exact irradiance, random spheres and normals");
  for (const float wrap : kWraps) {
    for (int k = 0; k < 150; ++k) {
      const Placement at = test::place(random, random.logUniform(1e-6, 1e6));
      compare(worst, test::sphereAt(at, random.logUniform(1e-3, 1)), at.receiver, random.direction(), wrap);
    }
  }
  worst.expectWithin(kTolerance);
}

// The kernel's horizon (cos = -a) passes through the light: the case closed forms and quadratures fail at.
TEST(Exact, SphereCrossingTheHorizon) {
  Random random(62);
  Worst worst("exact irradiance, sphere crossing the horizon");
  for (const float wrap : kWraps) {
    for (int k = 0; k < 150; ++k) {
      const Placement at = test::place(random, 3);
      const SphereLight light = test::sphereAt(at, k % 3 == 0 ? random.uniform(0.8, 1) : random.logUniform(1e-4, 1));
      const double alpha = std::asin(static_cast<double>(light.radius) / at.distance);
      const double edge = k % 10 == 0 ? 1 : random.uniform(-1, 1);
      const double angle = std::min(M_PI, std::acos(-static_cast<double>(wrap)) + alpha * edge);
      compare(worst, light, at.receiver, normalAt(random, at, angle), wrap);
    }
  }
  worst.expectWithin(kTolerance);
}

// The normal on the rim of the light, where the circles about it change from whole to cut.
TEST(Exact, NormalOnTheRim) {
  Random random(63);
  Worst worst("exact irradiance, normal on or near the rim, and its antipode");
  for (const float wrap : kWraps) {
    for (const double gap : {0.0, 1e-9, 1e-6, 1e-3, 0.05, -1e-6, -1e-3, -0.05}) {
      for (const double ratio : {1e-3, 0.1, 0.5, 0.9, 0.999, 1.0}) {
        const Placement at = test::place(random, 3);
        const SphereLight light = test::sphereAt(at, ratio);
        const double alpha = std::asin(static_cast<double>(light.radius) / at.distance);
        compare(worst, light, at.receiver, normalAt(random, at, alpha + gap), wrap);
        compare(worst, light, at.receiver, normalAt(random, at, M_PI - alpha + gap), wrap);
      }
    }
  }
  worst.expectWithin(kTolerance);
}

// Two sums of a quadrature may agree by chance: these once did, 1e-6 and 1e-5 off.
TEST(Exact, CoarseSumsThatAgreeByChance) {
  Worst worst("exact irradiance, known hard integrands");
  compare(worst, {{-0.20561114f, -0.806315422f, 0.55459851f}, 0.666403592f, {1, 1, 1}}, {},
          {0.767854333f, -0.526303887f, 0.365245014f}, 0.267246f);
  compare(worst, {{-0.276670158f, -0.361302584f, 0.890457213f}, 1.08572483f, {1, 1, 1}}, {},
          {-0.832438946f, 0.222969234f, -0.507277191f}, 0.987221f);
  worst.expectWithin(kTolerance);
}

TEST(Exact, InsideAndTouching) {
  Random random(64);
  Worst worst("exact irradiance, inside and touching");
  for (const float wrap : kWraps) {
    for (int k = 0; k < 100; ++k) {
      const Placement at = test::place(random, 3);
      SphereLight light = test::sphereAt(at, 1);
      if (k % 2 == 0) light.radius = static_cast<float>(at.distance * random.logUniform(1, 1e6));
      if (k % 4 == 1) light.radius = std::nextafter(light.radius, 1e9f);
      compare(worst, light, at.receiver, random.direction(), wrap);
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(Exact, TinyLights) {
  Random random(65);
  Worst worst("exact irradiance, half-angle 1e-10 to 1e-3");
  for (const float wrap : kWraps) {
    for (int k = 0; k < 100; ++k) {
      const Placement at = test::place(random, random.logUniform(1e-3, 1e3));
      const double ratio = random.logUniform(1e-10, 1e-3);
      const double horizon = std::acos(-static_cast<double>(wrap));
      const double angle = k % 2 == 0 ? random.uniform(0, horizon) : horizon + ratio * random.uniform(-2, 2);
      compare(worst, test::sphereAt(at, ratio), at.receiver, normalAt(random, at, angle), wrap);
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(Exact, LambertAboveTheHorizonIsTheTextbookForm) {
  // pi L (r/d)^2 cos(angle): light at distance 2 straight above, radius 1.
  const SphereLight light{{0, 2, 0}, 1, {1, 2, 4}};
  const RgbD up = exactIrradiance(light, {}, {0, 1, 0});
  EXPECT_NEAR(up.r, kPi / 4, 1e-15);
  EXPECT_NEAR(up.g, kPi / 2, 1e-15);
  EXPECT_NEAR(up.b, kPi, 1e-14);
  EXPECT_EQ(exactIrradiance(light, {}, {0, -1, 0}).r, 0);
}

TEST(Exact, ContinuousInWrapAtTheClosedForms) {
  // a = 0 and a = 1 take other paths than their neighbours.
  Random random(66);
  for (int k = 0; k < 100; ++k) {
    const SphereLight light{random.pointInCube(2), random.uniformf(0.01, 1.5), {1, 1, 1}};
    const Vec3 n = random.direction();
    const double lambert = exactIrradiance(light, {}, n, 0).r;
    const double half = exactIrradiance(light, {}, n, 1).r;
    EXPECT_NEAR(exactIrradiance(light, {}, n, 1e-6f).r, lambert, 1e-4) << describe(light) << ", n " << describe(n);
    EXPECT_NEAR(exactIrradiance(light, {}, n, -1e-6f).r, lambert, 1e-4) << describe(light) << ", n " << describe(n);
    EXPECT_NEAR(exactIrradiance(light, {}, n, 0.999999f).r, half, 1e-4) << describe(light) << ", n " << describe(n);
  }
}

TEST(Exact, LengthOfTheNormalDoesNotMatter) {
  const SphereLight light{{1, 2, 0.5f}, 0.7f, {1, 1, 1}};
  for (const float wrap : {0.0f, 0.5f, 1.0f}) {
    const double unit = exactIrradiance(light, {}, {0.6f, 0.8f, 0}, wrap).r;
    for (const float scale : {1e-30f, 0.5f, 2.0f, 1e30f}) {
      EXPECT_NEAR(exactIrradiance(light, {}, Vec3{0.6f, 0.8f, 0} * scale, wrap).r, unit, 1e-6 * unit) << scale;
    }
    EXPECT_EQ(exactIrradiance(light, {}, {0, 0, 0}, wrap).r, 0);
    EXPECT_EQ(exactIrradiance(light, {}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}, wrap).r, 0);
  }
}

TEST(Exact, PointAndSpotAreSpheresTimesTheirModulation) {
  Random random(67);
  Worst worst("point and spot against the scaled sphere, relative");
  for (int k = 0; k < 300; ++k) {
    const Placement at = test::place(random, random.logUniform(0.1, 10));
    const SpotLight spot = test::spotAt(random, at, random.uniform(0.01, 1.5));
    const PointLight point{spot.position, spot.intensity, spot.radius, spot.range};
    const SphereLight sphere{spot.position, spot.radius, {1, 1, 1}};
    const Vec3 n = random.direction();
    const double radius = spot.radius;
    const double x = at.distance / static_cast<double>(spot.range);
    const double window = std::pow(1 - x * x * x * x, 2);
    const double expected = exactIrradiance(sphere, at.receiver, n).r * window / (kPi * radius * radius);
    const double actual = exactIrradiance(point, at.receiver, n).r;
    worst.add(std::abs(actual - expected) / std::max(expected, 1e-30),
              [&] { return describe(point) + ": " + describe(actual) + ", expected " + describe(expected); });
    // The cone is the same factor for irradiance and for SH, which the 50-digit reference checks.
    const double share = static_cast<double>(project<2>(spot, at.receiver)[0].r) /
                         static_cast<double>(project<2>(point, at.receiver)[0].r);
    const double spotlit = exactIrradiance(spot, at.receiver, n).r;
    EXPECT_NEAR(spotlit, actual * share, 1e-6 * actual) << describe(spot);
  }
  worst.expectWithin(1e-12);
}

TEST(Exact, DirectionalIsTheKernel) {
  Random random(68);
  for (const float wrap : kWraps) {
    const DirectionalLight light{random.direction() * 3.0f, {1, 2, 3}};
    const Vec3 n = random.direction();
    const double cosine = -static_cast<double>(dot(light.direction, n)) / static_cast<double>(length(light.direction));
    EXPECT_NEAR(exactIrradiance(light, {9, 9, 9}, n, wrap).g, 2 * wrapKernel(cosine, wrap), 1e-6)
        << describe(light) << ", n " << describe(n) << ", wrap " << wrap;
  }
}

TEST(Exact, WrapIsClamped) {
  const SphereLight light{{1, 2, 0.5f}, 0.7f, {1, 1, 1}};
  const Vec3 n{0, -0.6f, 0.8f};
  EXPECT_EQ(exactIrradiance(light, {}, n, 5).r, exactIrradiance(light, {}, n, kMaxWrap).r);
  EXPECT_EQ(exactIrradiance(light, {}, n, -5).r, exactIrradiance(light, {}, n, kMinWrap).r);
}

}  // namespace
}  // namespace rigel
