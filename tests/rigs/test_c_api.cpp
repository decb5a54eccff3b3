// The C interface gives what Crowd gives, and answers wrong use.
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "c_stage.h"
#include "lighting_fixture.h"

namespace rigel::test {
namespace {

LightSet allKindsOfLight(float t) {
  LightSet lights = lightsAround(4, 12);
  lights.add(DirectionalLight{{t, -1, 0.3f}, {1, 2, 1}});
  lights.add(DiskLight{{1 + t, 1.2f, 0.4f}, {-1, -1, 0}, 0.3f, {9, 8, 7}}, 1);
  lights.add(DiskLight{{-1, 0, t}, {1, 0, 0}, 0.2f, {5, 8, 7}, true}, 2);
  lights.add(PointLight{{0.5f, t, 0.6f}, {2, 2, 1}, 0.05f, 3}, 3);
  lights.add(SpotLight{{0.5f, 2, t}, {0.1f, -1, 0}, {6, 5, 4}, 0.2f, 0.5f, 0.02f, 5}, 2);
  lights.add(SphereLight{{t - 1, 1, 1}, 0.2f, {30, 20, 10}}, 1);
  return lights;
}

template <class A, class B>
bool sameBits(const std::vector<A>& a, const std::vector<B>& b) {
  static_assert(sizeof(A) == sizeof(B));
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(A)) == 0;
}

/// Two kinds in both interfaces, in the same frames.
struct Twins {
  float target = 0;  // with a tree where it is positive
  CBody body;
  Stage<3> cpp;
  CStage c{3, 3};
  std::shared_ptr<const CrowdKind> kinds[2] = {kindOf("poly:6", body.body.shape()),
                                               kindOf("poly:4", body.body.rigidShape(), {3, 0.01f, 5})};
  Owned<rigel_kind> cKinds[2];
  int numbers[2] = {cpp.crowd.addKind(kinds[0]), cpp.crowd.addKind(kinds[1])};
  std::vector<CrowdId> ids;
  std::vector<rigel_character> characters;

