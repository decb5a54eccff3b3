// What the bounds of disk lights are made of, against quadrature over the disk and against its SH at single points.
#include "disk_field.h"

#include <rigel/exact.h>

#include "bound_truth.h"
#include "lights/describe.h"
#include "lights/random.h"
#include "random_lights.h"

#include <gtest/gtest.h>

namespace rigel::test {
namespace {

const RigBox kBox{{-1, -0.5f, -0.4f}, {1, 0.5f, 0.4f}};

TEST(DiskField, MeansOfPowersAreIntegralsOverTheDisk) {
  const DiskField field(wrapField(0), 0.7, false);
  for (const double distance : {0.75, 1.0, 3.0, 100.0})
    for (const double sine : {0.0, 0.3, 0.9, 1.0}) {
      // x = cos t has the density 2/pi sin^2 t along a diameter.
      double square = 0, cube = 0, fourth = 0;
      constexpr int kSteps = 2000;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps * kPi, d = distance + 0.7 * sine * std::cos(t);
        const double share = 2 * std::sin(t) * std::sin(t) / kSteps;
        square += share / (d * d);
        cube += share / (d * d * d);
        fourth += share / (d * d * d * d);
      }
      const DiskField::Means means = field.means(distance, sine);
      EXPECT_NEAR(means.square, square, 1e-9 * square) << distance << ' ' << sine;
      EXPECT_NEAR(means.cube, cube, 1e-9 * cube) << distance << ' ' << sine;
      EXPECT_NEAR(means.fourth, fourth, 1e-9 * fourth) << distance << ' ' << sine;
    }
  EXPECT_EQ(field.means(0.5, 1).square, std::numeric_limits<double>::infinity());
}

/// The reference of bound_truth.h itself: half-Lambert is three bands, and has an exact form.
TEST(DiskField, ReferenceIsExactForHalfLambert) {
  RandomLights lights(kBox, 3);
  Random random(4);
  double worst = 0;
  int lit = 0;
  for (int i = 0; i < 2000; ++i) {
    const DiskLight light = lights.disk();
    const Vec3 p{random.uniformf(-1, 1), random.uniformf(-0.5, 0.5), random.uniformf(-0.4, 0.4)};
    const Vec3 n = random.direction();
    const Irradiance9 e = referenceIrradiance(light, p, 1);
    float y[9];
    shBasis<3>(n, y);
    double sh = 0;
    for (int k = 0; k < 9; ++k) sh += e[k] * static_cast<double>(y[k]);
    const double peak = largestOverNormals(e);
    if (!(peak > 0)) continue;
    ++lit;
    worst = std::max(worst, std::abs(sh - exactIrradiance(light, p, n, 1).g) / peak);
  }
  EXPECT_GT(lit, 1000);
  // Float basis; beside the rim 24 steps miss a part. Worst measured 2e-5.
  EXPECT_LT(worst, 1e-4);
}

/// A box of no size about p.
DiskAspect aspectOf(const DiskLight& light, Vec3 p) {
  detail::BoundPlan plan;
  for (int a = 0; a < 3; ++a) plan.centre[a] = static_cast<double>(p[a]);
  const LightPlace place = placeOf(plan, {}, light.position);
  Triple axis{};
  EXPECT_TRUE(unitOf(light.direction, axis));
  double height = 0;
  for (int a = 0; a < 3; ++a) height += place.served.towards[a] * axis[a];
  if (light.twoSided && height < 0)
    for (double& x : axis) x = -x;
  return diskAspect(place.served, axis, light.radius, light.twoSided, 0);
}

TEST(DiskField, VectorIrradianceBoundsTheLightAtEveryPoint) {
  for (const float wrap : {0.0f, 0.5f, 1.0f, -0.25f}) {
    const WrapField wrapped = wrapField(wrap);
    RandomLights lights(kBox, 5);
    Random random(6);
    double closest = 0, exactClosest = 0;
    for (int i = 0; i < 5000; ++i) {
      const DiskLight light = lights.disk();
      const Vec3 p{random.uniformf(-1, 1), random.uniformf(-0.5, 0.5), random.uniformf(-0.4, 0.4)};
      const DiskField field(wrapped, light.radius, light.twoSided);
      const double vector = field.vector(aspectOf(light, p));
      const double sh = largestOverNormals(referenceIrradiance(light, p, wrap));
      // Rounding of positions, and the height of a point that all but lies in the plane.
      constexpr double kRounding = 1e-4;
      ASSERT_LE(sh, (1 + kRounding) * field.perVector() * vector + 1e-12) << describe(light) << ", " << describe(p);
      ASSERT_LE(exactIrradiance(light, p, light.position - p, wrap).g,
                (1 + kRounding) * field.exactPerVector() * vector + 1e-12)
          << describe(light) << ", " << describe(p);
      if (!(vector > 0)) continue;
      closest = std::max(closest, sh / (field.perVector() * vector));
      exactClosest = std::max(exactClosest, exactIrradiance(light, p, light.position - p, wrap).g / vector);
    }
    EXPECT_GT(closest, 0.99) << wrap;
    EXPECT_GT(exactClosest, 0.9) << wrap;
  }
}

}  // namespace
}  // namespace rigel::test
