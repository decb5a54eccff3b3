// What each way to a disk's light costs and how wrong it is, at the surface points of the scene that is reported.
#pragma once

#include "report/measure/surface_set.h"
#include "report/report_data.h"

#include <rigel/light.h>

namespace rigel::tools {

/// Pairs of a disk and a surface point that it lights, gathered over the frames. Scenes without disks add nothing.
class DiskPairs {
 public:
  struct Pair {
    DiskLight light;
    Vec3 position, normal;
  };

  /// `looks`: how many times add will be called, for a sample that is spread over all of them.
  explicit DiskPairs(std::size_t looks) : looks_(looks) {}

  /// Each disk of the set with a few points of an object as it is posed.
  void add(const SceneObject& object, const PosedObject& posed, const SurfaceSet& surface, const LightSet& lights);

  std::span<const Pair> pairs() const { return pairs_; }

  static constexpr std::size_t kMost = 4096;

 private:
  std::size_t looks_;
  double owed_ = 0;           // points
  std::uint64_t random_ = 1;  // the same points every time
  std::vector<Pair> pairs_;
};

/// Measures every method at the pairs with SH of `bands` bands; empty without pairs. About a second.
std::vector<DiskMethodRow> measureDiskMethods(std::span<const DiskPairs::Pair> pairs, int bands);

}  // namespace rigel::tools