  explicit Twins(float lightTarget = 0) : target(lightTarget) {
    cpp.asked = {nullptr, target, 4};
    c.lightTarget = target;
    rigel_kind_desc rigid = body.desc("poly:4", true);
    rigid.near_slots = 3;
    rigid.tolerance = 0.01f;
    rigid.weight_rate = 5;
    cKinds[0] = cKindOf(body.desc("poly:6"));
    cKinds[1] = cKindOf(rigid);
    c.parallel.run = [](void*, std::int32_t count, rigel_task task, void* work) {
      std::vector<std::thread> others;
      for (std::int32_t i = 1; i < count; ++i) others.emplace_back([=] { task(work, i); });
      task(work, 0);
      for (std::thread& other : others) other.join();
    };
  }
  void add(int kind) {
    ids.push_back(cpp.crowd.add(numbers[kind]));
    characters.push_back(c.add(cKinds[kind].get()));
    EXPECT_TRUE((ids.back() == CrowdId{characters.back().kind, characters.back().index, characters.back().generation}));
  }
  void makeRoom() {
    cpp.makeRoom();
    c.makeRoom();
  }
  void set(std::size_t i, const CrowdInput& input) {
    const bool cut = cpp.crowd.input(ids[i]).cut;
    cpp.crowd.input(ids[i]) = input;
    cpp.crowd.input(ids[i]).cut = cut || input.cut;
    const rigel_character_desc desc = cInput(input);
    EXPECT_EQ(rigel_set_character(c.crowd.get(), characters[i], &desc), RIGEL_OK) << rigel_get_last_error();
  }
  /// Every character by `set(i)`, half of them on another thread.
  template <class Set>
  void setAll(Set setOne) {
    const auto half = [&](std::size_t first) {
      for (std::size_t i = first; i < ids.size(); i += 2) setOne(i);
    };
    std::thread other(half, 1);
    half(0);
    other.join();
  }
  void frame(float seconds, int number) {
    cpp.lights = allKindsOfLight(0.1f * static_cast<float>(number));
    cpp.ids.clear();
    for (int i = 0; i < cpp.lights.size(); ++i) cpp.ids.push_back(lightId(i, number));
    c.set(cpp.lights, number);
    const CrowdStats stats = cpp.frame(seconds);
    const rigel_frame_info info = c.frame(seconds);
    EXPECT_EQ(static_cast<int>(info.visible), stats.visible);
    EXPECT_EQ(static_cast<int>(info.updated), stats.updated);
    EXPECT_EQ(static_cast<int>(info.unusable), stats.unusable);
    EXPECT_EQ(info.lights, stats.lights);
    EXPECT_EQ(info.clusters, stats.clusters);
    EXPECT_EQ(info.merged, stats.merged);
    EXPECT_TRUE(sameBits(c.rigs, cpp.rigs));
    EXPECT_TRUE(sameBits(c.coefficients, cpp.coefficients));
    EXPECT_TRUE(sameBits(c.halves, cpp.halves));
    EXPECT_TRUE(sameBits(c.near, cpp.near));
    for (std::size_t i = 0; i < ids.size(); ++i) {
      rigel_place place;
      EXPECT_EQ(rigel_get_place(c.crowd.get(), characters[i], &place), RIGEL_OK);
      const CrowdResult result = cpp.crowd.result(ids[i]);
      EXPECT_EQ(place.rig, result.rig);
      EXPECT_EQ(place.near_offset, result.nearOffset);
      EXPECT_EQ(place.near_count, result.nearCount);
    }
  }
};

void compareTwins(float target) {
  Twins twins(target);
  for (int i = 0; i < 30; ++i) twins.add(i % 3 == 2);
  twins.makeRoom();
  std::vector<std::vector<JointMatrix>> palettes(twins.ids.size());
  for (int f = 0; f < 6; ++f) {
    twins.setAll([&](std::size_t i) {
      const float t = static_cast<float>(i) + 0.1f * static_cast<float>(f);
      CrowdInput input;
      input.worldFromRig = turned(t, {std::fmod(t, 3.0f), 0, std::fmod(2 * t, 3.0f)});
      if (i % 3 != 2) palettes[i] = BendingBody::palette(std::sin(t));
      if (i == 4 && f == 1) palettes[i][3].m[1][2] = std::numeric_limits<float>::quiet_NaN();
      input.palette = palettes[i];
      input.groups = i % 5 == 0 ? 1 : i % 5 == 1 ? 2 : kAllLightGroups;
      input.interval = 1 + static_cast<int>(i % 4);
      input.visible = (static_cast<int>(i) + f) % 7 != 0;
      input.cut = i % 4 == 3 && f == 3;
      twins.set(i, input);
      // A flag that the next call does not set again holds all the same.
      input.cut = false;
      twins.set(i, input);
    });
    twins.frame(f == 5 ? 0 : 1.0f / 60, f);
  }
  rigel_crowd_info info = RIGEL_CROWD_INFO_INIT;
  EXPECT_EQ(rigel_get_crowd_info(twins.c.crowd.get(), &info), RIGEL_OK);
  EXPECT_EQ(info.characters, twins.ids.size());
  std::size_t bytes = 0;
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(rigel_get_character_bytes(twins.c.crowd.get(), twins.cKinds[k].get(), &bytes), RIGEL_OK);
    EXPECT_EQ(bytes, twins.cpp.crowd.bytesPerCharacter(twins.numbers[k]));
  }
}

TEST(CApi, GivesTheBitsOfCrowd) { compareTwins(0); }
TEST(CApi, GivesTheBitsOfCrowdWithATree) { compareTwins(0.2f); }

TEST(CApi, HasCrowdsOfAllBands) {
  const CBody body;
  const auto kind = cKindOf(body.desc("poly:1"));
  for (std::uint32_t bands = 2; bands <= 5; ++bands) {
    CStage stage(bands);
    (void)stage.add(kind.get());
    stage.makeRoom();
    EXPECT_EQ(stage.coefficients.size(), static_cast<std::size_t>(gpuVectorSize(static_cast<int>(bands))));
  }
}

