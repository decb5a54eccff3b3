// A frame allocates nothing once everything has its size.
#include <rigel/light_tree.h>
#include <rigel/near_far.h>
#include <rigel/object_lighting.h>
#include <rigel/probed_bounds.h>

#include "counted_allocations.h"
#include "crowd_fixture.h"

#include <cstdlib>

namespace rigel::test {
namespace {

TEST(RigAllocation, CountsWhatItShould) {
  const long before = allocations;
  // Through a volatile pointer, or the compiler leaves the pair out.
  int* volatile number = new int(3);
  delete number;
  void* volatile memory = std::malloc(8);
  std::free(memory);
  EXPECT_GE(allocations - before, 2);
}

TEST(RigAllocation, AFrameAllocatesNothing) {
  const auto body = ellipsoid({}, {2, 0.5f, 0.5f}, 600);
  LightSet lights;
  auto specs = everyKindOfSpec();
  specs.insert(specs.end(), {"poly:56", "lattice:8x4x2@lsq", "lattice:8x8x8"});
  for (const std::string& text : specs) {
    Rig rig = rigOf(text, body);
    std::vector<Vec3> anchors(rig.anchors().size());
    std::vector<RadianceSH<5>> functionals(rig.projections());
    std::vector<RadianceSH<5>> coefficients(rig.shVectors());
    long counted = 0;
    for (int frame = 0; frame < 4; ++frame) {
      const long before = allocations;
      const float t = static_cast<float>(frame);
      lights.clear();
      lights.add(SphereLight{{2, 3 - t, 1}, 0.3f, {20, 15, 10}});
      lights.add(DiskLight{{1, 2 - t, 0}, {0.1f, -1, t}, 0.4f, {5, 4, 3}});
      lights.add(PointLight{{t, 1, 1}, {3, 4, 5}});
      lights.add(SpotLight{{0, 4, t}, {0, -1, 0}, {30, 30, 30}});
      lights.add(DirectionalLight{{0, -1, t}, {1, 1, 1}});
      for (std::size_t i = 0; i < anchors.size(); ++i) anchors[i] = body[rig.anchors()[i]] + Vec3{t, 0, 0};
      rig.setPose({{{t - 2, -0.5f, -0.5f}, {t + 2, 0.5f, 0.5f}}, anchors});
      projectSamples<5>(rig, {}, lights, functionals);
      adaptRig<5>(rig, functionals);
      fitRig<5>(rig, functionals, coefficients);
      (void)evaluateRig<5>(rig, coefficients, {t, 0, 0});
      if (frame > 0) counted += allocations - before;
    }
    EXPECT_EQ(counted, 0) << text;
  }
}

TEST(RigAllocation, BoundsOfLightsAllocateNothing) {
  const auto body = ellipsoid({}, {2, 0.5f, 0.5f}, 600);
  for (const std::string& text : everyKindOfSpec()) {
    const Rig rig = *Rig::create(specOf(text), {boxOf(body), body, true});
    ProbedBounds bounds(rig, {});
    long before = 0;
    for (int i = 0; i < 4; ++i) {
      if (i == 1) before = allocations;
      const float t = static_cast<float>(i);
      (void)bounds(SphereLight{{2, 3 - t, 1}, 0.3f, {20, 15, 10}});
      (void)bounds(DiskLight{{1, 2 - t, 0}, {0.1f, -1, t}, 0.4f, {5, 4, 3}});
      (void)bounds(PointLight{{t, 1, 1}, {3, 4, 5}});
      (void)bounds(SpotLight{{0, 4, t}, {0, -1, 0}, {30, 30, 30}});
      (void)bounds(DirectionalLight{{0, -1, t}, {1, 1, 1}});
    }
    EXPECT_EQ(allocations, before) << text;
  }
}

TEST(RigAllocation, NearAndFarLightsAllocateNothing) {
  NearFar nearFar(NearFarOptions{4, 0, 20});
  LightSet lights, far;
  std::vector<NearLight> near;
  for (int i = 0; i < 40; ++i) lights.add(PointLight{{static_cast<float>(i), 2, 0}, {1, 1, 1}});
  std::vector<float> errors(40), half(40, 0.5f);
  std::vector<std::uint32_t> ids(40);
  const std::span<const float> halves = half;
  long counted = 0;
  for (int frame = 0; frame < 200; ++frame) {
    for (int i = 0; i < 40; ++i) {
      errors[i] = std::exp(std::sin(static_cast<float>(frame * (i % 7) + i)));
      ids[i] = static_cast<std::uint32_t>((i * 7 + frame) % 40);
    }
    const long before = allocations;
    nearFar.update(errors, ids, 1.0f / 60);
    // In the first frame every light is near in part and far in part: it cannot get more.
    splitLights(lights, frame == 0 ? halves : nearFar.weights(), far, near);
    if (frame > 0) counted += allocations - before;
  }
  EXPECT_EQ(counted, 0);
}

TEST(RigAllocation, TheLightTreeAllocatesNothingOnceItHasItsSize) {
  LightTree tree;
  LightSet lights;
  LightSelection selection;
  std::vector<std::uint32_t> moved;
  long counted = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const auto t = static_cast<float>(frame % 20);
    lights.clear();
    for (int i = 0; i < 2000; ++i) {
      const auto x = static_cast<float>(i % 50), z = static_cast<float>(i / 50);
      const Vec3 p{10 * x + t * std::sin(x), 5, 10 * z + t * std::cos(z)};
      if (i % 5 == 0)
        lights.add(SpotLight{p, {0, -1, 0.01f * t}, {9, 8, 7}}, 1u << (i % 3));
      else
        lights.add(PointLight{p, {9, 8, 7}}, 1u << (i % 2));
    }
    moved.clear();
    for (std::uint32_t i = 0; i < 2000; i += static_cast<std::uint32_t>(1 + frame % 4)) moved.push_back(i);
    const long before = allocations;
    if (frame % 3 == 0)
      tree.build(lights);
    else if (frame % 3 == 1)
      tree.update(lights);
    else
      ASSERT_TRUE(tree.refit(lights, moved));
    for (int i = 0; i < 20; ++i) {
      const Vec3 p{20 * static_cast<float>(i), 1, 3 * t};
      tree.select({.centre = p, .radius = 1, .target = 0.1f}, selection);
    }
    // The first round shows every frame that there is.
    if (frame >= 20) counted += allocations - before;
  }
  EXPECT_EQ(counted, 0);
  EXPECT_FALSE(selection.nearby.empty() || selection.distant.empty());
}

TEST(RigAllocation, ObjectLightingAllocatesNothingAfterItsFirstFrame) {
  using Kind = LightingTarget::Kind;
  const auto body = ellipsoid({}, {2, 0.5f, 0.5f}, 300);
  const auto lightsAt = [](float t, int count, LightSet& lights) {
    lights.clear();
    lights.add(DirectionalLight{{0, -1, t}, {1, 1, 1}});
    lights.add(DiskLight{{2, 2 - t, 0}, {-0.5f, -1, t}, 0.4f, {5, 4, 3}});
    lights.add(SpotLight{{0, 4, t}, {0, -1, 0}, {30, 30, 30}});
    for (int i = 0; i < count; ++i)
      lights.add(
          PointLight{{0.4f * static_cast<float>(i) - 8, 1 + 0.2f * t, 1}, {3, 4, 5}, 0.01f, i % 2 == 0 ? 6 : 60.0f});
  };
  struct Case {
    std::string spec;
    LightingTarget target;
    std::optional<int> slots;
  };
  const std::vector<Case> cases = {{"poly:6", {}, 4},
                                   {"constant", {}, 0},
                                   {"invquad:6", {}, 2},
                                   {"auto", {}, 2},
                                   {"auto", {Kind::spatialError, 0.02f}, {}},
                                   {"auto", {Kind::totalError, 0.03f}, {}},
                                   {"auto", {Kind::totalError, 0.02f}, 2},
                                   {"auto", {Kind::budget, 2000}, {}},
                                   {"poly:6", {Kind::totalError, 0.03f}, {}}};
  LightSet lights;
  for (const auto& [spec, target, slots] : cases) {
    LightingOptions options;
    options.target = target;
    options.nearSlots = slots;
    options.estimate = true;
    auto lighting = ObjectLighting<3>::create(specOf(spec), {boxOf(body), body}, options);
    ASSERT_TRUE(lighting);
    std::vector<Vec3> anchors(lighting->anchors().size());
    long counted = 0;
    for (int frame = 0; frame < 24; ++frame) {
      const float t = static_cast<float>(frame);
      // As many lights as ever in the first frame, in the last of each eight, and few or none between.
      lightsAt(t, frame % 8 == 0 ? 60 : 60 - 10 * (frame % 8), lights);
      for (std::size_t i = 0; i < anchors.size(); ++i) anchors[i] = body[lighting->anchors()[i]] + Vec3{0.2f * t, 0, 0};
      const long before = allocations;
      lighting->setPose({{{0.2f * t - 2, -0.5f, -0.5f}, {0.2f * t + 2, 0.5f, 0.5f}}, anchors}, {});
      if (frame % 5 == 4) lighting->reset();
      if (options.target.kind == Kind::spatialError && frame % 2 == 1) {
        lighting->weigh(lights, 1.0f / 60);
        (void)lighting->costAt(0.1f);
        lighting->settle(lights, 0.1f, 1.0f / 60);
      } else {
        lighting->light(lights, 1.0f / 60);
      }
      (void)lighting->shade({}, {0, 1, 0}, MaterialWrap<3>(0));
      constexpr float kZero[2] = {0, 0}, kOne[2] = {1, 1};
      ObjectLighting<3>::Parts parts[2];
      lighting->shade({kZero, kZero, kZero}, {kZero, kOne, kZero}, MaterialWrap<3>(0.5f), parts);
      if (frame > 0) counted += allocations - before;
    }
    EXPECT_EQ(counted, 0) << spec << ", target " << static_cast<int>(options.target.kind) << ", slots "
                          << options.slots();
  }
}

// Characters and lights come and go, poses and rates change: nothing grows.
TEST(RigAllocation, ACrowdAllocatesNothingHoweverLongItRuns) {
  const BendingBody body;
  Stage<3> stage(2);
  const int kinds[] = {stage.crowd.addKind(kindOf("poly:6", body.shape())),
                       stage.crowd.addKind(kindOf("poly:4", body.rigidShape()))};
  std::vector<CrowdId> ids;
  for (int c = 0; c < 24; ++c) ids.push_back(stage.crowd.add(kinds[c % 2]));
  stage.makeRoom();
  const auto palette = BendingBody::palette(0.3f);
  const auto light = [&](int frame) {
    stage.lights.clear();
    stage.ids.clear();
    for (int i = 0; i < 12 - frame % 4; ++i) {
      const float t = static_cast<float>((i + frame) % 12);
      stage.lights.add(PointLight{{0.5f * t - 3, 1, 1}, {3, 4, 5}});
      if (i % 4 == 0) stage.lights.add(DiskLight{{t, 2, 0}, {0, -1, 0}, 0.3f, {5, 4, 3}});
    }
    for (int i = 0; i < stage.lights.size(); ++i) stage.ids.push_back(static_cast<std::uint32_t>((i * 5 + frame) % 97));
  };
  const int frames = std::getenv("RIGEL_FULL") != nullptr ? 10000 : 300;
  long counted = 0;
  std::size_t bytes = 0;
  for (int f = 0; f < frames; ++f) {
    light(f);
    const long before = allocations;
    for (std::size_t c = 0; c < ids.size(); ++c) {
      // In the first frame all there are.
      if (f > 0 && (f + static_cast<int>(c)) % 50 == 0) {
        stage.crowd.remove(ids[c]);
        ids[c] = stage.crowd.add(kinds[c % 2]);
      }
      CrowdInput& input = stage.crowd.input(ids[c]);
      input.palette = palette;
      input.worldFromRig.origin = {0.2f * static_cast<float>(c), 0, 0.01f * static_cast<float>(f % 300)};
      input.interval = 1 + (f / 16 + static_cast<int>(c)) % 4;
      input.visible = f == 0 || (f + static_cast<int>(c)) % 13 != 0;
    }
    stage.frame(f % 100 == 99 ? 0 : 1.0f / 60);
    if (f == 0) bytes = stage.crowd.bytes();
    if (f > 0) counted += allocations - before;
  }
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(stage.crowd.bytes(), bytes);
  EXPECT_LT(stage.crowd.bytesPerCharacter(kinds[0]), 1700u);
}

// The same among lamps in a tree, some of which move and are dark now and then, with scratch for each task.
TEST(RigAllocation, ACrowdAmongManyLightsAllocatesNothing) {
  const BendingBody body;
  Stage<3> stage(2);
  stage.asked = {nullptr, 0.1f, 6};
  const int kind = stage.crowd.addKind(kindOf("poly:6", body.shape()));
  std::vector<CrowdId> ids;
  for (int c = 0; c < 40; ++c) ids.push_back(stage.crowd.add(kind));
  stage.makeRoom();
  const auto palette = BendingBody::palette(0.3f);
  const int frames = std::getenv("RIGEL_FULL") != nullptr ? 10000 : 200;
  long counted = 0;
  std::size_t bytes = 0;
  for (int f = 0; f < frames; ++f) {
    const auto t = static_cast<float>(f % 300);
    stage.lights.clear();
    stage.ids.clear();
    for (int i = 0; i < 900; ++i) {
      const float x = 8 * static_cast<float>(i % 30 - 15), z = 8 * static_cast<float>(i / 30 - 15);
      const float bright = f > 0 && (i + f) % 100 == 0 ? 0.0f : 9.0f;
      stage.lights.add(PointLight{{x + (i % 9 == 0 ? 0.02f * t : 0.0f), 3, z}, {bright, bright, bright}});
      stage.ids.push_back(static_cast<std::uint32_t>(i) + 7);
    }
    for (std::size_t c = 0; c < ids.size(); ++c) {
      CrowdInput& input = stage.crowd.input(ids[c]);
      input.palette = palette;
      input.worldFromRig.origin = {3 * static_cast<float>(c % 8) + 0.1f * t, 1, 5 * static_cast<float>(c / 8)};
      input.groups = c % 5 == 0 ? 1 : kAllLightGroups;
      input.interval = 1 + static_cast<int>(c) % 3;
    }
    const long before = allocations;
    stage.frame(1.0f / 60);
    if (f == 0) bytes = stage.crowd.bytes();
    if (f > 0) counted += allocations - before;
  }
  EXPECT_EQ(counted, 0);
  EXPECT_EQ(stage.crowd.bytes(), bytes);
  RecordProperty("scratch", std::to_string(bytes));
  EXPECT_LT(bytes, 4u << 20);
}

}  // namespace
}  // namespace rigel::test
