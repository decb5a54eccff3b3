// Effects of a report: the names that report.json has, and what calls for each.
#include "report/run/effects.h"

#include <gmock/gmock.h>

namespace rigel::tools {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ObjectReport withNear(const std::string& kind, float weight) {
  LightReport light;
  light.type = kind;
  if (weight > 0) light.weights = {0, weight};
  RigReport rig;
  rig.lights = {light};
  ObjectReport object;
  object.rigs = {rig};
  return object;
}

TEST(ReportEffects, NameWhatTheSceneHasSorted) {
  EXPECT_THAT(effectsOf({}, {}, {}, {}), IsEmpty());
  LightSet lights;
  lights.add(SpotLight{{0, 2, 2}, {0, -1, -1}, {1, 1, 1}});
  lights.add(SphereLight{{-2, 1, 0}, 0.2f, {5, 5, 5}});
  EXPECT_THAT(effectsOf(lights, {}, {}, {}), ElementsAre("light.sphere", "light.spot"));
  const float wraps[] = {0, 0.5f};
  EXPECT_THAT(effectsOf({}, wraps, {}, {}), ElementsAre("material.wrap"));
  EXPECT_THAT(effectsOf({}, std::span(wraps).first(1), {}, {}), IsEmpty());
}

TEST(ReportEffects, NameWhatRigsDid) {
  const RigSpec rigs[] = {*parseRigSpec("poly:6"), *parseRigSpec("auto")};
  EXPECT_THAT(effectsOf({}, {}, rigs, {}), ElementsAre("rig.auto"));
  EXPECT_THAT(effectsOf({}, {}, std::span(rigs).first(1), {}), IsEmpty());
  ObjectReport object = withNear("spot", 0);
  EXPECT_THAT(effectsOf({}, {}, {}, {&object, 1}), IsEmpty()) << "near in no frame";
  object.rigs[0].highBandFrames = 1;
  EXPECT_THAT(effectsOf({}, {}, {}, {&object, 1}), ElementsAre("rig.high_band"));
}

TEST(ReportEffects, NameNearLightsByTheirKind) {
  const float wrap = 0.5f;
  for (const std::string kind : {"directional", "point", "spot", "sphere"}) {
    const ObjectReport object = withNear(kind, 0.5f);
    EXPECT_THAT(effectsOf({}, {}, {}, {&object, 1}), ElementsAre("light.near." + kind));
    EXPECT_THAT(effectsOf({}, {&wrap, 1}, {}, {&object, 1}),
                testing::UnorderedElementsAre("light.near." + kind, "light.near.wrap", "material.wrap"));
  }
  const ObjectReport object = withNear("disk", 0.5f);
  EXPECT_THAT(effectsOf({}, {}, {}, {&object, 1}), ElementsAre("light.near.disk"));
  EXPECT_THAT(effectsOf({}, {&wrap, 1}, {}, {&object, 1}),
              ElementsAre("light.near.disk", "light.near.disk_quadrature", "light.near.wrap", "material.wrap"));
}

}  // namespace
}  // namespace rigel::tools