TEST(CApi, NamesItsResults) {
  for (int r = RIGEL_OK; r <= RIGEL_ERROR_CALLBACK; ++r)
    EXPECT_EQ(std::string(rigel_get_result_name(static_cast<rigel_result>(r))).rfind("RIGEL_", 0), 0u) << r;
  EXPECT_STREQ(rigel_get_result_name(static_cast<rigel_result>(7777 & 7)), "RIGEL_ERROR_NULL");
}

/// A crowd of three bending bodies in front of a few lights, and what a frame of it gives.
class CApiHardCases : public testing::Test {
 protected:
  CApiHardCases() {
    stage_.set(lightsAround(5, 10));
    for (int i = 0; i < 3; ++i) characters_.push_back(stage_.add(kind_.get()));
    stage_.makeRoom();
    input_.palette = palette_;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(setCharacter(i, cInput(input_)), RIGEL_OK);
    stage_.frame(0);
    before_ = stage_.coefficients;
  }
  rigel_result setCharacter(std::size_t i, const rigel_character_desc& desc) {
    return rigel_set_character(stage_.crowd.get(), characters_[i], &desc);
  }
  rigel_result setLights(const rigel_lights_desc& desc) { return rigel_set_lights(stage_.lights.get(), &desc); }
  rigel_result light(const rigel_frame_desc& desc) { return rigel_light_crowd(stage_.crowd.get(), &desc, nullptr); }

  /// The code, with a line that has the words; and nothing changed.
  void expectError(rigel_result got, rigel_result expected, const std::string& words) {
    EXPECT_EQ(got, expected) << words;
    const std::string line = rigel_get_last_error();
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_EQ(line.rfind("rigel_", 0), 0u) << line;
    stage_.frame(0);
    EXPECT_TRUE(sameBits(stage_.coefficients, before_)) << words;
  }

  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  CBody body_;
  Owned<rigel_kind> kind_ = cKindOf(body_.desc("poly:6"));
  CStage stage_;
  std::vector<JointMatrix> palette_ = BendingBody::palette(0.4f);
  CrowdInput input_;
  std::vector<rigel_character> characters_;
  std::vector<rigel_vec4> before_;
};

TEST_F(CApiHardCases, KindsThatCannotBe) {
  const auto expect = [&](rigel_result code, const std::string& words, void (*spoil)(rigel_kind_desc&)) {
    rigel_kind_desc desc = body_.desc("poly:6");
    spoil(desc);
    rigel_kind* kind = kind_.get();
    expectError(rigel_create_kind(&desc, &kind), code, words);
    EXPECT_EQ(kind, kind_.get());
  };
  expect(RIGEL_ERROR_NULL, "rig is NULL", [](auto& d) { d.rig = nullptr; });
  expect(RIGEL_ERROR_NULL, "surface is NULL", [](auto& d) { d.surface = nullptr; });
  expect(RIGEL_ERROR_NULL, "skin is NULL", [](auto& d) { d.skin = nullptr; });
  expect(RIGEL_ERROR_VALUE, "no such rig", [](auto& d) { d.rig = "no such rig"; });
  expect(RIGEL_ERROR_VALUE, "poly:K alone", [](auto& d) { d.rig = "lattice:3x2x2"; });
  expect(RIGEL_ERROR_VALUE, "surface", [](auto& d) { d.surface_count = d.skin_count = 0; });
  expect(RIGEL_ERROR_VALUE, "larger than any array", [](auto& d) { d.surface_count = ~std::size_t{0}; });
  expect(RIGEL_ERROR_VALUE, "skin_count is 12", [](auto& d) { d.skin_count = 12; });
  expect(RIGEL_ERROR_VALUE, "box", [](auto& d) { std::swap(d.box_lo, d.box_hi); });
  expect(RIGEL_ERROR_VALUE, "near_slots is 9", [](auto& d) { d.near_slots = RIGEL_MAX_NEAR_SLOTS + 1; });
  expect(RIGEL_ERROR_VALUE, "tolerance", [](auto& d) { d.tolerance = kNan; });
  expect(RIGEL_ERROR_VALUE, "tolerance", [](auto& d) { d.tolerance = -1; });
  expect(RIGEL_ERROR_VALUE, "weight_rate", [](auto& d) { d.weight_rate = kInfinity; });
  expect(RIGEL_ERROR_VALUE, "reserved", [](auto& d) { d.reserved = 1; });
  rigel_kind* kind = nullptr;
  CBody bad = body_;
  bad.skin[7].weight[0] += 0.1f;
  const rigel_kind_desc badSkin = bad.desc("poly:6");
  expectError(rigel_create_kind(&badSkin, &kind), RIGEL_ERROR_VALUE, "weights of skin 7");
  bad.surface[9].y = kNan;
  const rigel_kind_desc badSurface = bad.desc("poly:6", true);
  expectError(rigel_create_kind(&badSurface, &kind), RIGEL_ERROR_VALUE, "finite");
  EXPECT_EQ(kind, nullptr);
  const rigel_kind_desc good = body_.desc("poly:6");
  expectError(rigel_create_kind(&good, nullptr), RIGEL_ERROR_NULL, "kind is NULL");
  expectError(rigel_create_kind(nullptr, nullptr), RIGEL_ERROR_NULL, "desc is NULL");
  expectError(rigel_get_kind_info(kind_.get(), nullptr), RIGEL_ERROR_NULL, "info is NULL");
  rigel_destroy_kind(nullptr);
}

