#include "pareto/configurations.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

TEST(Configurations, CoverEveryFamilyOverItsSizes) {
  std::map<std::string, std::set<int>> sizes;
  for (const RigSpec& spec : paretoRigs()) sizes[familyOf(spec)].insert(spec.shVectors());
  for (const char* family :
       {"constant", "gradient", "lattice", "mixed", "poly", "invquad", "auto", "rbf", "latticegrad", "hermite"})
    EXPECT_TRUE(sizes.contains(family)) << family;
  for (const char* family : {"lattice", "mixed", "poly", "invquad", "rbf", "latticegrad", "hermite"})
    EXPECT_GE(sizes[family].size(), 4u) << family;
}

TEST(Configurations, CoverNearLightsAndBands) {
  const std::vector<RigSpec> rigs = *parseRigSpecs("poly:6;auto");
  const std::vector<int> bands{2, 3, 4, 5};
  const auto all = configurations(rigs, bands);
  ASSERT_EQ(all.size(), 8u);
  for (const RigFamilyMember& member : all) {
    std::set<std::string> near;
    for (const NearSetting& setting : member.near) near.insert(nearText(setting));
    if (!member.spec.adaptive) {
      EXPECT_THAT(near, testing::IsSupersetOf({"0", "1", "2", "4", "auto"}));
      EXPECT_EQ(nearText(member.near.front()), "0") << "the first leaves all light in the rig";
    } else {
      EXPECT_TRUE(near.contains("auto"));
    }
    for (const NearSetting& setting : member.near)
      EXPECT_EQ(setting.near.automatic || member.spec.adaptive, setting.target.has_value());
  }
}

TEST(Configurations, ArgumentsAreThoseOfTheReport) {
  const RigSpec poly = *parseRigSpec("poly:6"), adaptive = *parseRigSpec("auto");
  const LightingTarget total{LightingTarget::Kind::totalError, 0.02f};
  EXPECT_EQ(argumentsOf(poly, {{false, 2}, {}}, 4), "--rig poly:6 --near 2 --bands 4");
  EXPECT_EQ(argumentsOf(poly, {{true, 0}, total}, 3), "--rig poly:6 --near auto --total-error 0.02 --bands 3");
  EXPECT_EQ(argumentsOf(adaptive, {{true, 0}, total}, 3), "--rig auto --total-error 0.02 --bands 3");
  // And they ask for the same of a rig.
  const LightingOptions asked = lightingOptions(poly, runOptionsFor(poly, {{true, 0}, total}, 3));
  EXPECT_EQ(asked.target.kind, total.kind);
  EXPECT_EQ(asked.target.value, total.value);
  EXPECT_EQ(lightingOptions(poly, runOptionsFor(poly, {{false, 2}, {}}, 3)).nearSlots, 2);
}

TEST(Configurations, FamiliesAreNamedByTheirSpecs) {
  const auto fitOfText = [](const char* text) { return fitOf(*parseRigSpec(text)); };
  EXPECT_EQ(familyOf(*parseRigSpec("gradient@numeric")), "gradient");
  EXPECT_EQ(familyOf(*parseRigSpec("lattice:3x2x2:smooth")), "lattice");
  EXPECT_EQ(fitOfText("gradient@numeric"), "numeric");
  EXPECT_EQ(fitOfText("lattice:3x2x2"), "corners");
  EXPECT_EQ(fitOfText("lattice:3x2x2@gauss"), "gauss");
  EXPECT_EQ(fitOfText("mixed:l3,g,c@lsq"), "lsq");
  EXPECT_EQ(fitOfText("poly:6"), "");
}

}  // namespace
}  // namespace rigel::tests
