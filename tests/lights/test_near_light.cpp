// Near lights in float against exact irradiance in double, relative to the light's peak over normals.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/near_light.h>
#include <rigel/project.h>

#include <limits>

#include "lights/describe.h"
#include "lights/lights_for_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::hardRatio;
using test::Placement;
using test::Random;

// Asked for: 2e-5. Worst measured 6.3e-7: rounding of x = n.w and of n itself.
constexpr double kLambertTolerance = 1e-6;

struct WrapTolerance {
  float lo, hi;
  double tolerance;
};
// The fit's own error; worst measured 0.021, 0.0107 and 0.0076. Where a light is large, what bands from 5 on still
// hold; at a < 0 the corner of the kernel, too sharp for a parabola.
constexpr WrapTolerance kWrapTolerances[] = {{-0.25f, -0.1f, 0.022}, {-0.1f, -1e-3f, 0.0115}, {1e-3f, 0.999f, 0.008}};
// Half-Lambert is three bands: nothing is approximated.
constexpr double kHalfLambertTolerance = 1e-6;

Vec3 unit(Vec3 v) { return v * (1 / length(v)); }

/// A normal that makes about `angle` with the direction from receiver to light.
Vec3 normalAt(Random& random, const Placement& at, double angle) {
  const Vec3 w = (at.centre - at.receiver) * static_cast<float>(1 / at.distance);
  const Vec3 side = unit(cross(w, random.direction()));
  return unit(w * static_cast<float>(std::cos(angle)) + side * static_cast<float>(std::sin(angle)));
}

/// What the light gives facing it, without window and cone.
double peakOf(const SphereLight& light, Vec3 p, float wrap) {
  return exactIrradiance(light, p, light.position - p, wrap).r;
}
double peakOf(const PointLight& light, Vec3 p, float wrap) {
  return exactIrradiance(PointLight{light.position, light.intensity, light.radius}, p, light.position - p, wrap).r;
}
double peakOf(const SpotLight& light, Vec3 p, float wrap) {
  return peakOf(PointLight{light.position, light.intensity, light.radius}, p, wrap);
}

template <class Light>
void compare(Worst& worst, const Light& light, Vec3 p, Vec3 n, float wrap = 0) {
  const double expected = exactIrradiance(light, p, n, wrap).r;
  const double actual = nearIrradiance(nearLight(light), p, n, wrap).r;
  worst.add(std::abs(actual - expected) / peakOf(light, p, wrap), [&] {
    return describe(light) + ", p " + describe(p) + ", n " + describe(n) + ", wrap " + describe(wrap) + ": " +
           describe(actual) + ", expected " + describe(expected);
  });
}

/// A light at `ratio` and a normal: any, or one for which the light crosses the kernel's horizon.
void compareHard(Worst& worst, Random& random, double distance, double ratio, float wrap) {
  const Placement at = test::place(random, distance);
  const SphereLight light = test::sphereAt(at, ratio);
  const double alpha = std::asin(std::min(1.0, static_cast<double>(light.radius) / at.distance));
  const double crossing = std::acos(-static_cast<double>(wrap)) + alpha * random.uniform(-1.05, 1.05);
  const double angle = random.index(2) == 0 ? random.uniform(0, M_PI) : std::clamp(crossing, 0.0, M_PI);
  compare(worst, light, at.receiver, normalAt(random, at, angle), wrap);
}

int caseCount() { return test::fullRun() ? 2'000'000 : 40'000; }

TEST(NearLight, LambertAnywhere) {
  Random random(201);
  Worst worst("near Lambert, any r/d, inside and touching");
  for (int k = 0; k < caseCount(); ++k) {
    compareHard(worst, random, random.logUniform(1e-6, 1e6), hardRatio(random), 0);
  }
  worst.expectWithin(kLambertTolerance);
}

TEST(NearLight, LambertTouchingToTheLastBit) {
  Random random(202);
  Worst worst("near Lambert, touching");
  for (int k = 0; k < caseCount() / 4; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e3));
    SphereLight light = test::sphereAt(at, 1);
    for (int step = random.index(4); step > 0; --step) light.radius = std::nextafter(light.radius, 1e9f);
    compare(worst, light, at.receiver, random.direction());
  }
  worst.expectWithin(kLambertTolerance);
}

TEST(NearLight, LambertAtTheScalesOfFloat) {
  Random random(203);
  Worst worst("near Lambert, distances 1e-15 to 1e15");
  for (int k = 0; k < caseCount() / 4; ++k) {
    compareHard(worst, random, random.logUniform(1e-15, 1e15), hardRatio(random), 0);
  }
  worst.expectWithin(kLambertTolerance);
}

