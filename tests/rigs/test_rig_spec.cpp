#include "rig_fixture.h"

#include <gmock/gmock.h>

namespace rigel::test {
namespace {

using ::testing::HasSubstr;

TEST(RigSpec, CountsShVectors) {
  const std::vector<std::pair<std::string, int>> cases = {
      {"constant", 1},       {"gradient", 4},           {"gradient@numeric", 4},  {"lattice:3x2x2", 12},
      {"lattice:8x4x2", 64}, {"lattice:1x1x1", 1},      {"mixed:l3,g,c", 6},      {"mixed:xyz:c,c,l5", 5},
      {"mixed:l2,l3,g", 12}, {"mixed:l2,g,g", 6},       {"mixed:g,g,g", 4},       {"poly:12", 12},
      {"auto", 24},          {"invquad:6", 6},          {"auto:20", 20},          {"rbf:12", 12},
      {"rbf:64", 64},        {"latticegrad:2x2x1", 16}, {"latticegrad:1x1x1", 4}, {"hermite:3x2x2", 48}};
  for (const auto& [text, vectors] : cases) EXPECT_EQ(specOf(text).shVectors(), vectors) << text;
}

TEST(RigSpec, KeepsTextWithoutBlanks) { EXPECT_EQ(specOf(" mixed: l3, g ,c ").text, "mixed:l3,g,c"); }

TEST(RigSpec, DefaultsToThePapersFit) {
  EXPECT_EQ(specOf("lattice:3x2x2").fit, FitMethod::corners);
  EXPECT_EQ(specOf("mixed:l3,g,c").fit, FitMethod::corners);
  EXPECT_EQ(specOf("poly:6").fit, FitMethod::lsq);
  EXPECT_EQ(specOf("lattice:3x2x2@gauss").fit, FitMethod::gauss);
}

TEST(RigSpec, RefusesWithTheSpecAndTheCause) {
  const std::vector<std::pair<std::string, std::string>> cases = {{"", "empty"},
                                                                  {"spline:4", "unknown rig model"},
                                                                  {"constant:2", "unknown rig model"},
                                                                  {"lattice:3x2", "three node counts"},
                                                                  {"lattice:3x2x0", "'0' is not a node count"},
                                                                  {"lattice:3x2x-1", "'-1' is not a node count"},
                                                                  {"lattice:3x2x99999999999", "is not a node count"},
                                                                  {"lattice:3x2x2:box", "unknown kernel 'box'"},
                                                                  {"lattice:3x2x2:linear:linear", "too many ':'"},
                                                                  {"lattice:64x64x64", "at most 512"},
                                                                  {"lattice:9x4x2@lsq", "at most 64"},
                                                                  {"mixed:l3,g", "three axis models"},
                                                                  {"mixed:l3,g,q", "unknown axis model 'q'"},
                                                                  {"mixed:l,g,c", "unknown axis model 'l'"},
                                                                  {"poly:0", "not a number of terms"},
                                                                  {"poly:57", "not a number of terms"},
                                                                  {"poly:six", "'six' is not a number of terms"},
                                                                  {"invquad", "unknown rig model"},
                                                                  {"invquad:0", "not a number of terms"},
                                                                  {"auto:", "'' is not a number of terms"},
                                                                  {"auto:57", "not a number of terms"},
                                                                  {"auto6", "unknown rig model"},
                                                                  {"poly:6@corners", "always least squares"},
                                                                  {"auto@corners", "always least squares"},
                                                                  {"constant@numeric", "needs a gradient axis"},
                                                                  {"lattice:3x2x2:smooth@gauss", "takes no kernel"},
                                                                  {"lattice:3x2x2:linear@gauss", "takes no kernel"},
                                                                  {"lattice:9x4x2@gauss", "at most 64 with @gauss"},
                                                                  {"rbf", "unknown rig model"},
                                                                  {"rbf:0", "'0' is not a number of centres"},
                                                                  {"rbf:65", "from 1 to 64"},
                                                                  {"rbf:6@corners", "always least squares"},
                                                                  {"latticegrad:3x2", "as in latticegrad:3x2x2"},
                                                                  {"latticegrad:0x2x2", "'0' is not a node count"},
                                                                  {"latticegrad:2x2x2:cubic", "64 nodes"},
                                                                  {"latticegrad:2x2x2:box", "unknown kernel 'box'"},
                                                                  {"latticegrad:2x2x2@lsq", "spread over the box"},
                                                                  {"latticegrad:8x5x4", "640 SH vectors; at most 512"},
                                                                  {"hermite:2x2", "as in hermite:3x2x2"},
                                                                  {"hermite:2x2x2:smooth", "hermite takes no kernel"},
                                                                  {"hermite:2x2x2@gauss", "spread over the box"},
                                                                  {"hermite:8x4x5", "at most 512"},
                                                                  {"gradient@gaus", "unknown suffix '@gaus'"},
                                                                  {"gradient@", "unknown suffix '@'"}};
  for (const auto& [text, cause] : cases) {
    const auto spec = parseRigSpec(text);
    ASSERT_FALSE(spec) << text;
    EXPECT_THAT(spec.error().line(), HasSubstr(cause)) << text;
    EXPECT_THAT(spec.error().line(), HasSubstr("rig spec '" + text + "'"));
  }
}

TEST(RigSpec, AutoIsAnAdaptivePolynomial) {
  const RigSpec spec = specOf("auto:9");
  EXPECT_EQ(spec.family, RigSpec::Family::poly);
  EXPECT_EQ(spec.fit, FitMethod::lsq);
  EXPECT_TRUE(spec.adaptive);
  EXPECT_FALSE(specOf("poly:9").adaptive);
  EXPECT_NE(spec, specOf("poly:9"));
  EXPECT_EQ(specOf("auto"), specOf("auto:24"));
}

TEST(RigSpec, ModelsThatWereDroppedAreOthersThanThoseTheyResemble) {
  EXPECT_EQ(specOf("latticegrad:3x2x2"), specOf("latticegrad:3x2x2:linear@corners"));
  EXPECT_EQ(specOf("rbf:6"), specOf("rbf:6@lsq"));
  EXPECT_NE(specOf("latticegrad:3x2x2"), specOf("latticegrad:3x2x2:smooth"));
  EXPECT_NE(specOf("latticegrad:3x2x2"), specOf("hermite:3x2x2"));
  EXPECT_NE(specOf("latticegrad:3x2x2"), specOf("lattice:3x2x2"));
  EXPECT_NE(specOf("rbf:6"), specOf("poly:6"));
  EXPECT_NE(specOf("rbf:6"), specOf("rbf:7"));
}

TEST(RigSpec, ParsesLists) {
  const auto specs = parseRigSpecs("constant; gradient;poly:6");
  ASSERT_TRUE(specs);
  EXPECT_EQ(specs->size(), 3u);
  EXPECT_FALSE(parseRigSpecs(""));
  EXPECT_FALSE(parseRigSpecs("constant;"));
  const auto twice = parseRigSpecs("poly:6; poly: 6");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().line(), HasSubstr("given twice"));
  const auto same = parseRigSpecs("lattice:3x2x2;mixed:l3,l2,l2@corners");
  ASSERT_FALSE(same);
  EXPECT_THAT(same.error().line(), HasSubstr("the same rig as 'lattice:3x2x2'"));
}

TEST(RigSpec, ChecksSpecsThatWereNotParsed) {
  RigSpec spec;
  EXPECT_FALSE(checkRigSpec(spec)) << "the default is a constant rig";
  spec.axes[0] = {AxisModel::Kind::lattice, 65};
  EXPECT_TRUE(checkRigSpec(spec));
  spec.axes[0] = {AxisModel::Kind::lattice, 0};
  EXPECT_TRUE(checkRigSpec(spec));
  spec.axes[0] = {AxisModel::Kind::gradient, 3};
  EXPECT_TRUE(checkRigSpec(spec));
  spec = {};
  spec.family = RigSpec::Family::poly;
  for (int terms : {-1, 0, kMaxPolyTerms + 1}) {
    spec.terms = terms;
    EXPECT_TRUE(checkRigSpec(spec)) << terms;
    EXPECT_FALSE(Rig::create(spec, {{{0, 0, 0}, {1, 1, 1}}, ellipsoid({}, {1, 1, 1}, 20)})) << terms;
  }
  spec = {};
  spec.family = RigSpec::Family::rbf;
  for (int centres : {-1, 0, kMaxLsqVectors + 1}) {
    spec.terms = centres;
    EXPECT_TRUE(checkRigSpec(spec)) << centres;
  }
  for (const auto family : {RigSpec::Family::latticegrad, RigSpec::Family::hermite}) {
    spec = {};
    spec.family = family;
    EXPECT_FALSE(checkRigSpec(spec)) << "one node";
    spec.axes[1] = {AxisModel::Kind::gradient, 1};
    EXPECT_TRUE(checkRigSpec(spec)) << "its slopes are no axis model";
    spec = {};
    spec.family = family;
    spec.fit = FitMethod::numeric;
    EXPECT_TRUE(checkRigSpec(spec));
    spec = {};
    spec.family = family;
    spec.kernel = LatticeKernel::cubic;
    EXPECT_TRUE(checkRigSpec(spec));
  }
  spec = {};
  spec.adaptive = true;
  EXPECT_TRUE(checkRigSpec(spec)) << "a constant rig has nothing to adapt";
  spec = {};
  spec.falloff = true;
  EXPECT_TRUE(checkRigSpec(spec)) << "a falloff times a constant is a polynomial rig's";
  EXPECT_NE(specOf("invquad:6"), specOf("poly:6"));
}

}  // namespace
}  // namespace rigel::test