TEST_F(CApiHardCases, LightsThatCannotBe) {
  const auto expect = [&](const std::string& words, void (*spoil)(CLights&)) {
    CLights lights(allKindsOfLight(0));
    spoil(lights);
    const rigel_lights_desc desc = lights.desc();
    expectError(setLights(desc), words.find("id ") == 0 ? RIGEL_ERROR_ID : RIGEL_ERROR_VALUE, words);
  };
  expect("directional light 0", [](CLights& l) { l.directional[0].direction.y = kInfinity; });
  expect("its irradiance", [](CLights& l) { l.directional[0].irradiance.g = kNan; });
  expect("point light 1, id 10", [](CLights& l) { l.point[1].position.x = kNan; });
  expect("its radius", [](CLights& l) { l.point[1].radius = -1; });
  expect("its range", [](CLights& l) { l.point[2].range = kNan; });
  expect("its range", [](CLights& l) { l.spot[2].range = -1; });
  expect("its intensity", [](CLights& l) { l.spot[0].intensity.b = kInfinity; });
  expect("its direction", [](CLights& l) { l.spot[0].direction.z = kNan; });
  expect("its inner_angle", [](CLights& l) { l.spot[0].inner_angle = -0.1f; });
  expect("its outer_angle", [](CLights& l) { l.spot[0].outer_angle = 0.1f; });
  expect("its outer_angle", [](CLights& l) { l.spot[0].outer_angle = 3.2f; });
  expect("sphere light 6", [](CLights& l) { l.sphere.back().radius = kInfinity; });
  expect("its radiance", [](CLights& l) { l.disk[1].radiance.r = kNan; });
  expect("its two_sided", [](CLights& l) { l.disk[1].two_sided = 2; });
  expect("id 6", [](CLights& l) { l.disk[1].id = l.directional[0].id = 6; });

  CLights lights(allKindsOfLight(0));
  rigel_lights_desc desc = lights.desc();
  desc.sphere = nullptr;
  expectError(setLights(desc), RIGEL_ERROR_NULL, "sphere is NULL");
  expectError(rigel_set_lights(nullptr, &desc), RIGEL_ERROR_NULL, "lights is NULL");
  // What leaves no light is no error.
  lights.point[0].range = lights.sphere[0].radius = 0;
  lights.spot[0].direction = {0, 0, 0};
  desc = lights.desc();
  EXPECT_EQ(setLights(desc), RIGEL_OK);
  const rigel_lights_desc none = RIGEL_LIGHTS_DESC_INIT;
  EXPECT_EQ(setLights(none), RIGEL_OK);
  stage_.frame(0);
  for (const rigel_vec4& c : stage_.coefficients) EXPECT_TRUE(c.x == 0 && c.y == 0 && c.z == 0 && c.w == 0);
}

