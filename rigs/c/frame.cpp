// rigel_light_crowd: a frame, and that the caller's parallel_for does what it has to.
#include <array>
#include <atomic>

#include "call.h"
#include "handles.h"

namespace rigel::c {
namespace {

/// A frame's tasks on the caller's threads: each once, whatever is called, and counted.
struct Tasks {
  static constexpr std::uint32_t kWord = 64;

  rigel_parallel_for caller{};
  rigel_crowd* crowd = nullptr;
  ParallelFor::Task task = nullptr;
  void* work = nullptr;
  std::int32_t count = 0;
  std::atomic<std::int32_t> done{0};
  std::array<std::atomic<std::uint64_t>, RIGEL_MAX_TASKS / kWord> begun{};

  void run(int tasks, ParallelFor::Task frameTask, void* frameWork) {
    count = tasks;
    task = frameTask;
    work = frameWork;
    crowd->torn = true;  // until it is seen to be done
    caller.run(caller.context, count, runTask, this);
    crowd->torn = done.load(std::memory_order_acquire) != count;
  }

 private:
  bool isFirst(std::uint32_t i) noexcept {
    const std::uint64_t bit = std::uint64_t{1} << (i % kWord);
    return (begun[i / kWord].fetch_or(bit, std::memory_order_relaxed) & bit) == 0;
  }
  static void runTask(void* tasks, std::int32_t i) {
    auto& own = *static_cast<Tasks*>(tasks);
    if (i < 0 || i >= own.count || !own.isFirst(static_cast<std::uint32_t>(i))) return;
    own.task(own.work, i);
    own.done.fetch_add(1, std::memory_order_release);
  }
};

/// A buffer for at least `least`, or none.
template <class T>
rigel_result checkBuffer(const Call& call, const T* buffer, std::size_t capacity, std::size_t least, const char* name) {
  if (const auto e = call.array(buffer, capacity, name); e != RIGEL_OK) return e;
  if (buffer == nullptr || capacity >= least) return RIGEL_OK;
  return call.fail(RIGEL_ERROR_CAPACITY, "capacity of %s is %zu, %zu are needed", name, capacity, least);
}

rigel_result checkBuffers(const Call& call, const rigel_frame_desc& d, const CrowdOutputBound& bound) {
  if (bound.rigs > 0 && d.rigs == nullptr) return call.needs({{d.rigs, "rigs"}});
  if (bound.nearLights > 0 && d.near_lights == nullptr) return call.needs({{d.near_lights, "near_lights"}});
  if (bound.coefficients > 0 && d.coefficients == nullptr && d.halves == nullptr)
    return call.fail(RIGEL_ERROR_NULL, "coefficients and halves are both NULL");
  if (const auto e = checkBuffer(call, d.rigs, d.rig_capacity, bound.rigs, "rigs"); e != RIGEL_OK) return e;
  if (const auto e = checkBuffer(call, d.coefficients, d.coefficient_capacity, bound.coefficients, "coefficients");
      e != RIGEL_OK)
    return e;
  if (const auto e = checkBuffer(call, d.halves, d.half_capacity, bound.coefficients, "halves"); e != RIGEL_OK)
    return e;
  return checkBuffer(call, d.near_lights, d.near_light_capacity, bound.nearLights, "near_lights");
}

rigel_result checkTree(const Call& call, const rigel_frame_desc& desc) {
  if (!(desc.light_target >= 0 && desc.light_target <= 1)) return call.value("light_target is not 0 to 1");
  if (desc.light_target == 0) return RIGEL_OK;
  if (!desc.lights->current.hasTree) return call.value("light_target is set, and the lights have no RIGEL_LIGHTS_TREE");
  if (!(desc.light_cell > 0) || !isFinite(desc.light_cell)) return call.value("light_cell is not positive and finite");
  if (!(desc.light_wrap >= -0.25f && desc.light_wrap <= 1)) return call.value("light_wrap is not -1/4 to 1");
  return RIGEL_OK;
}

rigel_result check(const Call& call, const rigel_frame_desc& desc, const rigel_crowd& crowd) {
  if (const auto e = call.needs({{desc.lights, "lights"}}); e != RIGEL_OK) return e;
  if (!(desc.seconds >= 0) || !isFinite(desc.seconds)) return call.value("seconds is negative or not finite");
  if (const auto e = checkTree(call, desc); e != RIGEL_OK) return e;
  return checkBuffers(call, desc, crowd.visit([](const auto& c) { return c.outputBound(); }));
}

CrowdOutput outputOf(const rigel_frame_desc& d) noexcept {
  return {{reinterpret_cast<GpuRig*>(d.rigs), d.rig_capacity},
          {reinterpret_cast<GpuVec4*>(d.coefficients), d.coefficient_capacity},
          {reinterpret_cast<GpuHalf4*>(d.halves), d.half_capacity},
          {reinterpret_cast<GpuNearLight*>(d.near_lights), d.near_light_capacity}};
}

CrowdStats light(rigel_crowd& crowd, const rigel_frame_desc& desc) {
  Tasks tasks;
  tasks.caller = desc.parallel_for;
  tasks.crowd = &crowd;
  ParallelFor parallel;
  parallel.context = &tasks;
  if (desc.parallel_for.run != nullptr)
    parallel.run = [](void* context, int count, ParallelFor::Task task, void* work) {
      static_cast<Tasks*>(context)->run(count, task, work);
    };
  const rigel_lights::Frame& lights = desc.lights->current;
  CrowdTree tree;
  if (desc.light_target > 0) tree = {&lights.tree, desc.light_target, desc.light_cell, desc.light_wrap};
  const float seconds = std::exchange(crowd.torn, false) ? 0 : desc.seconds;
  return crowd.visit([&](auto& c) {
    return c.frame({&lights.set, &lights.prepared, lights.ids, tree}, seconds, outputOf(desc), parallel,
                   {desc.clock.now, desc.clock.context});
  });
}

}  // namespace
}  // namespace rigel::c

using namespace rigel::c;

rigel_result rigel_light_crowd(rigel_crowd* crowd, const rigel_frame_desc* desc, rigel_frame_info* info) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{crowd, "crowd"}}); e != RIGEL_OK) return e;
    rigel_frame_desc own;
    if (const auto e = call.read(desc, own); e != RIGEL_OK) return e;
    if (info != nullptr)
      if (const auto e = call.checkInfo(info); e != RIGEL_OK) return e;
    if (const auto e = check(call, own, *crowd); e != RIGEL_OK) return e;
    const rigel::CrowdStats stats = light(*crowd, own);
    if (crowd->torn) return call.fail(RIGEL_ERROR_CALLBACK, "parallel_for did not do all tasks");
    if (info == nullptr) return RIGEL_OK;
    rigel_frame_info did = RIGEL_FRAME_INFO_INIT;
    did.visible = static_cast<uint32_t>(stats.visible);
    did.updated = static_cast<uint32_t>(stats.updated);
    did.unusable = static_cast<uint32_t>(stats.unusable);
    did.merged = stats.merged;
    did.lights = stats.lights;
    did.clusters = stats.clusters;
    std::copy(stats.ticks.begin(), stats.ticks.end(), did.ticks);
    Call::write(did, info);
    return RIGEL_OK;
  });
}
