// What a task has to itself where a crowd's lights are in a tree: the cells that a block's characters are in, the
// lights that are ranked for them, and the sum of what the cells hold.
#pragma once

#include "crowd_cell_light.h"
#include "crowd_near.h"
#include "crowd_shares.h"

#include <array>

namespace rigel::crowd {

class TreeTask {
 public:
  /// Lights of a block that are there by themselves: for more, the task allocates.
  static constexpr std::size_t kListed = 1024;

  /// For blocks of so many samples a character, rows of SH numbers, lights and clusters.
  void reserve(int samples, int rows, std::size_t uses);
  void begin(const FrameLights& lights) noexcept { cellLights_.begin(lights); }

  /// The cells of a block of n characters, and what lights them. Allocates where the tree has more for a cell than
  /// CellLights expects, as do `rank` and `project`.
  template <int B>
  void select(const FrameLights& lights, const Places& places, const std::uint32_t* groups, int n, CrowdStats& stats);

  /// Lights that are there by themselves for any of the block.
  RankRows rank(const FrameLights& lights);
  std::span<const std::uint32_t> listed() const noexcept { return listed_; }
  /// How much of each, a row a light.
  const float* shares() const noexcept { return shares_.data(); }
  /// Rows of errors, as far as lights are there by themselves: what becomes a part of a cluster has less and less.
  void share(float* errors) const noexcept;

  /// What is near of a character's lights is not in its rig.
  void setNear(int c, std::span<const NearSlot> slots) noexcept;
  void clearNear() noexcept { nearCount_ = {}; }

  /// Sums as projectBatch leaves them, of points that are packed sample by sample. `ahead`: as there.
  template <int B>
  void project(const FrameLights& lights, const Vec3Rows& points, std::span<const float> footprints, int n,
               std::span<float> sums, LinesAhead ahead);

  std::uint64_t asked() const noexcept { return cellLights_.asked(); }
  std::size_t bytes() const noexcept;

 private:
  struct BlockCell {
    Cell cell;
    std::size_t number = 0;    // in cellLights_
    float share[kBlock] = {};  // of each character
  };
  struct NearShare {
    std::uint32_t light = 0;
    float rest = 1;  // that is not near
  };

  void addShare(const CellShare& share, int c) noexcept;
  void count(int n, CrowdStats& stats) const noexcept;
  void setShares(const CellLight& light, std::span<const int> members);
  template <int B>
  void projectCell(const FrameLights& lights, const CellLight& light, const Vec3Rows& points,
                   std::span<const float> footprints, std::span<const int> members, std::span<float> sums,
                   LinesAhead ahead);

  CellLights cellLights_;
  std::vector<BlockCell> cells_;
  std::vector<std::uint32_t> listed_, merged_;
  AlignedArray<float> shares_;
  RankTable ranks_;
  BlockShares blockShares_;
  std::array<std::array<NearShare, kMaxCrowdNear>, kBlock> near_;
  std::array<int, kBlock> nearCount_{};
  // Of the members of one cell.
  AlignedArray<float> x_, y_, z_, footprints_, sums_;
};

}  // namespace rigel::crowd
