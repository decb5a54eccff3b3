// Effects: their list, what calls for them, and that no stage runs uncalled.
#include <gmock/gmock.h>
#include <rigel/effects.h>

#include <set>

#include "rigs/lighting_fixture.h"

namespace rigel {
namespace {

using testing::ElementsAre;

LightSet oneOfEach() {
  LightSet lights;
  lights.add(DirectionalLight{{0, -1, 0}, {1, 1, 1}});
  lights.add(PointLight{{2, 2, 0}, {1, 1, 1}});
  lights.add(SpotLight{{0, 2, 2}, {0, -1, -1}, {1, 1, 1}});
  lights.add(SphereLight{{-2, 1, 0}, 0.2f, {5, 5, 5}});
  lights.add(DiskLight{{0, 3, 0}, {0, -1, 0}, 0.4f, {5, 5, 5}});
  return lights;
}

TEST(Effects, NamesAndIdsAreTheirOwn) {
  std::set<std::string> names;
  std::set<int> ids;
  for (const Effect effect : kAllEffects) {
    names.insert(effectName(effect));
    ids.insert(static_cast<int>(effect));
  }
  EXPECT_EQ(names.size(), std::size(kAllEffects));
  EXPECT_EQ(ids.size(), std::size(kAllEffects));
  EXPECT_LT(*ids.rbegin(), 64) << "they are bits";
  EXPECT_TRUE(names.contains("light.near.sphere"));
  EXPECT_TRUE(names.contains("rig.high_band"));
  EXPECT_TRUE(names.contains("light.near.disk_quadrature"));
}

TEST(Effects, Sets) {
  Effects effects{Effect::light_point, Effect::rig_poly};
  EXPECT_TRUE(effects.has(Effect::rig_poly));
  EXPECT_FALSE(effects.has(Effect::rig_tensor));
  EXPECT_FALSE(effects.hasAny(kNearEffects));
  effects.add(Effects{Effect::light_near_spot});
  EXPECT_TRUE(effects.hasAny(kNearEffects));
  effects.remove(Effect::light_near_spot);
  effects.remove(Effect::light_point);
  EXPECT_EQ(effects, Effects{Effect::rig_poly});
  EXPECT_TRUE(Effects{}.empty());
}

TEST(Effects, OfLights) {
  EXPECT_TRUE(lightEffects({}).empty());
  EXPECT_EQ(lightEffects(oneOfEach()), (Effects{Effect::light_directional, Effect::light_point, Effect::light_spot,
                                                Effect::light_sphere, Effect::light_disk}));
  const NearLight near[] = {nearLight(SphereLight{{0, 1, 0}, 0.1f, {1, 1, 1}}),
                            nearLight(PointLight{{0, 1, 0}, {1, 1, 1}}, 0)};
  EXPECT_EQ(nearEffects(near, 0), Effects{Effect::light_near_sphere}) << "the point light has no share";
  EXPECT_EQ(nearEffects(near, 0.5f), (Effects{Effect::light_near_sphere, Effect::light_near_wrap}));
  EXPECT_TRUE(nearEffects({}, 0.5f).empty());
  NearLight disk;
  disk.kind = NearLight::Kind::disk;
  EXPECT_EQ(nearEffects({&disk, 1}, 0), Effects{Effect::light_near_disk}) << "Lambert takes no bands";
  EXPECT_EQ(nearEffects({&disk, 1}, 0.5f),
            (Effects{Effect::light_near_disk, Effect::light_near_wrap, Effect::light_near_diskQuadrature}));
}

TEST(Effects, OfRigs) {
  EXPECT_EQ(rigEffects(*parseRigSpec("constant")), Effects{Effect::rig_constant});
  EXPECT_EQ(rigEffects(*parseRigSpec("mixed:l3,g,c")), Effects{Effect::rig_tensor});
  EXPECT_EQ(rigEffects(*parseRigSpec("lattice:3x2x2@gauss")), (Effects{Effect::rig_tensor, Effect::rig_gauss}));
  EXPECT_EQ(rigEffects(*parseRigSpec("poly:6")), Effects{Effect::rig_poly});
  EXPECT_EQ(rigEffects(*parseRigSpec("invquad:6")), Effects{Effect::rig_invquad});
  EXPECT_EQ(rigEffects(*parseRigSpec("auto")), (Effects{Effect::rig_auto, Effect::rig_poly}));
  EXPECT_EQ(rigEffects(*parseRigSpec("rbf:6")), Effects{Effect::rig_rbf});
  EXPECT_EQ(rigEffects(*parseRigSpec("latticegrad:2x1x1")), Effects{Effect::rig_latticegrad});
  EXPECT_EQ(rigEffects(*parseRigSpec("hermite:2x1x1")), Effects{Effect::rig_hermite});
}

std::set<LightingStage> stagesOf(ObjectLighting<3>& lighting, const LightSet& lights) {
  std::set<LightingStage> ran;
  const auto note = [](void* stages, LightingStage stage) {
    static_cast<std::set<LightingStage>*>(stages)->insert(stage);
  };
  lighting.light(lights, 0.03f, {}, {note, &ran});
  return ran;
}

TEST(Effects, NoStageRunsUncalled) {
  constexpr LightingStage kAll[] = {LightingStage::bound, LightingStage::choose, LightingStage::project,
                                    LightingStage::fit, LightingStage::estimate};
  int compared = 0, absent = 0;
  for (const char* spec :
       {"constant", "poly:6", "lattice:3x2x2", "rbf:6", "latticegrad:2x1x1", "hermite:2x1x1", "auto"}) {
    for (const int slots : {0, 2}) {
      for (const bool estimate : {false, true}) {
        LightingOptions options;
        options.nearSlots = slots;
        options.estimate = estimate;
        if (std::string_view(spec) == "auto") options.target = {LightingTarget::Kind::spatialError, 0.05f};
        const test::Body body = test::ellipsoidBody({0.3f, 0.5f, 0.2f}, 512);
        auto lighting = *ObjectLighting<3>::create(*parseRigSpec(spec), body.shape(), options);
        const auto ran = stagesOf(lighting, oneOfEach());
        const Effects effects = frameEffects(lighting, 0);
        for (const LightingStage stage : kAll) {
          ++compared;
          const bool called = callsFor(stage, effects, options);
          absent += called ? 0 : 1;
          EXPECT_EQ(ran.contains(stage), called)
              << spec << ", " << slots << " slots, stage " << static_cast<int>(stage);
        }
      }
    }
  }
  EXPECT_EQ(compared, 7 * 2 * 2 * 5);
  EXPECT_GT(absent, 5);
}

TEST(Effects, OfAFrame) {
  LightSet far;
  far.add(DirectionalLight{{0, -1, 0}, {1, 1, 1}});
  const test::Body body = test::ellipsoidBody({0.3f, 0.5f, 0.2f}, 512);
  LightingOptions options;
  options.nearSlots = 2;
  auto lighting = *ObjectLighting<3>::create(*parseRigSpec("poly:6"), body.shape(), options);
  lighting.light(far, 0.03f);
  EXPECT_EQ(frameEffects(lighting, 0), Effects{Effect::rig_poly})
      << "a distant light alone is no reason for near lights";
  EXPECT_EQ(frameEffects(lighting, 0.3f), (Effects{Effect::rig_poly, Effect::material_wrap}));
  far.add(SphereLight{{0, 0.7f, 0}, 0.1f, {5, 5, 5}});
  lighting.reset();
  lighting.light(far, 0.03f);
  EXPECT_TRUE(frameEffects(lighting, 0).has(Effect::light_near_sphere));
}

}  // namespace
}  // namespace rigel
