// Crowds of skinned people: whole frames beside projection alone, over numbers of people, on two threads.
#include "bench/bench_case.h"

#include <rigel/crowd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <thread>

namespace rigel::tools {
namespace {

constexpr int kJoints = 60;

/// A skeleton as games have them: 24 joints in trunk, head and limbs, 18 in each hand.
std::vector<Vec3> joints() {
  std::vector<Vec3> places;
  for (int i = 0; i < 24; ++i) {
    const float t = static_cast<float>(i / 3) / 7, side = static_cast<float>(i % 3 - 1);
    places.push_back({0.2f * side, 1.6f * t - 0.8f, 0});
  }
  for (int i = 0; i < 36; ++i) {
    const float side = i < 18 ? -1.0f : 1.0f, finger = static_cast<float>(i % 18);
    places.push_back({side * (0.28f + 0.005f * finger), -0.05f, 0.01f * finger});
  }
  return places;
}

/// The four nearest joints of each point, by the inverse square of the distance.
std::vector<SkinWeights> skinOf(const std::vector<Vec3>& surface) {
  const std::vector<Vec3> places = joints();
  std::vector<SkinWeights> skin;
  for (const Vec3 p : surface) {
    std::array<std::uint16_t, kJoints> order;
    for (int j = 0; j < kJoints; ++j) order[j] = static_cast<std::uint16_t>(j);
    const auto distance = [&](std::uint16_t j) { return length(places[j] - p); };
    std::ranges::partial_sort(order, order.begin() + 4, {}, distance);
    SkinWeights weights;
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      weights.joint[i] = order[i];
      weights.weight[i] = 1 / (0.001f + distance(order[i]) * distance(order[i]));
      sum += weights.weight[i];
    }
    for (float& w : weights.weight) w /= sum;
    skin.push_back(weights);
  }
  return skin;
}

/// People in a square, two metres apart on average, each in a pose of its own, and lamps over it.
class People {
 public:
  People(int people, int lamps, int tasks) : crowd_(tasks), palettes_(static_cast<std::size_t>(people * kJoints)) {
    const std::vector<Vec3> surface = bodySurface();
    const std::vector<SkinWeights> skin = skinOf(surface);
    const RigBox box{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}};
    const int kind = crowd_.addKind(*CrowdKind::create(*parseRigSpec("poly:6"), {{box, surface}, skin}));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    const float side = 2 * std::sqrt(static_cast<float>(people));
    for (int i = 0; i < people; ++i) {
      ids_.push_back(crowd_.add(kind));
      CrowdInput& input = crowd_.input(ids_.back());
      input.worldFromRig = turned(6 * unit(random), {side * unit(random), 0.9f, side * unit(random)});
      input.palette = std::span(palettes_).subspan(static_cast<std::size_t>(i * kJoints), kJoints);
    }
    for (JointMatrix& joint : palettes_) {
      const RigFrame turn = turned(0.3f * unit(random), {});
      for (int a = 0; a < 3; ++a) {
        joint.m[a][0] = turn.x[a];
        joint.m[a][2] = turn.z[a];
        joint.m[a][3] = 0.05f * unit(random);
      }
    }
    for (int i = 0; i < lamps; ++i)
      lights_.add(SphereLight{{side * unit(random), 2.5f + 2 * unit(random), side * unit(random)}, 0.1f, {30, 20, 10}});
    const CrowdOutputBound bound = crowd_.outputBound();
    rigs_.resize(bound.rigs);
    coefficients_.resize(bound.coefficients);
    near_.resize(bound.near);
  }

  CrowdStats frame(ParallelFor parallel = {}, CrowdProbe probe = {}) {
    prepared_.set(lights_);
    return crowd_.frame({&lights_, &prepared_, {}}, 1.0f / 60, {rigs_, coefficients_, {}, near_}, parallel, probe);
  }

  /// What projection alone takes: as many points, in the same packs of sixteen people, in the same light.
  void projectOnly() {
    constexpr std::size_t kPack = 16, kSamples = 12;
    prepared_.set(lights_);
    for (std::size_t first = 0; first < ids_.size(); first += kPack) {
      const std::size_t people = std::min(kPack, ids_.size() - first), points = people * kSamples;
      for (std::size_t i = 0; i < points; ++i) {
        const Vec3 p = crowd_.input(ids_[first + i % people]).worldFromRig.origin;
        const float step = static_cast<float>(i / people) / kSamples;
        x_[i] = p.x + 0.3f * step;
        y_[i] = p.y + 1.8f * step - 0.9f;
        z_[i] = p.z;
        footprint_[i] = 0.15f;
      }
      const auto rows = [&](const float* row) { return std::span(row, points); };
      projectBatch<3>(prepared_, prepared_.all(), {rows(x_), rows(y_), rows(z_)}, rows(footprint_),
                      {sums_, 27 * points});
    }
  }

 private:
  static RigFrame turned(float angle, Vec3 origin) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, origin};
  }

  Crowd<3> crowd_;
  std::vector<JointMatrix> palettes_;
  std::vector<CrowdId> ids_;
  LightSet lights_;
  PreparedLights prepared_;
  std::vector<GpuRig> rigs_;
  std::vector<GpuVec4> coefficients_;
  std::vector<GpuNearLight> near_;
  alignas(64) float x_[192], y_[192], z_[192], footprint_[192], sums_[27 * 192];
};

/// This thread's CPU time [ns].
std::uint64_t threadTime(void*) {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1000000000 + static_cast<std::uint64_t>(time.tv_nsec);
}

