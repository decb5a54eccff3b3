// Crowds of skinned people: whole frames beside projection alone, their stages, over numbers of people.
#include "bench/bench_case.h"
#include "bench/people.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace rigel::tools {
namespace {

constexpr int kCrowds[] = {10, 100, 1000, 10000};

std::uint64_t stageTime(void*) {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
}

/// Of one frame's CPU time on this thread, what `share` says by the stages' times.
template <class Share>
void timeStages(People& people, benchmark::State& state, const Share& share) {
  for (auto _ : state) {
    const std::uint64_t begin = threadTime(nullptr);
    const CrowdStats stats = people.frame({}, {&stageTime, nullptr});
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
    const CrowdStats stats = few.frame({}, {&stageTime, nullptr});
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

/// Frames of n people as a + b n.
struct Line {
  double a = 0, b = 0;

  /// Least squares of relative deviations from `perPerson`, one of each of kCrowds.
  explicit Line(std::span<const double> perPerson) {
    double s00 = 0, s01 = 0, s11 = 0, t0 = 0, t1 = 0;
    for (std::size_t i = 0; i < perPerson.size(); ++i) {
      const double frame = kCrowds[i] * perPerson[i], one = 1 / frame, people = kCrowds[i] / frame;
      s00 += one * one;
      s01 += one * people;
      s11 += people * people;
      t0 += one;
      t1 += people;
    }
    const double determinant = s00 * s11 - s01 * s01;
    a = (t0 * s11 - t1 * s01) / determinant;
    b = (t1 * s00 - t0 * s01) / determinant;
  }
};

/// How far from linear frames are, over crowds of 10 to 10,000.
void addLinearity(std::vector<BenchCase>& cases) {
  const auto derived = [&](const std::string& name, const std::string& unit, auto derive) {
    BenchCase c{name, unit, 1, 1, "", {}};
    for (const int people : kCrowds)
      c.from.push_back(people == 10000 ? "crowd.objects_scaling" : "crowd.objects.n" + std::to_string(people));
    c.derive = derive;
    cases.push_back(std::move(c));
  };
  derived("crowd.objects.spread", "largest/least", [](std::span<const double> perPerson) {
    return *std::ranges::max_element(perPerson) / *std::ranges::min_element(perPerson);
  });
  derived("crowd.objects.fixed", "us/frame",
          [](std::span<const double> perPerson) { return Line(perPerson).a / 1000; });
  derived("crowd.objects.deviation", "% of a + b n", [](std::span<const double> perPerson) {
    const Line line(perPerson);
    double most = 0;
    for (std::size_t i = 0; i < perPerson.size(); ++i)
      most = std::max(most, std::abs(kCrowds[i] * perPerson[i] / (line.a + line.b * kCrowds[i]) - 1));
    return 100 * most;
  });
}

}  // namespace

void addCrowdCases(std::vector<BenchCase>& cases) {
  constexpr double kFlops = 94.0 * 64 * 12;  // of projection, a person
  const auto thousand = std::make_shared<LazyPeople>(1000), many = std::make_shared<LazyPeople>(10000);
  const auto add = [&](const std::string& name, double people, const std::string& baseline, bool manual, double flops,
                       std::function<void(benchmark::State&)> body) {
    BenchCase c{name, "us/character", people, 1e3, baseline, std::move(body)};
    c.manualTime = manual;
    c.flops = flops;
    cases.push_back(std::move(c));
  };
  const auto wholeFrames = [](const std::shared_ptr<LazyPeople>& people) {
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
        wholeFrames(people == 1000 ? thousand : std::make_shared<LazyPeople>(people)));
  add("crowd.objects_scaling", 10000, "crowd.objects.n10", false, 0, wholeFrames(many));
  add("crowd.objects.large_pages", 10000, "crowd.objects_scaling", false, 0,
      wholeFrames(std::make_shared<LazyPeople>(10000, true)));
  addLinearity(cases);
  cases.push_back({"crowd.frame_lights", "us/frame", 1, 1e3, "", [thousand](benchmark::State& state) {
                     for (auto _ : state) (*thousand)().frameOfLights();
                   }});
  addCrowdThreadCases(cases, thousand, many);
}

}  // namespace rigel::tools
