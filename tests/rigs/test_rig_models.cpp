#include "rig_fixture.h"

#include <algorithm>

namespace rigel::test {
namespace {

const auto kBody = ellipsoid({0.5f, 1, -2}, {2, 0.4f, 0.8f}, 600);

std::vector<Vec3> probes(const std::vector<Vec3>& surface, int count, unsigned seed) {
  const RigBox box = boxOf(surface);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p;
    for (int a = 0; a < 3; ++a) p[a] = box.lo[a] + unit(random) * (box.hi[a] - box.lo[a]);
    points.push_back(p);
  }
  return points;
}

/// Largest difference of rig and field, for a field and its gradient: over the box, but where the rig was fitted to the
/// surface over that (on an ellipsoid x^2 + y^2 + z^2 is constant, so off it the fit says little).
template <class AnyRig, class Field, class Gradient>
float worstError(AnyRig&& rig, Field field, Gradient gradient) {
  const auto fitted = fitField(rig, field, gradient);
  float worst = 0;
  for (Vec3 p : rig.anchors().empty() ? probes(kBody, 200, 7) : kBody)
    worst = std::max(worst, std::abs(fitted(p) - field(p)));
  return worst;
}

TEST(RigModels, EveryKindReproducesConstantLight) {
  for (const std::string& text : everyKindOfSpec()) {
    Rig rig = rigOf(text, kBody);
    EXPECT_EQ(rig.shVectors(), specOf(text).shVectors()) << text;
    EXPECT_LT(worstError(
                  rig, [](Vec3) { return 3.0f; }, [](Vec3) { return Vec3{}; }),
              2e-5f)
        << text;
  }
}

TEST(RigModels, ProjectionsCountFunctionals) {
  const std::vector<std::pair<std::string, int>> cases = {{"constant", 1},
                                                          {"gradient", 4},
                                                          {"gradient@numeric", 7},
                                                          {"lattice:3x2x2", 12},
                                                          {"mixed:l3,g,c", 6},
                                                          {"mixed:l3,g,c@numeric", 9},
                                                          {"poly:6", 12},
                                                          {"invquad:4", 24},
                                                          {"invquad:20", 40},
                                                          {"lattice:3x2x2@gauss", 12},
                                                          {"mixed:l3,g,c@gauss", 6},
                                                          {"gradient@gauss", 6},
                                                          {"lattice:3x2x2@lsq", 24}};
  for (const auto& [text, projections] : cases) EXPECT_EQ(rigOf(text, kBody).projections(), projections) << text;
}

TEST(RigModels, TakesMoreAnchorsWhereTwoAVectorDoNotTell) {
  int raised = 0;
  for (const float thin : {1.0f, 0.3f, 0.1f, 0.03f}) {
    auto body = ellipsoid({}, {1, thin, 0.5f}, 400);
    for (Vec3 p : ellipsoid({0.8f, 0.6f, 0.1f}, {0.1f, 0.6f, 0.1f}, 100)) body.push_back(p);
    for (Vec3 p : ellipsoid({-0.6f, -0.2f, 0.5f}, {0.2f, 0.1f, 0.7f}, 100)) body.push_back(p);
    for (const char* spec : {"poly:4", "poly:12", "poly:30", "lattice:3x2x2@lsq", "lattice:4x3x2@lsq"}) {
      const Rig rig = rigOf(spec, body);
      EXPECT_GE(rig.projections(), 2 * rig.shVectors()) << spec;
      EXPECT_LE(rig.projections(), std::min(4 * rig.shVectors(), 128)) << spec;
      if (rig.projections() > 2 * rig.shVectors()) ++raised;
    }
  }
  EXPECT_GT(raised, 0);
}

TEST(RigModels, SharesOfTheSurfaceSumToOne) {
  for (const std::string& text : everyKindOfSpec()) {
    Rig rig = rigOf(text, kBody);
    float sum = 0;
    for (const RigSample& sample : rig.samples()) sum += sample.share;
    EXPECT_NEAR(sum, rig.anchors().empty() ? 0 : 1, 1e-6f) << text;
  }
}

TEST(RigModels, AutoIsThePolynomialOfItsTermsAnchoredAtTheEndsOfTheBody) {
  const Rig rig = rigOf("auto:7", kBody), poly = rigOf("poly:7", kBody);
  EXPECT_EQ(rig.shVectors(), 7);
  // An end takes the place of the cluster that it would have been the seed of.
  EXPECT_LE(rig.projections(), poly.projections());
  EXPECT_GE(rig.projections(), poly.projections() - 6);
  RigBasis a, b;
  for (Vec3 p : probes(kBody, 50, 9)) {
    rig.basis(p, a);
    poly.basis(p, b);
    for (int k = 0; k < 7; ++k) EXPECT_EQ(a.value[k], b.value[k]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto [first, last] = std::ranges::minmax_element(kBody, {}, [axis](Vec3 p) { return p[axis]; });
    for (const auto end : {first, last})
      EXPECT_TRUE(std::ranges::any_of(rig.anchors(), [&](int i) { return kBody[i] == *end; })) << axis;
  }
}

TEST(RigModels, LinearLightIsExactWhereTheModelSpansIt) {
  const auto field = [](Vec3 p) { return 1 + 0.5f * p.x - 2 * p.y + 0.25f * p.z; };
  const auto gradient = [](Vec3) { return Vec3{0.5f, -2, 0.25f}; };
  for (const std::string text :
       {"gradient", "gradient@numeric", "gradient@lsq", "lattice:2x2x2", "lattice:3x2x2", "lattice:4x3x2:cubic",
        "lattice:3x2x2@lsq", "gradient@gauss", "lattice:3x2x2@gauss", "mixed:l3,g,g@gauss", "mixed:l3,g,g",
        "mixed:l3,g,g@numeric", "mixed:xyz:g,l4,l2", "poly:12", "poly:20"}) {
    // 3e-5: float rounding of values around 4 through the fit; least squares adds its pull, 1e-6 times the condition.
    EXPECT_LT(worstError(rigOf(text, kBody), field, gradient), 3e-4f) << text;
  }
}

TEST(RigModels, PolyReproducesEveryMonomialItKeeps) {
  // poly:10 of a sphere, whose axes are alike, is all monomials up to degree 2.
  const auto sphere = ellipsoid({3, -1, 2}, {1, 1, 1}, 600);
  Rig rig = rigOf("poly:10", sphere);
  const auto field = [](Vec3 p) { return 0.3f * p.x * p.y - p.z * p.z + 2 * p.y - 0.7f * p.x * p.z + 1; };
  const auto fitted = fitField(rig, field, [](Vec3) { return Vec3{}; });
  for (Vec3 p : sphere) EXPECT_NEAR(fitted(p), field(p), 2e-3f);
}

TEST(RigModels, GaussReproducesPolynomialsOfItsNodes) {
  // kBody is longest along x (three nodes), then z and y (two each): quadratic in x, linear in the others.
  const auto field = [](Vec3 p) { return (1 + p.x - 0.5f * p.x * p.x) * (2 - p.y) * (1 + 0.25f * p.z); };
  EXPECT_LT(worstError(rigOf("lattice:3x2x2@gauss", kBody), field, [](Vec3) { return Vec3{}; }), 5e-5f);
}

TEST(RigModels, GaussSamplesMoveWithTheBox) {
  Rig rig = rigOf("lattice:3x2x2@gauss", kBody);
  const std::vector<RigSample> rest(rig.samples().begin(), rig.samples().end());
  const RigBox box = boxOf(kBody);
  rig.setPose({{box.lo * 2 + Vec3{1, 0, 0}, box.hi * 2 + Vec3{1, 0, 0}}, {}});
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT(length(rig.samples()[i].position - (rest[i].position * 2 + Vec3{1, 0, 0})), 1e-5f);
    EXPECT_FLOAT_EQ(rig.samples()[i].footprint, 2 * rest[i].footprint);
  }
}

TEST(RigModels, InvquadFollowsTheFalloffOfALight) {
  // One light half the body's length off its side: 1/d^2 is a falloff, whatever the number of terms.
  const auto field = [](Vec3 p) { return 1 / dot(p - Vec3{1, 3, -2}, p - Vec3{1, 3, -2}); };
  const auto none = [](Vec3) { return Vec3{}; };
  const float polynomial = worstError(rigOf("poly:6", kBody), field, none);
  // What is left: the pull of the falloff towards the constant, and what its rounds leave open on an ellipsoid.
  EXPECT_LT(worstError(rigOf("invquad:6", kBody), field, none), 0.25f * polynomial) << polynomial;
}

TEST(RigModels, ANewPoseForgetsTheFalloff) {
  Rig rig = rigOf("invquad:6", kBody);
  const auto field = [](Vec3 p) { return 1 / dot(p - Vec3{1, 3, -2}, p - Vec3{1, 3, -2}); };
  (void)fitField(rig, field, [](Vec3) { return Vec3{}; });
  RigBasis phi;
  rig.basis(kBody[3], phi);
  EXPECT_GT(std::abs(phi.value[0] - 1), 0.01f);
  std::vector<Vec3> anchors;
  for (int i : rig.anchors()) anchors.push_back(kBody[i]);
  rig.setPose({boxOf(kBody), anchors});
  rig.basis(kBody[3], phi);
  EXPECT_FLOAT_EQ(phi.value[0], 1);
}

TEST(RigModels, AxesGoByDecreasingExtentUnlessPinned) {
  // kBody is longest along x, then z, then y: the lattice of mixed:l3,g,c is along x and its slope along z.
  const auto alongX = [](Vec3 p) { return p.x; };
  const auto alongY = [](Vec3 p) { return p.y; };
  const auto alongZ = [](Vec3 p) { return p.z; };
  const auto unit = [](int axis) {
    return [axis](Vec3) {
      Vec3 v;
      v[axis] = 1;
      return v;
    };
  };
  Rig byExtent = rigOf("mixed:l3,g,c", kBody);
  EXPECT_LT(worstError(byExtent, alongX, unit(0)), 1e-5f);
  EXPECT_LT(worstError(byExtent, alongZ, unit(2)), 1e-5f);
  EXPECT_GT(worstError(byExtent, alongY, unit(1)), 0.1f);
  Rig pinned = rigOf("mixed:xyz:l3,g,c", kBody);
  EXPECT_LT(worstError(pinned, alongY, unit(1)), 1e-5f);
  EXPECT_GT(worstError(pinned, alongZ, unit(2)), 0.1f);
}

TEST(RigModels, LatticeInterpolatesItsSamples) {
  const auto field = [](Vec3 p) { return std::sin(3 * p.x) + std::cos(2 * p.y) * p.z; };
  for (const std::string text : {"lattice:3x2x2", "lattice:8x4x2", "lattice:4x3x2:cubic", "lattice:3x2x2:smooth",
                                 "lattice:3x2x2@gauss", "lattice:8x4x2@gauss"}) {
    Rig rig = rigOf(text, kBody);
    const auto fitted = fitField(rig, field, [](Vec3) { return Vec3{}; });
    for (const RigSample& sample : rig.samples()) EXPECT_NEAR(fitted(sample.position), field(sample.position), 1e-5f);
  }
}

TEST(RigModels, MixedOfOneKindIsThatKind) {
  const auto field = [](Vec3 p) { return p.x * p.x + p.y * p.z; };
  const auto gradient = [](Vec3 p) { return Vec3{2 * p.x, p.z, p.y}; };
  const std::vector<std::pair<std::string, std::string>> same = {
      {"constant", "mixed:c,c,c"}, {"gradient", "mixed:g,g,g"}, {"lattice:3x2x2", "mixed:l3,l2,l2"}};
  for (const auto& [a, b] : same) {
    Rig rigA = rigOf(a, kBody);
    Rig rigB = rigOf(b, kBody);
    const auto fitA = fitField(rigA, field, gradient);
    const auto fitB = fitField(rigB, field, gradient);
    for (Vec3 p : probes(kBody, 50, 9)) EXPECT_EQ(fitA(p), fitB(p)) << a;
  }
}

TEST(RigModels, PoseMovesSamplesAndKeepsTheFit) {
  // The body stretched and bent: riding anchors still reproduce what the model spans.
  std::vector<Vec3> bent;
  for (Vec3 p : kBody) bent.push_back({p.x * 1.5f, p.y + 0.2f * p.x * p.x, p.z - 1});
  Rig rig = rigOf("poly:12", kBody);
  std::vector<Vec3> anchors;
  for (int i : rig.anchors()) anchors.push_back(bent[i]);
  rig.setPose({boxOf(bent), anchors});
  const auto field = [](Vec3 p) { return 2 - p.x + 0.5f * p.z + p.y; };
  const auto fitted = fitField(rig, field, [](Vec3) { return Vec3{}; });
  for (Vec3 p : bent) EXPECT_NEAR(fitted(p), field(p), 1e-3f);
  EXPECT_LT(rig.condition(), 1e3);
}

}  // namespace
}  // namespace rigel::test