TEST_F(CApiHardCases, CharactersThatCannotBe) {
  const auto expect = [&](const std::string& words, void (*spoil)(rigel_character_desc&)) {
    rigel_character_desc desc = cInput(input_);
    spoil(desc);
    expectError(setCharacter(1, desc), words == "palette is NULL" ? RIGEL_ERROR_NULL : RIGEL_ERROR_VALUE, words);
  };
  expect("palette is NULL", [](auto& d) { d.palette = nullptr; });
  expect("joint_count is 6", [](auto& d) { d.joint_count = 6; });
  expect("joint_count is 0", [](auto& d) { d = RIGEL_CHARACTER_DESC_INIT; });
  expect("world_from_rig", [](auto& d) { d.world_from_rig.m[1][1] = kNan; });
  expect("world_from_rig", [](auto& d) { d.world_from_rig.m[2][3] = kInfinity; });
  expect("world_from_rig", [](auto& d) { d.world_from_rig.m[0][0] = 1.01f; });
  expect("interval is 0", [](auto& d) { d.interval = 0; });
  expect("interval is 65", [](auto& d) { d.interval = 65; });
  expect("flags", [](auto& d) { d.flags = 4; });
  expect("reserved", [](auto& d) { d.reserved = 1; });

  // Names of nobody, of somebody else's crowd, and of those who are gone.
  const rigel_character_desc good = cInput(input_);
  rigel_place place;
  for (const rigel_character wrong : {rigel_character{0, 0, 0}, {0, 3, 1}, {1, 0, 1}, {~0u, ~0u, ~0u}}) {
    expectError(rigel_set_character(stage_.crowd.get(), wrong, &good), RIGEL_ERROR_ID, "not in the crowd");
    expectError(rigel_get_place(stage_.crowd.get(), wrong, &place), RIGEL_ERROR_ID, "not in the crowd");
    expectError(rigel_remove_character(stage_.crowd.get(), wrong), RIGEL_ERROR_ID, "not in the crowd");
  }
  const rigel_character gone = characters_[2];
  EXPECT_EQ(rigel_remove_character(stage_.crowd.get(), gone), RIGEL_OK);
  characters_[2] = stage_.add(kind_.get());
  EXPECT_EQ(characters_[2].index, gone.index);
  EXPECT_EQ(setCharacter(2, good), RIGEL_OK);
  expectError(rigel_set_character(stage_.crowd.get(), gone, &good), RIGEL_ERROR_ID, "character {0, 2, 1}");
  expectError(rigel_add_character(stage_.crowd.get(), nullptr, &characters_[0]), RIGEL_ERROR_NULL, "kind is NULL");
  expectError(rigel_add_character(stage_.crowd.get(), kind_.get(), nullptr), RIGEL_ERROR_NULL, "character is NULL");
  const auto other = cKindOf(body_.desc("poly:4"));
  std::size_t bytes = 0;
  expectError(rigel_get_character_bytes(stage_.crowd.get(), other.get(), &bytes), RIGEL_ERROR_ID, "no character");
}