TEST(NearLight, LambertFarFromTheOrigin) {
  // Receiver and light share their leading digits: the difference of positions is exact, what is left of them counts.
  Random random(204);
  Worst worst("near Lambert, 1 m apart and 1 to 100 km from the origin");
  for (int k = 0; k < caseCount() / 4; ++k) {
    const Vec3 p = random.direction() * static_cast<float>(random.logUniform(1e3, 1e5));
    const SphereLight light{p + random.direction(), random.uniformf(0.1, 1.2), {1, 1, 1}};
    if (light.position == p) continue;
    compare(worst, light, p, random.direction());
  }
  worst.expectWithin(kLambertTolerance);
}

TEST(NearLight, Wrap) {
  for (const WrapTolerance& range : kWrapTolerances) {
    Random random(205);
    Worst worst("near wrap " + describe(range.lo) + " to " + describe(range.hi));
    for (int k = 0; k < caseCount() / 8; ++k) {
      const float wrap = random.uniformf(range.lo, range.hi);
      compareHard(worst, random, random.logUniform(1e-3, 1e3), hardRatio(random), wrap);
    }
    worst.expectWithin(range.tolerance);
  }
}

TEST(NearLight, HalfLambert) {
  Random random(206);
  Worst worst("near half-Lambert");
  for (int k = 0; k < caseCount() / 4; ++k) compareHard(worst, random, 3, hardRatio(random), 1);
  worst.expectWithin(kHalfLambertTolerance);
}

TEST(NearLight, WrapIsClampedAndNanIsLambert) {
  const NearLight light = nearLight(SphereLight{{1, 2, 0.5f}, 0.7f, {1, 1, 1}});
  const Vec3 n{0, -0.6f, 0.8f};
  EXPECT_EQ(nearIrradiance(light, {}, n, 5), nearIrradiance(light, {}, n, kMaxWrap));
  EXPECT_EQ(nearIrradiance(light, {}, n, -5), nearIrradiance(light, {}, n, kMinWrap));
  EXPECT_EQ(nearIrradiance(light, {}, n, std::numeric_limits<float>::quiet_NaN()), nearIrradiance(light, {}, n));
  EXPECT_EQ(nearIrradiance(light, {}, n, nearWrap(0)), nearIrradiance(light, {}, n));
}

TEST(NearLight, ContinuousAlongAPathThroughTheSphere) {
  // From outside through the centre and out again in steps of 1 mm: the error never jumps, at the surface least of all,
  // where the light itself rises with infinite slope. Worst measured 0.00065 of the peak, where highBandShare ends.
  Worst worst("change of the error in 1 mm along a path through a sphere of 1 m");
  for (const float wrap : {-0.25f, 0.0f, 0.3f, 1.0f}) {
    const SphereLight sphere{{}, 1, {1, 1, 1}};
    const NearLight light = nearLight(sphere);
    const NearWrap prepared = nearWrap(wrap);
    for (const Vec3 n : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, unit({-1, 2, 0.3f})}) {
      double last = 0;
      for (int i = 0; i <= 6000; ++i) {
        const Vec3 p{-3 + static_cast<float>(i) * 1e-3f, 0.1f, 0};
        const double error = nearIrradiance(light, p, n, prepared).r - exactIrradiance(sphere, p, n, wrap).r;
        if (i > 0)
          worst.add(std::abs(error - last) / kPi, [&] { return "wrap " + describe(wrap) + ", p " + describe(p); });
        last = error;
      }
    }
  }
  worst.expectWithin(0.002);
}

TEST(NearLight, PointWithRange) {
  Random random(207);
  Worst worst("near point light with range");
  for (int k = 0; k < caseCount() / 4; ++k) {
    const Placement at = test::place(random, random.logUniform(0.01, 100));
    const PointLight light = test::pointAt(random, at, random.logUniform(1e-4, 1.5));
    compare(worst, light, at.receiver, random.direction());
  }
  worst.expectWithin(kLambertTolerance);
}

TEST(NearLight, Spot) {
  // A cone of cosines [outer, inner] turns rounding of the cosine, 1.2e-7, into 1.5 times that over its width. Measured
  // against that, the worst is 1.7e-7.
  constexpr double kConeTolerance = 3e-7;
  Random random(208);
  Worst worst("near spot light, times the width of its cone");
  for (int k = 0; k < caseCount() / 4; ++k) {
    const Placement at = test::place(random, random.logUniform(0.01, 100));
    const SpotLight light = test::spotAt(random, at, random.logUniform(1e-3, 1.5));
    const double width = std::max<double>(kMinConeWidth, std::cos(light.innerAngle) - std::cos(light.outerAngle));
    const Vec3 n = normalAt(random, at, random.uniform(0, 1.7));
    const double error =
        std::abs(nearIrradiance(nearLight(light), at.receiver, n).r - exactIrradiance(light, at.receiver, n).r);
    worst.add(std::max(0.0, error / peakOf(light, at.receiver, 0) - kLambertTolerance) * width,
              [&] { return describe(light) + ", p " + describe(at.receiver) + ", n " + describe(n); });
  }
  worst.expectWithin(kConeTolerance);
}