/// A second thread that waits for work.
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
  /// CPU time of both threads in the last run [ns], and of the one that asked for it.
  std::uint64_t both() const { return own_ + others_; }
  std::uint64_t own() const { return own_; }

 private:
  void run(int count, ParallelFor::Task task, void* work) {
    task_ = task;
    work_ = work;
    asked_ = ++round_;
    asked_.notify_one();
    for (int seen = started_; seen != round_; seen = started_) started_.wait(seen);
    const std::uint64_t begin = threadTime(nullptr);
    for (int i = 0; i < count; i += 2) task(work, i);
    own_ = threadTime(nullptr) - begin;
    for (int done = done_; done != round_; done = done_) done_.wait(done);
  }
  void serve() {
    for (int round = 0;;) {
      asked_.wait(round);
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
  std::atomic<int> asked_{0}, started_{0}, done_{0};
  std::atomic<bool> quit_{false};
  std::uint64_t own_ = 0, others_ = 0;
  std::thread thread_;
};

std::uint64_t steadyTime(void*) {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
}

/// Of one frame's CPU time on this thread, what `share` says by the stages' times.
template <class Share>
void timeStages(People& people, benchmark::State& state, const Share& share) {
  for (auto _ : state) {
    const std::uint64_t begin = threadTime(nullptr);
    const CrowdStats stats = people.frame({}, {&steadyTime, nullptr});
    const auto time = static_cast<double>(threadTime(nullptr) - begin);
    double all = 0;
    for (const std::uint64_t ticks : stats.ticks) all += static_cast<double>(ticks);
    state.SetIterationTime(1e-9 * time * share(stats) / all);
  }
}

double ticksOf(const CrowdStats& stats, CrowdStage stage) {
  return static_cast<double>(stats.ticks[static_cast<std::size_t>(stage)]);
}

/// The least that refreshing one person's operator takes [s]: of so few that their palettes stay in the second-level
/// cache, for in larger crowds the next palettes are fetched meanwhile.
double leastRefresh() {
  constexpr int kFew = 160, kFrames = 100;
  People few(kFew, 64, 1);
  std::uint64_t least = ~std::uint64_t{0};
  for (int i = 0; i < kFrames; ++i) {
    const CrowdStats stats = few.frame({}, {&steadyTime, nullptr});
    least = std::min(least, stats.ticks[static_cast<std::size_t>(CrowdStage::refresh)]);
  }
  const std::chrono::steady_clock::duration time(static_cast<std::int64_t>(least));
  return std::chrono::duration<double>(time).count() / kFew;
}

/// Frames without what operators take.
void timeButRefresh(People& people, int count, benchmark::State& state) {
  static const double refresh = leastRefresh();
  for (auto _ : state) {
    const std::uint64_t begin = threadTime(nullptr);
    people.frame();
    const auto time = static_cast<double>(threadTime(nullptr) - begin);
    state.SetIterationTime(1e-9 * time - count * refresh);
  }
}

/// Made when it is first asked for.
class Lazy {
 public:
  explicit Lazy(int people) : number_(people) {}
  People& operator()() {
    if (people_ == nullptr) people_ = std::make_unique<People>(number_, 64, 2);
    return *people_;
  }

 private:
  int number_;
  std::unique_ptr<People> people_;
};

}  // namespace

void addCrowdCases(std::vector<BenchCase>& cases) {
  constexpr double kFlops = 94.0 * 64 * 12;  // of projection, a person
  const auto thousand = std::make_shared<Lazy>(1000);
  const auto add = [&](const std::string& name, double people, const std::string& baseline, bool manual, double flops,
                       std::function<void(benchmark::State&)> body) {
    BenchCase c{name, "us/character", people, 1e3, baseline, std::move(body)};
    c.manualTime = manual;
    c.flops = flops;
    cases.push_back(std::move(c));
  };
  const auto wholeFrames = [](const std::shared_ptr<Lazy>& people) {
    return [people](benchmark::State& state) {
      for (auto _ : state) (*people)().frame();
    };
  };
  add("crowd.projection", 1000, "", false, kFlops, [thousand](benchmark::State& state) {
    for (auto _ : state) (*thousand)().projectOnly();
  });
  add("crowd.1000x64", 1000, "crowd.projection", true, kFlops,
      [thousand](benchmark::State& state) { timeButRefresh((*thousand)(), 1000, state); });
  const std::pair<const char*, CrowdStage> stages[] = {{"pose", CrowdStage::pose}, {"refresh", CrowdStage::refresh},
                                                       {"rank", CrowdStage::rank}, {"project", CrowdStage::project},
                                                       {"fit", CrowdStage::fit},   {"pack", CrowdStage::pack}};
  for (const auto& [name, stage] : stages)
    add(std::string("crowd.stage.") + name, 1000, "crowd.1000x64", true, 0,
        [thousand, stage = stage](benchmark::State& state) {
          timeStages((*thousand)(), state, [stage](const CrowdStats& stats) { return ticksOf(stats, stage); });
        });
  for (const int people : {10, 100, 1000})
    add("crowd.objects.n" + std::to_string(people), people, "", false, 0,
        wholeFrames(people == 1000 ? thousand : std::make_shared<Lazy>(people)));
  add("crowd.objects_scaling", 10000, "crowd.objects.n10", false, 0, wholeFrames(std::make_shared<Lazy>(10000)));
  // What both threads take is halved: they take block by block, and the last of 63 is all that one may wait for.
  add("crowd.two_threads", 1000, "crowd.objects.n1000", true, 0, [thousand](benchmark::State& state) {
    Helper helper;
    for (auto _ : state) {
      const std::uint64_t begin = threadTime(nullptr);
      (*thousand)().frame(helper.parallel());
      const std::uint64_t alone = threadTime(nullptr) - begin - helper.own();
      state.SetIterationTime(1e-9 * (static_cast<double>(alone) + static_cast<double>(helper.both()) / 2));
    }
  });
}

}  // namespace rigel::tools
