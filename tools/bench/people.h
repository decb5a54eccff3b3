// Skinned people under lamps, as the crowd's figures have them.
#pragma once

#include "bench/bench_case.h"
#include "bench/large_pages.h"

#include <rigel/crowd.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <vector>

namespace rigel::tools {

/// This thread's CPU time [ns].
inline std::uint64_t threadTime(void*) {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1000000000 + static_cast<std::uint64_t>(time.tv_nsec);
}

class People {
 public:
  People(int people, int lamps, int tasks, bool largePages = false);

  CrowdStats frame(ParallelFor parallel = {}, CrowdProbe probe = {}) {
    prepared_.set(lights_);
    return crowd_.frame({&lights_, &prepared_, {}}, 1.0f / 60, {rigs_, coefficients_, {}, near_}, parallel, probe);
  }
  /// A frame in which nobody is seen: what lights take.
  void frameOfLights();
  /// What projection alone takes: as many points, in the same packs of sixteen people, in the same light.
  void projectOnly();

 private:
  template <class T>
  using Array = std::vector<T, LargePages<T>>;

  Crowd<3> crowd_, empty_;
  Array<JointMatrix> palettes_;
  std::vector<CrowdId> ids_;
  LightSet lights_;
  PreparedLights prepared_;
  Array<GpuRig> rigs_;
  Array<GpuVec4> coefficients_;
  Array<GpuNearLight> near_;
  alignas(64) float x_[192], y_[192], z_[192], footprint_[192], sums_[27 * 192];
};

/// Made when they are first asked for: 64 lamps, up to two tasks.
class LazyPeople {
 public:
  explicit LazyPeople(int people, bool largePages = false) : number_(people), largePages_(largePages) {}
  People& operator()() {
    if (people_ == nullptr) people_ = std::make_unique<People>(number_, 64, 2, largePages_);
    return *people_;
  }

 private:
  int number_;
  bool largePages_;
  std::unique_ptr<People> people_;
};

}  // namespace rigel::tools
