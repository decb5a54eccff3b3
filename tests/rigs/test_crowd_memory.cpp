// Where memory ends in a task of a frame: the frame says so after all of its tasks, and the next is as ever.
#include <cstring>

#include "counted_allocations.h"
#include "crowd_fixture.h"

namespace rigel::test {
namespace {

/// All tasks on this thread, in memory of nobody's.
ParallelFor oneAfterAnother() {
  ParallelFor all;
  all.run = [](void*, int count, ParallelFor::Task task, void* work) {
    for (int i = 0; i < count; ++i) task(work, i);
  };
  return all;
}

/// People in three places, each among so many lamps that their list grows in the task, not before the frame.
struct Crowded {
  BendingBody body;
  std::vector<JointMatrix> palette = BendingBody::palette(0.3f);
  Stage<3> stage{3};
  std::vector<CrowdId> ids;

  Crowded() {
    constexpr int kLamps = 2400, kPeople = 30;
    const int kind = stage.crowd.addKind(kindOf("poly:6", body.shape()));
    for (int i = 0; i < kPeople; ++i) ids.push_back(stage.crowd.add(kind));
    stage.makeRoom();
    for (int i = 0; i < kPeople; ++i) {
      CrowdInput& input = stage.crowd.input(ids[static_cast<std::size_t>(i)]);
      input.palette = palette;
      input.worldFromRig.origin = {40.0f * static_cast<float>(i % 3) + 0.1f * static_cast<float>(i), 1, 0};
    }
    for (int i = 0; i < kLamps; ++i) {
      const float along = 40 * static_cast<float>(i % 3) + 2 * std::sin(static_cast<float>(i));
      const float across = 2 * std::cos(1.7f * static_cast<float>(i));
      stage.lights.add(PointLight{{along, 3 + 0.3f * std::sin(0.9f * static_cast<float>(i)), across}, {1, 2, 3}});
    }
    stage.tree.update(stage.lights);
    stage.prepared.set(stage.lights);
    for (const SphereLight& cluster : stage.tree.clusters()) stage.prepared.add(cluster);
  }
  CrowdStats frame() {
    const CrowdTree all{&stage.tree, 1e-7f, 8};  // nothing may be merged
    return stage.crowd.frame({&stage.lights, &stage.prepared, {}, all}, 1.0f / 60,
                             {stage.rigs, stage.coefficients, stage.halves, stage.near}, oneAfterAnother());
  }
  /// A frame for which so many allocations are left.
  bool failsAfter(int allocations) {
    allocationsLeft = allocations;
    bool thrown = false;
    try {
      frame();
    } catch (const std::bad_alloc&) {
      thrown = true;
    }
    allocationsLeft = -1;
    return thrown;
  }
  /// Of the last frame, of all that can be seen.
  int dark() const {
    return static_cast<int>(std::ranges::count_if(ids, [&](CrowdId id) { return stage.rig(id).vectors == 0; }));
  }
};

TEST(CrowdMemory, TheFrameAfterOneThatFoundNoneIsAsEver) {
  Crowded whole;
  whole.frame();
  whole.frame();
  int failed = 0;
  for (int n = 0;; n += 1 + n / 8) {
    Crowded crowded;
    if (!crowded.failsAfter(n)) break;
    ++failed;
    crowded.frame();
    EXPECT_EQ(crowded.dark(), 0);
    ASSERT_EQ(crowded.stage.coefficients.size(), whole.stage.coefficients.size());
    EXPECT_EQ(std::memcmp(crowded.stage.coefficients.data(), whole.stage.coefficients.data(),
                          whole.stage.coefficients.size() * sizeof(GpuVec4)),
              0)
        << "allocation " << n;
  }
  RecordProperty("failed", failed);
  EXPECT_GT(failed, 0);
}

TEST(CrowdMemory, WhoeverHasNoneIsDarkAndOthersAreLit) {
  for (int n = 0;; ++n) {
    Crowded crowded;
    ASSERT_TRUE(crowded.failsAfter(n)) << "memory ended in no task";
    if (crowded.stage.crowd.result(crowded.ids[0]).rig < 0) continue;  // before all tasks
    const int dark = crowded.dark();
    if (dark > 0 && dark < static_cast<int>(crowded.ids.size())) break;
  }
}

}  // namespace
}  // namespace rigel::test
