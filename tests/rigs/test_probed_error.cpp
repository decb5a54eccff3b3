// What a rig is seen to leave of a light at its probes, against the rig as the runtime fits it and a light in double.
#include "bound_plan.h"
#include "bound_truth.h"
#include "probed_error.h"
#include "random_lights.h"
#include "rig_fixture.h"

namespace rigel::test {
namespace {

const RigBox kBox{{-1, -0.5f, -0.4f}, {1, 0.5f, 0.4f}};

/// Largest over the probes and all normals.
struct Seen {
  double error = 0, value = 0, peak = 0;
};

template <class Light>
Seen seen(const Rig& rig, const detail::SamplePlan& plan, const Light& light) {
  LightSet set;
  set.add(light);
  std::vector<RadianceSH<3>> functionals(rig.projections()), coefficients(rig.shVectors());
  projectSamples<3>(rig, {}, set, functionals);
  fitRig<3>(rig, functionals, coefficients);
  const std::array<float, 3> fl = wrapCoefficients<3>(0);
  Seen out;
  for (int j = 0; j < plan.probed; ++j) {
    const Vec3 p{plan.looked.x[j], plan.looked.y[j], plan.looked.z[j]};
    const Irradiance9 truth = referenceIrradiance(light, p, 0);
    const RadianceSH<3> value = evaluateRig<3>(rig, coefficients, p);
    Irradiance9 fitted, rest;
    for (int i = 0; i < 9; ++i) {
      fitted[i] = kPi * double{fl[i == 0 ? 0 : i < 4 ? 1 : 2]} * double{value[i].g};
      rest[i] = fitted[i] - truth[i];
    }
    out.error = std::max(out.error, largestOverNormals(rest));
    out.value = std::max(out.value, largestOverNormals(fitted));
    out.peak = std::max(out.peak, largestOverNormals(truth));
  }
  return out;
}

// Bands are taken at their own worst normals: measured up to 1.8 times; and rounding in float, of the largest values.
constexpr double kBands = 2, kRounding = 3e-6;

void expectHolds(const Probed& probed, const Seen& truth, const std::string& what) {
  const double rounding = kRounding * (truth.value + truth.peak);
  EXPECT_GE(probed.error, truth.error * 0.9999 - rounding) << what;
  EXPECT_LE(probed.error, truth.error * kBands + rounding) << what;
  EXPECT_GE(probed.value, truth.value * 0.9999 - rounding) << what;
  EXPECT_LE(probed.value, truth.value * kBands + rounding) << what;
}

TEST(ProbedError, IsThatOfTheRig) {
  for (const std::string spec : {"poly:1", "poly:6", "poly:20", "lattice:3x2x2@lsq", "mixed:l3,g,c@gauss"}) {
    const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
    const Rig rig = *Rig::create(specOf(spec), {kBox, surface});
    detail::SamplePlan plan;
    boundPlan(rig, kNoRange, plan);
    ASSERT_GT(plan.probed, 0) << spec;
    const WrapField wrap = wrapField(0);
    RandomLights lights(kBox, 5, true);
    for (int i = 0; i < 60; ++i) {
      const SphereLight sphere = lights.sphere();
      const double radius = sphere.radius;
      const Vec3 c = sphere.position;
      expectHolds(probed(plan, wrap, LightField(wrap, kPi * radius * radius, radius), {c.x, c.y, c.z}),
                  seen(rig, plan, sphere), spec + " sphere");
      const DiskLight disk = lights.disk();
      expectHolds(probed(plan, wrap, disk), seen(rig, plan, disk), spec + " disk");
    }
  }
}

TEST(ProbedError, KnowsNothingWithoutProbesAndOfInfiniteValues) {
  const WrapField wrap = wrapField(0);
  detail::SamplePlan none;
  EXPECT_EQ(probed(none, wrap, DiskLight{{0, 2, 0}, {0, -1, 0}, 1, {1, 1, 1}}).error,
            std::numeric_limits<double>::infinity());
  const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
  const Rig rig = *Rig::create(specOf("poly:6"), {kBox, surface});
  detail::SamplePlan plan;
  boundPlan(rig, kNoRange, plan);
  const LightField huge(wrap, 1e38, 1e-12);
  EXPECT_EQ(probed(plan, wrap, huge, {0, 0.6, 0}).error, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace rigel::test
