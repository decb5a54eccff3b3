#include "lights/rotations.h"

#include <gtest/gtest.h>
#include <rigel/project.h>
#include <rigel/sh_rotation.h>

#include "lights/describe.h"
#include "lights/random.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;
using test::Random;
using test::randomRotation;
using test::rotate;
using test::transpose;

constexpr double kTolerance = 2e-6;  // float rounding of 5-band sums, relative to the vector's norm
constexpr int kRotations = 200;

template <int B>
RadianceSH<B> randomSh(Random& random) {
  RadianceSH<B> sh;
  for (int i = 0; i < shCount(B); ++i) sh[i] = {random.uniformf(-1, 1), random.uniformf(-1, 1), random.uniformf(-1, 1)};
  return sh;
}

template <int B>
double norm(const RadianceSH<B>& a) {
  double sum = 0;
  for (int i = 0; i < 3 * shCount(B); ++i) sum += std::pow(static_cast<double>(a.data()[i]), 2);
  return std::sqrt(sum);
}

template <int B>
double difference(RadianceSH<B> a, const RadianceSH<B>& b) {
  return norm(a += b * -1.0f) / norm(b);
}

template <class Bands>
class ShRotationOf : public testing::Test {};
using AllBands = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                std::integral_constant<int, 4>, std::integral_constant<int, 5>>;
TYPED_TEST_SUITE(ShRotationOf, AllBands);

// The definition: the rotated function at R w is the function at w.
TYPED_TEST(ShRotationOf, TurnsTheFunction) {
  constexpr int B = TypeParam::value;
  Random random(21);
  Worst worst("rotated function at R w against the function at w, absolute, coefficients in [-1, 1]");
  for (int k = 0; k < kRotations; ++k) {
    const Rotation r = randomRotation(random);
    const RadianceSH<B> sh = randomSh<B>(random);
    const RadianceSH<B> turned = ShRotation<B>(r)(sh);
    const Vec3 w = random.direction();
    const double expected = evaluate(sh, w).g;
    const double actual = evaluate(turned, rotate(r, w)).g;
    worst.add(std::abs(actual - expected),
              [&] { return "w " + describe(w) + ": " + describe(actual) + ", expected " + describe(expected); });
  }
  worst.expectWithin(5 * kTolerance);
}

TYPED_TEST(ShRotationOf, IsUndoneByItsInverse) {
  constexpr int B = TypeParam::value;
  Random random(22);
  Worst worst("rotated by R, then back, relative");
  for (int k = 0; k < kRotations; ++k) {
    const Rotation r = randomRotation(random);
    const RadianceSH<B> sh = randomSh<B>(random);
    const RadianceSH<B> back = ShRotation<B>(transpose(r))(ShRotation<B>(r)(sh));
    worst.add(difference(back, sh), [&] { return "rotation " + std::to_string(k); });
  }
  worst.expectWithin(kTolerance);
}

TYPED_TEST(ShRotationOf, KeepsTheNormOfEveryVector) {
  constexpr int B = TypeParam::value;
  Random random(23);
  Worst worst("change of the norm, relative");
  for (int k = 0; k < kRotations; ++k) {
    const Rotation r = randomRotation(random);
    const RadianceSH<B> sh = randomSh<B>(random);
    const double before = norm(sh);
    const double after = norm(ShRotation<B>(r)(sh));
    worst.add(std::abs(after / before - 1), [&] { return describe(before) + " became " + describe(after); });
  }
  worst.expectWithin(kTolerance);
}

TYPED_TEST(ShRotationOf, ComposesAsRotationsDo) {
  constexpr int B = TypeParam::value;
  Random random(24);
  Worst worst("rotated by R, then by Q, against Q R, relative");
  for (int k = 0; k < kRotations; ++k) {
    const Rotation r = randomRotation(random);
    const Rotation q = randomRotation(random);
    const RadianceSH<B> sh = randomSh<B>(random);
    worst.add(difference(ShRotation<B>(q)(ShRotation<B>(r)(sh)), ShRotation<B>(test::compose(q, r))(sh)),
              [&] { return "pair " + std::to_string(k); });
  }
  worst.expectWithin(kTolerance);
}

// project(R light) = R project(light), the receiver turned with it.
TYPED_TEST(ShRotationOf, CommutesWithProjection) {
  constexpr int B = TypeParam::value;
  Random random(25);
  Worst worst("projection of a turned light against the turned projection, relative");
  for (int k = 0; k < kRotations; ++k) {
    const Rotation r = randomRotation(random);
    SphereLight light{random.pointInCube(2), random.uniformf(0.01, 2), random.colour()};
    const RadianceSH<B> turned = ShRotation<B>(r)(project<B>(light, {}));
    const std::string where = describe(light);
    light.position = rotate(r, light.position);
    worst.add(difference(turned, project<B>(light, {})), [&] { return where; });
  }
  worst.expectWithin(kTolerance);
}

TEST(ShRotation, IdentityLeavesEveryCoefficient) {
  Random random(26);
  const RadianceSH<5> sh = randomSh<5>(random);
  const RadianceSH<5> same = ShRotation<5>(Rotation{})(sh);
  for (int i = 0; i < 25; ++i) EXPECT_EQ(same[i], sh[i]) << "coefficient " << i;
}

TEST(ShRotation, AddZonalTurnsAZonalVector) {
  Random random(27);
  const std::array<float, 5> zonal = {1, -0.5f, 0.25f, 2, -1};
  Worst worst("zonal vector about an axis against the rotated one, relative");
  for (int k = 0; k < kRotations; ++k) {
    const Rotation r = randomRotation(random);
    RadianceSH<5> upright;
    for (int l = 0; l < 5; ++l) upright[shIndex(l, 0)] = Rgb{1, 2, 3} * zonal[l];
    RadianceSH<5> added;
    addZonal(added, zonal, rotate(r, {0, 0, 1}), {1, 2, 3});
    worst.add(difference(added, ShRotation<5>(r)(upright)), [&] { return "rotation " + std::to_string(k); });
  }
  worst.expectWithin(kTolerance);
}

}  // namespace
}  // namespace rigel
