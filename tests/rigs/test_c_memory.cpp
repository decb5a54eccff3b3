// The C interface allocates nothing in a frame, and where there is no memory nothing has happened.
#include <cstring>

#include "c_stage.h"
#include "counted_allocations.h"

namespace rigel::test {
namespace {

/// Lights of all kinds, in C.
CLights someLights(int count) {
  LightSet lights;
  for (int i = 0; i < count; ++i) {
    const auto t = static_cast<float>(i);
    lights.add(PointLight{{0.5f * t - 3, 1, 1}, {3, 4, 5}});
    lights.add(SpotLight{{0, 4, t}, {0, -1, 0}, {30, 30, 30}}, 1u << (i % 3));
    lights.add(SphereLight{{t, 2, 1}, 0.3f, {2, 3, 4}});
    lights.add(DiskLight{{t, 2, 0}, {0, -1, 0}, 0.3f, {5, 4, 3}});
    lights.add(DirectionalLight{{0, -1, t}, {1, 1, 1}});
  }
  return CLights(lights);
}

/// Some bending bodies in C, set.
struct CWalkers {
  CBody body;
  Owned<rigel_kind> kind = cKindOf(body.desc("poly:6"));
  std::vector<JointMatrix> palette = BendingBody::palette(0.3f);
  std::vector<rigel_character> characters;
  CStage stage;

  explicit CWalkers(int count) {
    for (int i = 0; i < count; ++i) characters.push_back(stage.add(kind.get()));
    set(0);
    stage.makeRoom();
  }
  void set(int frame) {
    CrowdInput input;
    input.palette = palette;
    for (std::size_t i = 0; i < characters.size(); ++i) {
      const auto n = frame + static_cast<int>(i);
      input.worldFromRig.origin = {0.2f * static_cast<float>(i), 0, 0.01f * static_cast<float>(frame)};
      input.interval = 1 + n % 4;
      input.visible = n % 5 != 3;
      const rigel_character_desc desc = cInput(input);
      EXPECT_EQ(rigel_set_character(stage.crowd.get(), characters[i], &desc), RIGEL_OK);
    }
  }
};

TEST(CApiMemory, AFrameAllocatesNothing) {
  CWalkers walkers(20);
  const std::vector<CLights> lights = {someLights(8), someLights(3), someLights(6), someLights(0)};
  long counted = 0;
  for (int f = 0; f < 60; ++f) {
    const rigel_lights_desc desc = lights[static_cast<std::size_t>(f % 4)].desc();
    const long before = allocations;
    ASSERT_EQ(rigel_set_lights(walkers.stage.lights.get(), &desc), RIGEL_OK);
    walkers.set(f);
    walkers.stage.frame(f % 10 == 9 ? 0 : 1.0f / 60);
    // Lights are kept twice, in turn.
    if (f > 4) counted += allocations - before;
  }
  EXPECT_EQ(counted, 0);
}

/// `call` fails without memory for its first allocation, for its second, ..., and works in the end. How often it
/// failed.
template <class Call, class Check>
int failures(Call call, Check unchanged) {
  for (int n = 0;; ++n) {
    allocationsLeft = n;
    const rigel_result result = call();
    allocationsLeft = -1;
    if (result == RIGEL_OK) return n;
    EXPECT_EQ(result, RIGEL_ERROR_MEMORY) << rigel_get_last_error();
    unchanged();
  }
}

class CApiWithoutMemory : public testing::Test {
 protected:
  CApiWithoutMemory() {
    // Room for all that the tests add.
    stage_.rigs.resize(kMost);
    stage_.coefficients.resize(kMost * 6 * static_cast<std::size_t>(gpuVectorSize(3)));
    stage_.halves.resize(stage_.coefficients.size());
    stage_.near.resize(2 * kMost);
    const CLights few = someLights(2);
    const rigel_lights_desc desc = few.desc();
    EXPECT_EQ(rigel_set_lights(stage_.lights.get(), &desc), RIGEL_OK);
    stage_.frame(0);
    before_ = stage_.coefficients;
  }
  bool same(const std::vector<rigel_vec4>& coefficients) const {
    return std::memcmp(coefficients.data(), stage_.coefficients.data(), coefficients.size() * sizeof(rigel_vec4)) == 0;
  }
  void expectUnchanged() {
    stage_.frame(0);
    EXPECT_TRUE(same(before_));
  }
  int failuresToAdd(const rigel_kind* kind) {
    return failures([&] { return rigel_add_character(stage_.crowd.get(), kind, &added_); }, [&] { expectUnchanged(); });
  }