TEST(NearLight, Directional) {
  Random random(209);
  for (const float wrap : {-0.25f, -0.1f, 0.0f, 0.2f, 0.5f, 1.0f}) {
    Worst worst("near directional light, wrap " + describe(wrap));
    for (int k = 0; k < 2000; ++k) {
      const DirectionalLight light{random.direction() * 3.0f, {1, 2, 3}};
      const Vec3 n = random.direction();
      const double expected = exactIrradiance(light, {9, 9, 9}, n, wrap).b / 3;
      worst.add(std::abs(static_cast<double>(nearIrradiance(nearLight(light), {9, 9, 9}, n, wrap).b) / 3 - expected),
                [&] { return describe(light) + ", n " + describe(n) + ": " + describe(expected); });
    }
    worst.expectWithin(1e-6);
  }
}

TEST(NearLight, ShareScales) {
  const SphereLight light{{1, 2, 0.5f}, 0.7f, {1, 2, 4}};
  const Rgb whole = nearIrradiance(nearLight(light), {}, {0, 1, 0});
  EXPECT_EQ(nearIrradiance(nearLight(light, 0.25f), {}, {0, 1, 0}), whole * 0.25f);
  EXPECT_EQ(nearIrradiance(nearLight(light, 7), {}, {0, 1, 0}), whole);
  EXPECT_EQ(nearIrradiance(nearLight(light, -1), {}, {0, 1, 0}), Rgb{});
  EXPECT_EQ(nearIrradiance(nearLight(light, std::numeric_limits<float>::quiet_NaN()), {}, {0, 1, 0}), Rgb{});
  EXPECT_EQ(whole.b, 4 * whole.r);
}

TEST(NearLight, GainScales) {
  const NearLight light = nearLight(SphereLight{{1, 2, 0.5f}, 0.7f, {1, 2, 4}});
  for (const float wrap : {-0.2f, 0.0f, 0.5f, 1.0f}) {
    const Rgb plain = nearIrradiance(light, {}, {0, 1, 0}, gpuWrap(wrap));
    const Rgb half = nearIrradiance(light, {}, {0, 1, 0}, gpuWrap(wrap, 0.5f));
    EXPECT_EQ(half, plain * 0.5f) << "wrap " << wrap;
    const Rgb inside = nearIrradiance(light, {1, 1.9f, 0.5f}, {0, 1, 0}, gpuWrap(wrap));
    EXPECT_NEAR(nearIrradiance(light, {1, 1.9f, 0.5f}, {0, 1, 0}, gpuWrap(wrap, 0.5f)).r, 0.5f * inside.r, 1e-6f);
  }
}

TEST(NearLight, NothingComesFromLightsThatAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const Vec3 n{0, 1, 0};
  const NearLight none[] = {nearLight(DirectionalLight{{}, {1, 1, 1}}),
                            nearLight(DirectionalLight{{kNan, 0, 0}, {1, 1, 1}}),
                            nearLight(PointLight{{kNan, 1, 0}, {1, 1, 1}}),
                            nearLight(PointLight{{0, 1, 0}, {1, kNan, 1}}),
                            nearLight(PointLight{{0, 1, 0}, {1, 1, 1}, kNan}),
                            nearLight(PointLight{{0, 1, 0}, {1, 1, 1}, 0.1f, 0}),
                            nearLight(PointLight{{0, 1, 0}, {1, 1, 1}, 0.1f, kNan}),
                            nearLight(SpotLight{{0, 1, 0}, {}, {1, 1, 1}}),
                            nearLight(SpotLight{{0, 1, 0}, {0, -1, 0}, {1, 1, 1}, kNan, 1}),
                            nearLight(SphereLight{{0, 1, 0}, 0, {1, 1, 1}}),
                            nearLight(SphereLight{{0, 1, 0}, kNan, {1, 1, 1}}),
                            nearLight(SphereLight{{kInf, 1, 0}, 1, {1, 1, 1}}),
                            NearLight{}};
  for (const NearLight& light : none)
    for (const float wrap : {0.0f, 0.5f}) EXPECT_EQ(nearIrradiance(light, {}, n, wrap), Rgb{});
  const NearLight sphere = nearLight(SphereLight{{0, 2, 0}, 1, {1, 1, 1}});
  for (const float wrap : {-0.2f, 0.0f, 0.5f}) {
    EXPECT_EQ(nearIrradiance(sphere, {kNan, 0, 0}, n, wrap), Rgb{});
    EXPECT_EQ(nearIrradiance(sphere, {kInf, 0, 0}, n, wrap), Rgb{});
    EXPECT_EQ(nearIrradiance(sphere, {}, {kNan, 0, 0}, wrap), Rgb{});
    EXPECT_EQ(correctorIrradiance(sphere, {}, {kNan, 0, 0}, nearWrap(wrap)), Rgb{});
  }
  EXPECT_EQ(cheapIrradiance(sphere, {}, {kNan, 0, 0}), Rgb{});
}