TEST_F(CApiHardCases, FramesThatCannotBe) {
  const auto expect = [&](rigel_result code, const std::string& words, void (*spoil)(rigel_frame_desc&)) {
    rigel_frame_desc desc = stage_.desc(0);
    spoil(desc);
    expectError(light(desc), code, words);
  };
  expect(RIGEL_ERROR_NULL, "lights is NULL", [](auto& d) { d.lights = nullptr; });
  expect(RIGEL_ERROR_NULL, "rigs is NULL", [](auto& d) { d.rigs = nullptr; });
  expect(RIGEL_ERROR_NULL, "near_lights is NULL", [](auto& d) { d.near_lights = nullptr; });
  expect(RIGEL_ERROR_NULL, "halves is NULL", [](auto& d) { d.halves = nullptr; });
  expect(RIGEL_ERROR_NULL, "both NULL", [](auto& d) {
    d.halves = nullptr;
    d.coefficients = nullptr;
    d.half_capacity = d.coefficient_capacity = 0;
  });
  expect(RIGEL_ERROR_CAPACITY, "rigs is 2, 3 are needed", [](auto& d) { --d.rig_capacity; });
  expect(RIGEL_ERROR_CAPACITY, "coefficients is 125, 126", [](auto& d) { --d.coefficient_capacity; });
  expect(RIGEL_ERROR_CAPACITY, "halves is 0, 126", [](auto& d) { d.half_capacity = 0; });
  expect(RIGEL_ERROR_CAPACITY, "near_lights is 5, 6", [](auto& d) { --d.near_light_capacity; });
  expect(RIGEL_ERROR_VALUE, "seconds", [](auto& d) { d.seconds = kNan; });
  expect(RIGEL_ERROR_VALUE, "seconds", [](auto& d) { d.seconds = -1; });
  expect(RIGEL_ERROR_VALUE, "light_target", [](auto& d) { d.light_target = kNan; });
  expect(RIGEL_ERROR_VALUE, "light_target", [](auto& d) { d.light_target = -0.1f; });
  expect(RIGEL_ERROR_VALUE, "RIGEL_LIGHTS_TREE", [](auto& d) { d.light_target = 0.1f; });
  rigel_frame_desc one = stage_.desc(0);
  one.halves = nullptr;
  one.half_capacity = 0;
  EXPECT_EQ(light(one), RIGEL_OK);
  EXPECT_TRUE(sameBits(stage_.coefficients, before_));
  rigel_crowd_desc crowd = RIGEL_CROWD_DESC_INIT;
  rigel_crowd* made = nullptr;
  crowd.bands = 6;
  expectError(rigel_create_crowd(&crowd, &made), RIGEL_ERROR_VALUE, "bands is 6");
  crowd.bands = 3;
  crowd.tasks = 0;
  expectError(rigel_create_crowd(&crowd, &made), RIGEL_ERROR_VALUE, "tasks is 0");
  crowd.tasks = RIGEL_MAX_TASKS + 1;
  expectError(rigel_create_crowd(&crowd, &made), RIGEL_ERROR_VALUE, "tasks is 1025");
  EXPECT_EQ(made, nullptr);
}

TEST_F(CApiHardCases, ACrowdOfNobodyAndNoLight) {
  CStage empty;
  rigel_frame_desc desc = RIGEL_FRAME_DESC_INIT;
  desc.lights = empty.lights.get();
  rigel_frame_info info = RIGEL_FRAME_INFO_INIT;
  EXPECT_EQ(rigel_light_crowd(empty.crowd.get(), &desc, &info), RIGEL_OK) << rigel_get_last_error();
  EXPECT_EQ(info.visible, 0u);
  // Hidden until it is set.
  const rigel_character added = empty.add(kind_.get());
  empty.makeRoom();
  EXPECT_EQ(empty.frame(1).visible, 0u);
  rigel_place place;
  EXPECT_EQ(rigel_get_place(empty.crowd.get(), added, &place), RIGEL_OK);
  EXPECT_EQ(place.rig, -1);
}

/// A description as a newer header has it.
template <class T>
struct Newer {
  T known;
  std::uint32_t more[2] = {0, 0};
};

TEST_F(CApiHardCases, DescriptionsOfOtherVersions) {
  Newer<rigel_frame_desc> frame{stage_.desc(0)};
  for (const std::size_t size : {std::size_t{0}, sizeof(rigel_frame_desc) - 1, ~std::size_t{0}}) {
    frame.known.size = size;
    expectError(light(frame.known), RIGEL_ERROR_SIZE, "size");
  }
  frame.known.size = sizeof(frame);
  EXPECT_EQ(light(frame.known), RIGEL_OK) << rigel_get_last_error();
  EXPECT_TRUE(sameBits(stage_.coefficients, before_));
  frame.more[1] = 1;
  expectError(light(frame.known), RIGEL_ERROR_SIZE, "newer");

  Newer<rigel_kind_info> info{RIGEL_KIND_INFO_INIT, {5, 6}};
  info.known.size = sizeof(info);
  EXPECT_EQ(rigel_get_kind_info(kind_.get(), &info.known), RIGEL_OK);
  EXPECT_TRUE(info.known.sh_vectors == 6 && info.more[0] == 0 && info.more[1] == 0);
  EXPECT_EQ(info.known.size, sizeof(info));
  info.known.size = 4;
  expectError(rigel_get_kind_info(kind_.get(), &info.known), RIGEL_ERROR_SIZE, "a size is 4");
}

