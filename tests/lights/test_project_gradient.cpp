// Analytic spatial gradients against 50-digit differentiation, relative to the largest component.
#include <gtest/gtest.h>
#include <rigel/project.h>

#include "lights/compare_sh.h"
#include "lights/lights_for_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Coefficients50;
using reference::Real50;
using reference::Worst;
using test::describe;
using test::Placement;
using test::Random;

constexpr double kTolerance = 3e-6;  // r/d (inside d/r) below 0.9
constexpr int kCount = 25;

template <class Light>
void compare(Worst& worst, const Light& light, const Placement& at) {
  const Vec3 p = at.receiver;
  const ProjectionWithGradient<5> actual = projectWithGradient<5>(light, p);
  Coefficients50 expected[3];
  Real50 largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    expected[axis] = differentiateReference(light, reference::exactly(p), 5, axis, Real50(at.distance));
    for (const Real50& value : expected[axis]) largest = std::max(largest, Real50(abs(value)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kCount; ++i) {
      const float value = actual.gradient.d[axis][i].r;
      worst.add(static_cast<double>(abs(Real50(value) - expected[axis][i]) / largest), [&] {
        return describe(light) + ", p " + describe(p) + ", axis " + std::to_string(axis) + ", coefficient " +
               std::to_string(i) + ": " + describe(value) + ", expected " +
               describe(static_cast<double>(expected[axis][i])) + ", largest " + describe(static_cast<double>(largest));
      });
    }
  }
}

TEST(ProjectGradient, Sphere) {
  Random random(41);
  Worst worst("gradient of a sphere, r/d 1e-6 to 0.9, d 1e-9 to 1e9");
  for (int k = 0; k < 300; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-9, 1e9));
    compare(worst, test::sphereAt(at, k % 3 == 0 ? random.uniform(0.5, 0.9) : random.logUniform(1e-6, 0.9)), at);
  }
  worst.expectWithin(kTolerance);
}

TEST(ProjectGradient, InsideASphere) {
  Random random(42);
  Worst worst("gradient inside a sphere, d/r 1e-4 to 0.9");
  for (int k = 0; k < 150; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-6, 1e6));
    compare(worst, SphereLight{at.centre, static_cast<float>(at.distance / random.logUniform(1e-4, 0.9)), {1, 1, 1}},
            at);
  }
  worst.expectWithin(kTolerance);
}

TEST(ProjectGradient, PointWithWindow) {
  Random random(43);
  Worst worst("gradient of a point, range window, outside and inside");
  for (int k = 0; k < 200; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-2, 1e4));
    const double ratio = k % 5 == 0 ? 1 / random.uniform(0.1, 0.9) : random.logUniform(1e-4, 0.9);
    compare(worst, test::pointAt(random, at, ratio), at);
  }
  worst.expectWithin(kTolerance);
}

TEST(ProjectGradient, SpotWithConeAndWindow) {
  Random random(44);
  Worst worst("gradient of a spot, cone and window, outside and inside");
  for (int k = 0; k < 200; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-2, 1e4));
    const double ratio = k % 5 == 0 ? 1 / random.uniform(0.1, 0.9) : random.logUniform(1e-4, 0.9);
    compare(worst, test::spotAt(random, at, ratio), at);
  }
  worst.expectWithin(kTolerance);
}

TEST(ProjectGradient, ValueIsThatOfProject) {
  Random random(45);
  for (int k = 0; k < 200; ++k) {
    const Placement at = test::place(random, 1);
    const SpotLight light = test::spotAt(random, at, random.uniform(0.01, 2));
    const RadianceSH<5> value = project<5>(light, at.receiver);
    const ProjectionWithGradient<5> both = projectWithGradient<5>(light, at.receiver);
    for (int i = 0; i < kCount; ++i) EXPECT_EQ(both.value[i], value[i]) << describe(light) << ", coefficient " << i;
  }
}

TEST(ProjectGradient, DirectionalHasNone) {
  const ProjectionWithGradient<5> both = projectWithGradient<5>(DirectionalLight{{1, 2, 3}, {1, 1, 1}}, {4, 5, 6});
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kCount; ++i) EXPECT_EQ(both.gradient.d[axis][i], Rgb{}) << "coefficient " << i;
  }
}

// At contact the true slope is infinite; the held one stays below 1/kMinGradientCosine of the flux scale per metre.
TEST(ProjectGradient, StaysBoundedAtContact) {
  const SphereLight light{{0, 0, 1}, 1, {1, 1, 1}};
  const double flux = 2 * kPi;
  for (const float z : {0.0f, 1e-7f, -1e-7f, 1e-4f, -1e-4f, 1e-3f, -1e-3f}) {
    const ProjectionWithGradient<5> both = projectWithGradient<5>(light, {0, 0, z});
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kCount; ++i) {
        EXPECT_LE(std::abs(both.gradient.d[axis][i].r), flux * 1.02 / static_cast<double>(kMinGradientCosine))
            << "z " << z << ", axis " << axis << ", coefficient " << i;
      }
    }
    // Towards the light it brightens at the held rate: 2 pi Y00 / kMinGradientCosine.
    EXPECT_NEAR(both.gradient.d[2][0].r, flux * 0.28209479 / static_cast<double>(kMinGradientCosine), 0.03 * 17.7)
        << "z " << z;
  }
}

}  // namespace
}  // namespace rigel
