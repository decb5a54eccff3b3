// SH of every light kind against 50 digits on the same float inputs.
#include <gtest/gtest.h>
#include <rigel/project.h>

#include "lights/compare_sh.h"
#include "lights/lights_for_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Placement;
using test::Random;

// Relative to the norm of the vector. Float rounding of direction, basis and factors; near contact the input's own
// rounding of c is out of the way, because d^2 - r^2 is formed in double.
constexpr double kTolerance = 5e-7;          // r/d up to 0.9
constexpr double kCloseTolerance = 1.5e-6;   // up to 0.99
constexpr double kTouchingTolerance = 5e-6;  // up to 0.999

template <class Light>
void compare(Worst& worst, const Light& light, Vec3 p) {
  const RadianceSH<5> q = project<5>(light, p);
  const reference::Coefficients50 expected = projectReference(light, reference::exactly(p), 5);
  worst.add(test::relativeError(q, expected, 1),
            [&] { return describe(light) + ", p " + describe(p) + test::sideBySide(q, expected, 1); });
}

TEST(Project, SphereOfEveryScaleAndSize) {
  Random random(31);
  Worst worst("sphere, r/d 1e-8 to 0.9, d 1e-15 to 1e15");
  for (int k = 0; k < 1500; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-15, 1e15));
    compare(worst, test::sphereAt(at, random.logUniform(1e-8, 0.9)), at.receiver);
  }
  for (double d = 1e-15; d < 2e15; d *= 10) {
    for (const double ratio : {1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.25, 0.5, 0.7, 0.8, 0.9}) {
      const Placement at = test::place(random, d);
      compare(worst, test::sphereAt(at, ratio), at.receiver);
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(Project, SphereNearlyTouching) {
  Random random(32);
  Worst close("sphere, r/d 0.9 to 0.99");
  Worst touching("sphere, r/d 0.99 to 0.999");
  for (int k = 0; k < 500; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-15, 1e15));
    compare(close, test::sphereAt(at, k == 0 ? 0.99 : random.uniform(0.9, 0.99)), at.receiver);
    compare(touching, test::sphereAt(at, k == 0 ? 0.999 : 1 - random.logUniform(0.001, 0.01)), at.receiver);
  }
  close.expectWithin(kCloseTolerance);
  touching.expectWithin(kTouchingTolerance);
}

// Along the axes a coordinate of the direction is exactly 0 or 1, where polynomials could lose their bits.
TEST(Project, SphereAlongTheAxes) {
  Worst worst("sphere along the axes and diagonals");
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 centre{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        for (const float radius : {1e-7f, 1e-3f, 0.3f, 0.85f})
          compare(worst, SphereLight{centre, radius, {1, 1, 1}}, {});
      }
    }
  }
  worst.expectWithin(kTolerance);
}

TEST(Project, SphereFromInside) {
  Random random(33);
  Worst worst("inside a sphere, d/r 1e-8 to 0.9");
  for (int k = 0; k < 500; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-12, 1e12));
    SphereLight light{at.centre, static_cast<float>(at.distance / random.logUniform(1e-8, 0.9)), {1, 1, 1}};
    compare(worst, light, at.receiver);
  }
  worst.expectWithin(kTolerance);
}

TEST(Project, PointWithWindow) {
  Random random(34);
  Worst worst("point, radius raised, outside and inside, range window");
  for (int k = 0; k < 500; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e6));
    compare(worst, test::pointAt(random, at, k % 5 == 0 ? random.uniform(1.2, 20) : random.logUniform(1e-8, 0.9)),
            at.receiver);
  }
  worst.expectWithin(kTolerance);
}

TEST(Project, SpotWithConeAndWindow) {
  Random random(35);
  Worst worst("spot, outside and inside, cone and window");
  for (int k = 0; k < 500; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e6));
    compare(worst, test::spotAt(random, at, k % 5 == 0 ? random.uniform(1.2, 20) : random.logUniform(1e-8, 0.9)),
            at.receiver);
  }
  worst.expectWithin(kTolerance);
}

TEST(Project, Directional) {
  Random random(36);
  Worst worst("directional, any length of direction");
  for (int k = 0; k < 200; ++k) {
    const DirectionalLight light{random.direction() * static_cast<float>(random.logUniform(1e-15, 1e15)), {1, 1, 1}};
    compare(worst, light, random.pointInCube(10));
  }
  worst.expectWithin(kTolerance);
}

// Colour enters as a factor; physically large and small ones keep the accuracy.
TEST(Project, ColourScalesEveryChannel) {
  Random random(37);
  Worst worst("coloured sphere, channel by channel");
  for (int k = 0; k < 100; ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e3));
    SphereLight light = test::sphereAt(at, random.logUniform(1e-6, 0.9));
    light.radiance = {static_cast<float>(random.logUniform(1e-8, 1e10)),
                      static_cast<float>(random.logUniform(1e-8, 1e10)),
                      static_cast<float>(-random.logUniform(1e-8, 1e10))};
    const RadianceSH<5> q = project<5>(light, at.receiver);
    const reference::Coefficients50 expected = projectReference(light, reference::exactly(at.receiver), 5);
    for (int channel = 0; channel < 3; ++channel) {
      worst.add(test::relativeError(q, expected, light.radiance[channel], channel),
                [&] { return describe(light) + ", channel " + std::to_string(channel); });
    }
  }
  worst.expectWithin(kTolerance);
}

template <int B>
void expectPrefixOfFiveBands(const LightSet& lights, Vec3 p) {
  const ProjectionWithGradient<B> few = projectWithGradient<B>(lights, p);
  const ProjectionWithGradient<5> all = projectWithGradient<5>(lights, p);
  const RadianceSH<B> value = project<B>(lights, p);
  for (int i = 0; i < shCount(B); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      // Compilers may contract or reorder the unrolled sums of another length: a few roundings.
      const float tolerance = 1e-5f * std::abs(all.value[0][channel]);
      EXPECT_NEAR(few.value[i][channel], all.value[i][channel], tolerance) << B << " bands, coefficient " << i;
      EXPECT_NEAR(value[i][channel], all.value[i][channel], tolerance) << B << " bands, coefficient " << i;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(few.gradient.d[axis][i][channel], all.gradient.d[axis][i][channel], tolerance)
            << B << " bands, coefficient " << i << ", axis " << axis;
      }
    }
  }
}

TEST(Project, FewerBandsAreAPrefix) {
  LightSet lights;
  lights.add(DirectionalLight{{1, -2, 0.5f}, {1, 2, 3}});
  lights.add(PointLight{{1, 2, 3}, {1, 2, 3}, 0.1f, 10});
  lights.add(SpotLight{{-1, 2, 1}, {1, -2, -1}, {3, 2, 1}, 0.1f, 0.8f});
  lights.add(SphereLight{{0, 1, -2}, 0.5f, {1, 1, 2}});
  lights.add(SphereLight{{0.1f, 0, 0}, 0.5f, {1, 1, 2}});
  expectPrefixOfFiveBands<2>(lights, {});
  expectPrefixOfFiveBands<3>(lights, {});
  expectPrefixOfFiveBands<4>(lights, {});
}

}  // namespace
}  // namespace rigel