TEST(NearLight, CheapForm) {
  // The parabola's own error (shader_near_cap.h), largest where the sphere all but touches.
  constexpr double kCheapTolerance = 0.013;
  Random random(210);
  Worst worst("cheap Lambert, any r/d, inside and touching");
  Worst small("cheap Lambert, r/d <= 0.7");
  for (int k = 0; k < caseCount(); ++k) {
    const Placement at = test::place(random, 3);
    const SphereLight light = test::sphereAt(at, hardRatio(random));
    const Vec3 n = random.direction();
    const double expected = exactIrradiance(light, at.receiver, n).r;
    const double actual = cheapIrradiance(nearLight(light), at.receiver, n).r;
    const auto text = [&] { return describe(light) + ", p " + describe(at.receiver) + ", n " + describe(n); };
    const double error = std::abs(actual - expected) / peakOf(light, at.receiver, 0);
    worst.add(error, text);
    if (static_cast<double>(light.radius) <= 0.7 * at.distance) small.add(error, text);
  }
  worst.expectWithin(kCheapTolerance);
  small.expectWithin(0.005);
}

/// The 3-band irradiance of one light, as a perfect rig gives it.
double threeBands(const SphereLight& light, Vec3 p, Vec3 n, float wrap) {
  return evaluate(irradianceFromRadiance(project<3>(light, p), wrap), n).r;
}

TEST(NearLight, CorrectorTakesMostOfWhatThreeBandsLeave) {
  struct Bound {
    float wrap;
    double without, with;  // per cent of the peak, worst over r/d and normals
  };
  // Without: the truncation itself. With: the corner at the horizon, which the delta kernel has and a light of some
  // size has not, and what the fade by size misses.
  for (const Bound& bound : {Bound{-0.25f, 0.19, 0.08}, {0, 0.096, 0.037}, {0.5f, 0.03, 0.018}}) {
    Random random(211);
    Worst without("3 bands, wrap " + describe(bound.wrap));
    Worst with("3 bands and corrector, wrap " + describe(bound.wrap));
    const NearWrap wrap = nearWrap(bound.wrap);
    for (int k = 0; k < caseCount() / 4; ++k) {
      const Placement at = test::place(random, 3);
      const SphereLight light =
          test::sphereAt(at, random.index(2) == 0 ? random.uniform() : random.logUniform(1e-4, 1));
      const Vec3 n = random.direction();
      const double expected = exactIrradiance(light, at.receiver, n, bound.wrap).r;
      const double peak = peakOf(light, at.receiver, bound.wrap);
      const double rig = threeBands(light, at.receiver, n, bound.wrap);
      const double corrector = correctorIrradiance(nearLight(light), at.receiver, n, wrap).r;
      const auto text = [&] { return describe(light) + ", p " + describe(at.receiver) + ", n " + describe(n); };
      without.add(std::abs(rig - expected) / peak, text);
      with.add(std::abs(rig + corrector - expected) / peak, text);
    }
    EXPECT_GT(without.error(), 0.9 * bound.without);
    without.expectWithin(bound.without);
    with.expectWithin(bound.with);
  }
}

TEST(NearLight, CorrectorOfADirectionalLightIsExact) {
  Random random(212);
  for (const float wrap : {0.0f, 0.4f, -0.2f}) {
    const DirectionalLight light{random.direction(), {1, 1, 1}};
    const NearLight near = nearLight(light);
    const Vec3 n = random.direction();
    const double rig = evaluate(irradianceFromRadiance(project<3>(light, {}), wrap), n).r;
    const double both = rig + static_cast<double>(correctorIrradiance(near, {}, n, nearWrap(wrap)).r);
    EXPECT_NEAR(both, exactIrradiance(light, {}, n, wrap).r, 1e-6);
  }
}

}  // namespace
}  // namespace rigel
