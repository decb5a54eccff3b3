// What is distant for many cells of the grid at once (crowd_cells.h): regions are asked about before the cells in them,
// as in the downward pass of a fast multipole method (Greengard and Rokhlin, "A Fast Algorithm for Particle
// Simulations", 1987). Lights whose value and slopes at a region's centre are enough for all of it are summed there;
// those that are so for any one cell are found there, and summed by the cells; these go on with what is left. An answer
// depends on the region and the lights alone.
#pragma once

#include <rigel/far_lights.h>
#include <rigel/light_tree.h>

#include "aligned_array.h"
#include "crowd_cells.h"
#include "crowd_lights.h"

#include <array>
#include <vector>

namespace rigel::crowd {

/// Good until the next FarLights::find.
struct FarLight {
  Cell region;
  Vec3 centre;                   // of the slopes
  AlignedArray<float> slopes;    // rows of an SH number and its slopes by x, y and z: of what is distant for all
  FarLightList parts;            // to be projected by each cell
  LightCut rest;                 // for each cell to go on with
  int lights = 0, clusters = 0;  // of slopes and parts
};

/// Rows as FarLight has them, added.
template <int B>
void addSlopes(const ProjectionWithGradient<B>& far, float* slopes) noexcept {
  for (std::size_t row = 0; row < 3 * shCount(B); ++row) {
    slopes[4 * row] += far.value.data()[row];
    for (std::size_t axis = 0; axis < 3; ++axis) slopes[4 * row + 1 + axis] += far.gradient.d[axis].data()[row];
  }
}

/// Adds a region's slopes, moved to another centre.
void addSlopes(const FarLight& far, std::size_t rows, Vec3 centre, float* slopes) noexcept;

/// The latest answers.
class FarLights {
 public:
  /// For so many lights and clusters, and rows of SH numbers.
  void reserve(std::size_t uses, std::size_t rows);
  void begin() noexcept { asked_ = 0; }
  void clear() noexcept { count_ = next_ = 0; }
  /// Of the region that the cell is in. Asks the tree unless it knows. Allocates where it is told of more than kList
  /// lights and clusters.
  template <int B>
  const FarLight& find(const FrameLights& lights, const Cell& cell);
  std::uint64_t asked() const noexcept { return asked_; }  // since `begin`
  std::size_t bytes() const noexcept;

 private:
  static constexpr std::size_t kKept = 16;
  static constexpr std::int32_t kNobodys = -1;  // level of no region
  static constexpr std::size_t kList = 512;

  template <int B>
  void ask(const FrameLights& lights, const Cell& region, FarLight& far);

  std::array<FarLight, kKept> kept_;
  std::size_t count_ = 0, next_ = 0;
  std::vector<LightUse> whole_, parts_;
  std::size_t rows_ = 0;
  std::uint64_t asked_ = 0;
};

}  // namespace rigel::crowd
