// Shapes and lights at the limits: nothing may become infinite or not a number.
#include "rig_fixture.h"

namespace rigel::test {
namespace {

bool isFinite(const RadianceSH<3>& sh) {
  for (const Rgb& c : sh.c)
    if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b)) return false;
  return true;
}

/// Fits and evaluates all kinds of rig on `surface`; every result must be finite.
void expectFinite(const std::vector<Vec3>& surface, const LightSet& lights, const std::string& what) {
  for (const std::string& text : everyKindOfSpec()) {
    Rig rig = rigOf(text, surface);
    std::vector<RadianceSH<3>> functionals(rig.projections());
    std::vector<RadianceSH<3>> c(rig.shVectors());
    projectSamples<3>(rig, {}, lights, functionals);
    adaptRig<3>(rig, functionals);
    fitRig<3>(rig, functionals, c);
    EXPECT_TRUE(std::isfinite(rig.condition())) << what << ", " << text;
    for (Vec3 p : surface) ASSERT_TRUE(isFinite(evaluateRig<3>(rig, c, p))) << what << ", " << text;
  }
}

LightSet nearLights(Vec3 at, float size) {
  LightSet lights;
  lights.add(SphereLight{at, 0.3f * size, {20, 15, 10}});
  lights.add(PointLight{at, {3, 4, 5}, 0});
  lights.add(SpotLight{at, {0, -1, 0}, {30, 30, 30}, 0.2f, 0.2f});
  lights.add(SphereLight{at, 0, {1, 1, 1}});
  return lights;
}

TEST(RigHardCases, DegenerateShapes) {
  const std::vector<std::pair<std::string, std::vector<Vec3>>> shapes = {
      {"one point", {{1, 2, 3}}},
      {"coincident points", std::vector<Vec3>(50, Vec3{1, 2, 3})},
      {"a line", ellipsoid({}, {1, 0, 0}, 100)},
      {"a plane", ellipsoid({}, {1, 0, 2}, 100)},
      {"a needle", ellipsoid({}, {10, 1e-6f, 1e-6f}, 100)},
      {"a leaf of no thickness to speak of", ellipsoid({}, {1, 1e-39f, 2}, 100)},
      {"tiny", ellipsoid({}, {1e-10f, 2e-10f, 1e-10f}, 100)},
      {"huge", ellipsoid({}, {1e10f, 2e10f, 1e10f}, 100)},
      {"far from the origin", ellipsoid({1e6f, 0, 0}, {1, 1, 1}, 100)}};
  for (const auto& [what, surface] : shapes) {
    const RigBox box = boxOf(surface);
    const float size = std::max(length(box.hi - box.lo), 1e-3f);
    expectFinite(surface, nearLights(box.hi, size), what + ", light at a corner");
    expectFinite(surface, nearLights((box.lo + box.hi) * 0.5f, size), what + ", light at the centre");
    expectFinite(surface, nearLights(surface[0], size), what + ", light on the surface");
  }
}

TEST(RigHardCases, PointsThatAreNotNumbersOrFarOff) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto surface = ellipsoid({}, {1, 1, 1}, 200);
  for (const std::string& text : everyKindOfSpec()) {
    const Rig rig = rigOf(text, surface);
    for (Vec3 p :
         {Vec3{nan, 0, 0}, Vec3{nan, nan, nan}, Vec3{infinity, 0, 0}, Vec3{0, -infinity, 0}, Vec3{1e30f, 0, 0}}) {
      RigBasis phi;
      rig.basis(p, phi);
      ASSERT_GE(phi.count, 1) << text;
      for (int j = 0; j < phi.count; ++j) {
        ASSERT_GE(phi.index[j], 0) << text;
        ASSERT_LT(phi.index[j], rig.shVectors()) << text;
      }
    }
    RigBasis atNan, atCentre;
    rig.basis({nan, nan, nan}, atNan);
    const RigBox box = boxOf(surface);
    rig.basis((box.lo + box.hi) * 0.5f, atCentre);
    for (int j = 0; j < atCentre.count; ++j) EXPECT_EQ(atNan.value[j], atCentre.value[j]) << text;
  }
}

TEST(RigHardCases, RefusesShapesThatAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RigSpec spec = specOf("poly:6");
  const std::vector<Vec3> surface = ellipsoid({}, {1, 1, 1}, 50);
  EXPECT_FALSE(Rig::create(spec, {boxOf(surface), {}}));
  EXPECT_FALSE(Rig::create(spec, {{{1, 0, 0}, {0, 1, 1}}, surface}));
  EXPECT_FALSE(Rig::create(spec, {{{nan, 0, 0}, {1, 1, 1}}, surface}));
  std::vector<Vec3> broken = surface;
  broken[7].y = nan;
  EXPECT_FALSE(Rig::create(spec, {boxOf(surface), broken}));
}

}  // namespace
}  // namespace rigel::test