  static constexpr std::size_t kMost = 64;
  CWalkers walkers_{16};
  CStage& stage_ = walkers_.stage;
  std::vector<rigel_vec4> before_;
  rigel_character added_{};
};

TEST_F(CApiWithoutMemory, NothingIsMade) {
  rigel_kind* kind = nullptr;
  rigel_kind_desc kindDesc = walkers_.body.desc("poly:1");
  kindDesc.surface_count = kindDesc.skin_count = 30;  // it takes as long as it has points
  EXPECT_GT(failures([&] { return rigel_create_kind(&kindDesc, &kind); }, [&] { EXPECT_EQ(kind, nullptr); }), 20);
  rigel_destroy_kind(kind);
  rigel_crowd* crowd = nullptr;
  const rigel_crowd_desc crowdDesc = RIGEL_CROWD_DESC_INIT;
  EXPECT_GT(failures([&] { return rigel_create_crowd(&crowdDesc, &crowd); }, [&] { EXPECT_EQ(crowd, nullptr); }), 1);
  rigel_destroy_crowd(crowd);
  rigel_lights* lights = nullptr;
  EXPECT_GT(failures([&] { return rigel_create_lights(&lights); }, [&] { EXPECT_EQ(lights, nullptr); }), 0);
  rigel_destroy_lights(lights);
}

TEST_F(CApiWithoutMemory, NobodyIsAdded) {
  const auto other = cKindOf(walkers_.body.desc("poly:4"));
  EXPECT_GT(failuresToAdd(other.get()), 3);
  int failed = 0;
  while (failed == 0 && added_.index < kMost / 2) failed = failuresToAdd(walkers_.kind.get());
  EXPECT_GT(failed, 1) << "the crowd did not grow";
}

TEST_F(CApiWithoutMemory, LightsStayAsTheyWere) {
  const CLights many = someLights(30);
  const rigel_lights_desc lights = many.desc();
  EXPECT_GT(failures([&] { return rigel_set_lights(stage_.lights.get(), &lights); }, [&] { expectUnchanged(); }), 5);
  // Now the frame needs room for them.
  const rigel_frame_desc frame = stage_.desc(0);
  EXPECT_GT(failures([&] { return rigel_light_crowd(stage_.crowd.get(), &frame, nullptr); },
                     [&] { EXPECT_TRUE(same(before_)); }),
            2);
  EXPECT_FALSE(same(before_));
}

TEST_F(CApiWithoutMemory, LightsInATreeStayAsTheyWere) {
  CLights many = someLights(30);
  many.flags = RIGEL_LIGHTS_TREE;
  const rigel_lights_desc lights = many.desc();
  EXPECT_GT(failures([&] { return rigel_set_lights(stage_.lights.get(), &lights); }, [&] { expectUnchanged(); }), 20);
  stage_.lightTarget = 0.1f;
  const rigel_frame_desc frame = stage_.desc(0);
  EXPECT_GT(failures([&] { return rigel_light_crowd(stage_.crowd.get(), &frame, nullptr); },
                     [&] { EXPECT_TRUE(same(before_)); }),
            5);
  EXPECT_FALSE(same(before_));
}

}  // namespace
}  // namespace rigel::test
