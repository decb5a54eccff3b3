// What lights a cell of the grid (crowd_cells.h): the light tree's answer, kept for all characters of a task that are
// in it, from frame to frame where the lights stay as they are.
#pragma once

#include <rigel/light_tree.h>

#include "aligned_array.h"
#include "crowd_cells.h"
#include "crowd_far_light.h"
#include "crowd_lights.h"

#include <span>
#include <vector>

namespace rigel::crowd {

/// Good until the next CellLights::find.
struct CellLight {
  std::span<const LightUse> near;    // to be projected at every sample; lights first, by their numbers, then clusters
  std::span<const LightUse> single;  // the lights among them
  const float* distant = nullptr;    // rows of an SH number and its slopes by x, y and z; null: all 0
  Vec3 centre;                       // of the slopes
  int lights = 0, clusters = 0;      // all that are in it
  float bound = 0, mean = 0;         // LightSelection's
};

/// Selections of cells. Two generations: what is asked for again moves to the young one, and where that is full it
/// becomes the old one, whose place is taken. So nothing is asked twice for blocks that follow each other, and nothing
/// at all where lights do not change and characters stay in as many cells as there is room for.
class CellLights {
 public:
  /// Cells that one block can ask for.
  static constexpr std::size_t kBlockCells = std::size_t{kMostShares} * kBlock;

  /// For so many lights and clusters, and rows of SH numbers.
  void reserve(std::size_t uses, std::size_t rows);
  /// Forgets all where the lights, or what is asked of them, are not those of the last frame.
  void begin(const FrameLights& lights) noexcept;
  /// Numbers that `find` returns from now on are good until the next block.
  void beginBlock() noexcept;
  /// Asks the tree unless it knows. Allocates where it is told of more than kList lights and clusters.
  template <int B>
  std::size_t find(const FrameLights& lights, const Cell& cell);
  CellLight operator[](std::size_t number) const noexcept;

  std::uint64_t asked() const noexcept { return asked_ + far_.asked(); }  // since `begin`
  std::size_t bytes() const noexcept;

 private:
  static constexpr std::size_t kCells = 2 * kBlockCells;
  static constexpr std::size_t kSlots = 2 * kCells;  // of a table; a power of two
  static constexpr std::size_t kUses = 64 * kCells;  // of all cells: where there are more it is full
  static constexpr std::size_t kList = 4096;

  struct Entry {
    Cell cell;
    std::size_t first = 0, count = 0, single = 0;  // uses
    bool distant = false;
    CellLight rest;  // numbers alone
  };
  struct Generation {
    std::vector<Entry> entries;
    std::vector<LightUse> uses;
    AlignedArray<float> distant;
    std::vector<std::uint16_t> slots;  // an entry's number and one; 0: none

    void clear() noexcept;
    std::size_t slotOf(const Cell& cell) const noexcept;  // its own, or a free one
    bool isFull() const noexcept { return entries.size() + kBlockCells > kCells || uses.size() > kUses; }
  };

  template <int B>
  void select(const FrameLights& lights, const Cell& cell);
  void add(const Entry& entry, std::span<const LightUse> near, const float* distant);

  Generation young_, old_;
  FarLights far_;
  LightSelection selection_;
  AlignedArray<float> slopes_;
  std::size_t rows_ = 0;
  CrowdTree tree_;
  std::uint64_t version_ = 0;
  std::uint64_t asked_ = 0;
};

/// The mask of all that light the same: bits that no light has do not count.
inline std::uint32_t groupsThatCount(std::uint32_t groups, const LightTree::Groups& lights) noexcept {
  return (groups & lights.all) != 0 ? kAllLightGroups : groups & lights.any;
}

}  // namespace rigel::crowd