class CApiCallbacks : public CApiHardCases {
 protected:
  // Enough for two blocks.
  CApiCallbacks() : stage2_(3, 4) {
    stage2_.set(lightsAround(5, 10));
    for (int i = 0; i < 40; ++i) {
      const rigel_character character = stage2_.add(kind_.get());
      rigel_character_desc desc = cInput(input_);
      desc.interval = 1 + static_cast<std::uint32_t>(i % 3);
      EXPECT_EQ(rigel_set_character(stage2_.crowd.get(), character, &desc), RIGEL_OK);
    }
    stage2_.makeRoom();
    stage2_.frame(0);
    before2_ = stage2_.coefficients;
  }
  CStage stage2_;
  std::vector<rigel_vec4> before2_;
};

TEST_F(CApiCallbacks, ThatDoNotDoTheirTasks) {
  using RunTasks = void (*)(void*, std::int32_t, rigel_task, void*);
  const RunTasks none = [](void*, std::int32_t, rigel_task, void*) {};
  const RunTasks one = [](void*, std::int32_t, rigel_task task, void* work) { task(work, 1); };
  const RunTasks same = [](void*, std::int32_t count, rigel_task task, void* work) {
    for (std::int32_t i = 0; i < count; ++i) task(work, 0);
  };
  const RunTasks outside = [](void*, std::int32_t count, rigel_task task, void* work) {
    for (std::int32_t i = 1; i <= count; ++i) task(work, i);
  };
  const RunTasks throws = [](void*, std::int32_t, rigel_task, void*) { throw std::runtime_error("x"); };
  for (const RunTasks run : {none, one, same, outside, throws}) {
    stage2_.parallel.run = run;
    const rigel_frame_desc desc = stage2_.desc(1.0f / 60);
    EXPECT_EQ(rigel_light_crowd(stage2_.crowd.get(), &desc, nullptr), RIGEL_ERROR_CALLBACK);
    // And the next frame is a cut, whatever was left undone.
    stage2_.parallel.run = nullptr;
    std::ranges::fill(stage2_.coefficients, rigel_vec4{});
    EXPECT_EQ(stage2_.frame(1.0f / 60).updated, 40u);
    EXPECT_TRUE(sameBits(stage2_.coefficients, before2_));
  }
  // More often than asked: once is enough.
  stage2_.parallel.run = [](void*, std::int32_t count, rigel_task task, void* work) {
    for (std::int32_t i = -1; i < 2 * count; ++i) task(work, i % count);
  };
  stage2_.frame(0);
  EXPECT_TRUE(sameBits(stage2_.coefficients, before2_));
}

TEST_F(CApiCallbacks, TheClockIsAskedAndErrorsAreTheThreadsOwn) {
  std::uint64_t ticks = 0;
  rigel_frame_desc desc = stage2_.desc(0);
  desc.clock = {[](void* context) { return ++*static_cast<std::uint64_t*>(context); }, &ticks};
  rigel_frame_info info = RIGEL_FRAME_INFO_INIT;
  EXPECT_EQ(rigel_light_crowd(stage2_.crowd.get(), &desc, &info), RIGEL_OK);
  for (int stage = 0; stage < RIGEL_STAGE_COUNT; ++stage)
    EXPECT_EQ(info.ticks[stage], stage == RIGEL_STAGE_SELECT ? 0u : 3u);  // of three blocks, without a tree
  EXPECT_EQ(rigel_remove_character(nullptr, {}), RIGEL_ERROR_NULL);
  const std::string here = rigel_get_last_error();
  std::thread([] { EXPECT_STREQ(rigel_get_last_error(), ""); }).join();
  EXPECT_EQ(here, "rigel_remove_character: crowd is NULL");
}

}  // namespace
}  // namespace rigel::test
