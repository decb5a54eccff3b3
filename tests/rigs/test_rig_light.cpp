// Rigs fitted to real lights.
#include "rig_fixture.h"

#include <rigel/sh_rotation.h>

#include <limits>

namespace rigel::test {
namespace {

using Sh = RadianceSH<3>;

const auto kBody = ellipsoid({0, 1, 0}, {0.9f, 0.3f, 0.25f}, 600);

LightSet streetLights() {
  LightSet lights;
  lights.add(SphereLight{{2, 3, 1}, 0.3f, {20, 15, 10}});
  lights.add(PointLight{{-1.5f, 0.5f, 1}, {3, 4, 5}});
  lights.add(SpotLight{{0, 4, 0}, {0, -1, 0.2f}, {30, 30, 30}, 0.2f, 0.6f});
  lights.add(DirectionalLight{{1, -1, 0}, {0.2f, 0.2f, 0.3f}});
  return lights;
}

std::vector<Sh> fitted(const Rig& rig, const RigFrame& frame, const LightSet& lights) {
  std::vector<Sh> functionals(rig.projections());
  std::vector<Sh> coefficients(rig.shVectors());
  projectSamples<3>(rig, frame, lights, functionals);
  fitRig<3>(rig, functionals, coefficients);
  return coefficients;
}

double largest(const Sh& sh) {
  double value = 0;
  for (const Rgb& c : sh.c)
    value = std::max({value, std::abs(double{c.r}), std::abs(double{c.g}), std::abs(double{c.b})});
  return value;
}

double difference(const Sh& a, const Sh& b) {
  Sh d = a;
  d += b * -1.0f;
  return largest(d);
}

/// RMS over the body of rig minus per-point SH, over the RMS of the latter.
double spatialError(const std::string& text, const LightSet& lights) {
  const Rig rig = rigOf(text, kBody);
  const auto c = fitted(rig, {}, lights);
  double error = 0;
  double reference = 0;
  for (Vec3 p : kBody) {
    const Sh truth = project<3>(lights, p);
    const Sh got = evaluateRig<3>(rig, c, p);
    for (int i = 0; i < 9; ++i) {
      error += std::pow(double{got[i].g} - double{truth[i].g}, 2);
      reference += std::pow(double{truth[i].g}, 2);
    }
  }
  return std::sqrt(error / reference);
}

TEST(RigLight, ConstantRigIsTheSampleAtTheCentre) {
  const LightSet lights = streetLights();
  const Rig rig = rigOf("constant", kBody);
  EXPECT_LT(difference(fitted(rig, {}, lights)[0], project<3>(lights, rig.samples()[0].position)), 1e-6);
}

TEST(RigLight, DirectionalLightIsExactInEveryRig) {
  LightSet lights;
  lights.add(DirectionalLight{{1, -2, 0.5f}, {3, 2, 1}});
  const Sh truth = project<3>(lights, {});
  for (const std::string& text : everyKindOfSpec()) {
    const Rig rig = rigOf(text, kBody);
    const auto c = fitted(rig, {}, lights);
    for (Vec3 p : kBody) ASSERT_LT(difference(evaluateRig<3>(rig, c, p), truth), 1e-4 * largest(truth)) << text;
  }
}

TEST(RigLight, AnalyticAndNumericGradientsAgreeForDistantLights) {
  LightSet lights;
  lights.add(SphereLight{{20, 15, -12}, 1, {500, 500, 500}});
  const Rig analytic = rigOf("gradient", kBody);
  const Rig numeric = rigOf("gradient@numeric", kBody);
  const auto a = fitted(analytic, {}, lights);
  const auto n = fitted(numeric, {}, lights);
  for (int k = 0; k < 4; ++k) EXPECT_LT(difference(a[k], n[k]), 2e-3 * largest(a[k])) << k;
}

TEST(RigLight, MoreVectorsFitBetter) {
  const LightSet lights = streetLights();
  const double constant = spatialError("constant", lights);
  const double gradient = spatialError("gradient", lights);
  const double lattice = spatialError("lattice:8x4x2", lights);
  const double poly6 = spatialError("poly:6", lights);
  const double poly12 = spatialError("poly:12", lights);
  EXPECT_LT(gradient, constant);
  EXPECT_LT(lattice, gradient);
  EXPECT_LT(poly6, gradient);
  EXPECT_LT(poly12, poly6);
}

TEST(RigLight, TurningSceneAndObjectTogetherTurnsTheSh) {
  // Rotation about y by 40 degrees and a shift of everything.
  const float co = std::cos(0.7f);
  const float si = std::sin(0.7f);
  const RigFrame turned{{co, 0, -si}, {0, 1, 0}, {si, 0, co}, {5, -2, 3}};
  const ShRotation<3> rotate(Rotation{{{co, 0, si}, {0, 1, 0}, {-si, 0, co}}});
  LightSet here;
  LightSet there;
  const SphereLight sphere{{2, 3, 1}, 0.3f, {20, 15, 10}};
  const SpotLight spot{{0, 4, 0}, {0, -1, 0.2f}, {30, 30, 30}, 0.2f, 0.6f};
  here.add(sphere);
  here.add(spot);
  there.add(SphereLight{turned.point(sphere.position), sphere.radius, sphere.radiance});
  there.add(SpotLight{turned.point(spot.position), turned.vector(spot.direction), spot.intensity, spot.innerAngle,
                      spot.outerAngle});
  for (const std::string& text : everyKindOfSpec()) {
    const Rig rig = rigOf(text, kBody);
    const auto a = fitted(rig, {}, here);
    const auto b = fitted(rig, turned, there);
    for (int k = 0; k < rig.shVectors(); ++k)
      ASSERT_LT(difference(rotate(a[k]), b[k]), 1e-4 * std::max(largest(a[0]), largest(a[k])))
          << text << " vector " << k;
  }
}

TEST(RigLight, FitIsLinearInTheLights) {
  LightSet a;
  LightSet b;
  LightSet both;
  const SphereLight first{{2, 3, 1}, 0.3f, {20, 15, 10}};
  const PointLight second{{-1.5f, 0.5f, 1}, {3, 4, 5}};
  a.add(first);
  b.add(second);
  both.add(first);
  both.add(second);
  for (const std::string& text : everyKindOfSpec()) {
    const Rig rig = rigOf(text, kBody);
    auto sum = fitted(rig, {}, a);
    const auto other = fitted(rig, {}, b);
    const auto together = fitted(rig, {}, both);
    for (int k = 0; k < rig.shVectors(); ++k) {
      sum[k] += other[k];
      ASSERT_LT(difference(sum[k], together[k]), 2e-5 * (1 + largest(together[k]))) << text;
    }
  }
}

TEST(RigLight, IrradianceOfAFurnaceIsPiTimesRadiance) {
  // Deep inside a large glowing sphere light the receiver sees radiance 2 all around.
  LightSet lights;
  lights.add(SphereLight{{0, 1, 0}, 1e4f, {2, 2, 2}});
  for (const float wrap : {0.0f, 0.5f, 1.0f}) {
    const auto f = wrapCoefficients<3>(wrap);
    for (const std::string& text : everyKindOfSpec()) {
      const Rig rig = rigOf(text, kBody);
      const auto c = fitted(rig, {}, lights);
      for (int i = 0; i < 50; ++i) {
        const Rgb e = irradiance<3>(evaluateRig<3>(rig, c, kBody[i]), f, kBody[i] * (1 / length(kBody[i])));
        // The sphere is not infinite: the light 1 m off its centre varies by 1e-4.
        ASSERT_NEAR(e.r, 2 * kPi * static_cast<double>(f[0]), 3e-3) << text;
      }
    }
  }
}

/// Of irradiance, relative to the rig's largest coefficient. Worst measured 1.4e-6 (poly:20): sums of twenty terms in
/// another order.
constexpr double kBatchTolerance = 4e-6;

TEST(RigLight, ManyPointsAtOnceAsOneAfterAnother) {
  const LightSet lights = streetLights();
  const RigFrame frame{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0.1f, 0.2f, 0.3f}};
  const auto f = wrapCoefficients<3>(0.2f);
  std::vector<std::string> specs = everyKindOfSpec();
  specs.push_back("lattice:6x4x4");  // too many vectors to be taken together
  for (const std::string& spec : specs) {
    const Rig rig = rigOf(spec, kBody);
    const auto c = fitted(rig, frame, lights);
    double size = 0;
    for (const Sh& of : c) size = std::max(size, largest(of));
    std::vector<float> p[3], n[3];
    const std::size_t count = 150;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3 local = kBody[i] * (i % 10 == 3 ? 1.5f : 1.0f);  // outside the box, too
      if (i == 77) local.y = std::numeric_limits<float>::quiet_NaN();
      const Vec3 world = frame.point(local), way = kBody[(7 * i) % kBody.size()], unit = way * (1 / length(way));
      for (int axis = 0; axis < 3; ++axis) {
        p[axis].push_back(world[axis]);
        n[axis].push_back(unit[axis]);
      }
    }
    std::vector<float> all(3 * count);
    irradianceBatch<3>(rig, frame, c, f, {p[0], p[1], p[2]}, {n[0], n[1], n[2]}, all);
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 local = frame.inversePoint({p[0][i], p[1][i], p[2][i]});
      const Rgb one = irradiance<3>(evaluateRig<3>(rig, c, local), f, {n[0][i], n[1][i], n[2][i]});
      for (int k = 0; k < 3; ++k)
        worst = std::max(worst, std::abs(double{all[static_cast<std::size_t>(k) * count + i]} - double{one[k]}) / size);
    }
    EXPECT_LE(worst, kBatchTolerance) << spec;
  }
}

}  // namespace
}  // namespace rigel::test
