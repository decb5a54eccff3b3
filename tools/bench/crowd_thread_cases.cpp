// Crowds on two threads.
#include "bench/bench_case.h"
#include "bench/machine_limits.h"
#include "bench/people.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

namespace rigel::tools {
namespace {

/// A second thread that waits for work, as those of an engine's job system do: it looks for some for about a tenth of a
/// millisecond before it sleeps, so that it is awake from one frame to the next. Waking takes up to 80 microseconds, a
/// frame of a thousand people 900.
class Helper {
 public:
  Helper() : thread_([this] { serve(); }) {}
  ~Helper() {
    quit_ = true;
    asked_ = ++round_;
    asked_.notify_one();
    thread_.join();
  }

  ParallelFor parallel() {
    return {[](void* self, int count, ParallelFor::Task task, void* work) {
              static_cast<Helper*>(self)->run(count, task, work);
            },
            this};
  }
  /// CPU time of both threads in the last run's tasks [ns], and of the asking thread in all of the run.
  std::uint64_t both() const { return own_ + others_; }
  std::uint64_t whole() const { return whole_; }

 private:
  static constexpr int kLooks = 100000;

  static void await(const std::atomic<int>& value, int old) {
    for (int i = 0; i < kLooks; ++i) {
      if (value.load(std::memory_order_acquire) != old) return;
      benchmark::ClobberMemory();
    }
    value.wait(old);
  }
  void run(int count, ParallelFor::Task task, void* work) {
    const std::uint64_t begin = threadTime(nullptr);
    task_ = task;
    work_ = work;
    asked_ = ++round_;
    asked_.notify_one();
    // Without this a busy machine would let one thread do all.
    for (int seen = started_; seen != round_; seen = started_) await(started_, seen);
    const std::uint64_t start = threadTime(nullptr);
    for (int i = 0; i < count; i += 2) task(work, i);
    own_ = threadTime(nullptr) - start;
    for (int done = done_; done != round_; done = done_) await(done_, done);
    whole_ = threadTime(nullptr) - begin;
  }
  void serve() {
    for (int round = 0;;) {
      await(asked_, round);
      round = asked_;
      if (quit_) return;
      started_ = round;
      started_.notify_one();
      const std::uint64_t begin = threadTime(nullptr);
      task_(work_, 1);
      others_ = threadTime(nullptr) - begin;
      done_ = round;
      done_.notify_one();
    }
  }

  ParallelFor::Task task_ = nullptr;
  void* work_ = nullptr;
  int round_ = 0;
  alignas(64) std::atomic<int> asked_{0};
  alignas(64) std::atomic<int> started_{0};
  alignas(64) std::atomic<int> done_{0};
  alignas(64) std::atomic<bool> quit_{false};
  std::uint64_t own_ = 0, others_ = 0, whole_ = 0;
  std::thread thread_;
};

/// Frames by CPU time: what one thread does alone, and half of what both do together. They take block by block, and the
/// last of 63 is all that one may wait for. Handing work over is the caller's part of a frame and not in it.
void timeBoth(People& people, benchmark::State& state) {
  Helper helper;
  for (auto _ : state) {
    const std::uint64_t begin = threadTime(nullptr);
    people.frame(helper.parallel());
    const std::uint64_t alone = threadTime(nullptr) - begin - helper.whole();
    state.SetIterationTime(1e-9 * (static_cast<double>(alone) + static_cast<double>(helper.both()) / 2));
  }
}

/// Frames by the clock, all included: the least of a few, for a moment in which the machine does nothing else.
void timeByTheClock(People& people, ParallelFor parallel, benchmark::State& state) {
  constexpr int kFrames = 4;
  for (auto _ : state) {
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < kFrames; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      people.frame(parallel);
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    state.SetIterationTime(least);
  }
}

/// Multiply-adds on both threads: how much slower each is for the other.
void timeBothMultiplyAdds(double flops, benchmark::State& state) {
  Helper helper;
  const ParallelFor parallel = helper.parallel();
  for (auto _ : state) {
    parallel.run(
        parallel.context, 2,
        [](void* work, int) {
          auto done = multiplyAdds(*static_cast<const double*>(work));
          benchmark::DoNotOptimize(done);
        },
        &flops);
    state.SetIterationTime(1e-9 * static_cast<double>(helper.both()) / 2);
  }
}

}  // namespace

void addCrowdThreadCases(std::vector<BenchCase>& cases, const std::shared_ptr<LazyPeople>& thousand,
                         const std::shared_ptr<LazyPeople>& many) {
  const auto add = [&](const std::string& name, double items, const std::string& baseline,
                       std::function<void(benchmark::State&)> body) {
    BenchCase c{name, "us/character", items, 1e3, baseline, std::move(body)};
    c.manualTime = true;
    cases.push_back(std::move(c));
  };
  add("crowd.two_threads", 1000, "crowd.objects.n1000",
      [thousand](benchmark::State& state) { timeBoth((*thousand)(), state); });
  add("crowd.two_threads.n10000", 10000, "crowd.objects_scaling",
      [many](benchmark::State& state) { timeBoth((*many)(), state); });
  add("crowd.clock.one_thread", 1000, "",
      [thousand](benchmark::State& state) { timeByTheClock((*thousand)(), {}, state); });
  add("crowd.clock.two_threads", 1000, "crowd.clock.one_thread", [thousand](benchmark::State& state) {
    Helper helper;
    timeByTheClock((*thousand)(), helper.parallel(), state);
  });
  constexpr double kMultiplyAdds = 2e7;
  BenchCase both{
      "limit.fma.two_threads", "ns/kflop", 2 * kMultiplyAdds / 1000, 1, kPeakFigure, [](benchmark::State& state) {
        timeBothMultiplyAdds(kMultiplyAdds, state);
      }};
  both.manualTime = true;
  cases.push_back(std::move(both));
}

}  // namespace rigel::tools
